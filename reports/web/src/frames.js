// SPDX-License-Identifier: Apache-2.0
// The frames of an animation, as the program packs them (../data.md).
import {unpacked, unpackedBytes} from './packed.js';

const kTenths = 10, kTurns = 1e4;  // of a pixel; of a cosine
const kDigits = 7;                 // that a packed number has

// Of each frame the forces that bear on contacts.
class ForceReader {
  constructor(bytes, contacts) {
    Object.assign(this, {view: new DataView(bytes), at: 0, contacts, before: []});
  }

  word() {
    return this.view.getInt16((this.at += 2) - 2, true);
  }
  number() {
    return Number(this.view.getFloat32((this.at += 4) - 4, true).toPrecision(kDigits));
  }
  force() {
    const {rows, ...contact} = this.contacts[this.word()];
    const [x, y, dx, dy] = Array.from({length: 4}, () => this.word() / kTenths);
    return {...contact, at: [x, y], along: [dx, dy], f: Array.from({length: rows}, () => this.number())};
  }

  // Some stand in the frame before, too.
  next() {
    const forces = [], count = this.word();
    while (forces.length < count) {
      const same = this.word(), others = this.word();
      forces.push(...this.before.slice(forces.length, forces.length + same));
      forces.push(...Array.from({length: others}, () => this.force()));
    }
    return this.before = forces;
  }
}

// Elements of a picture: a number stands for so many of the frame before.
function elementsOf(placed, before) {
  const elements = [];
  for (const part of placed)
    elements.push(...typeof part === 'number' ? before.slice(elements.length, elements.length + part) : [part]);
  return elements;
}

// As SVG, of bodies in the plane.
function transformsOf(poses, scale) {
  const transforms = [];
  for (let i = 0; i < poses.length; i += 4) {
    const [x, y] = poses.slice(i, i + 2).map(z => z / kTenths);
    const [c, s] = poses.slice(i + 2, i + 4).map(z => scale * z / kTurns);
    transforms.push(`matrix(${[c, -s, -s, -c, x, y].join(' ')})`);
  }
  return transforms;
}

// Frames with `transforms`, and `forces` as {bodies, kind, mu, at, along, f}, where the bodies touch, too.
export async function framesOf({frames, forces: packed, contacts, scale}) {
  const reader = new ForceReader(await unpackedBytes(packed), contacts);
  let elements = [];
  return JSON.parse(await unpacked(frames)).map(({poses, ...frame}) => {
    const forces = reader.next();
    elements = elementsOf(frame.placed, elements);
    return {
      ...frame,
      forces,
      placed: elements.join(''),
      transforms: transformsOf(poses, scale),
      points: [...frame.points, ...forces.map(({at}) => at)]
    };
  });
}
