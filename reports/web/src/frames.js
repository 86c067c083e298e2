// SPDX-License-Identifier: Apache-2.0
// The frames of an animation, as the program packs them (../data.md).

const kTenths = 10, kTurns = 1e4;  // of a pixel; of a cosine
const kDigits = 7;                 // that a packed number has

// `before`: those of the frame before, some of which stand here, too.
function forcesOf(text, contacts, before) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0)), view = new DataView(bytes.buffer);
  const forces = [];
  let at = 0;
  const word = () => view.getInt16((at += 2) - 2, true);
  const number = () => Number(view.getFloat32((at += 4) - 4, true).toPrecision(kDigits));
  const force = () => {
    const {rows, ...contact} = contacts[word()], [x, y, dx, dy] = [word(), word(), word(), word()].map(z => z / kTenths);
    return {...contact, at: [x, y], along: [dx, dy], f: Array.from({length: rows}, number)};
  };
  while (at < bytes.length) {
    const same = word(), others = word();
    forces.push(...before.slice(forces.length, forces.length + same));
    forces.push(...Array.from({length: others}, force));
  }
  return forces;
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
export function framesOf({frames, contacts, scale}) {
  let forces = [], elements = [];
  return frames.map(({poses, ...frame}) => {
    forces = forcesOf(frame.forces, contacts, forces);
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
