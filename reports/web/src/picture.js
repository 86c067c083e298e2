// SPDX-License-Identifier: Apache-2.0
// The scene, with the forces of the contacts.
import {forceArrow, layoutOf} from './cones.js';
import {element, svgElement} from './dom.js';
import {toDouble} from './numbers.js';

const kLongest = 0.24;  // arrow, of the picture's height

export class Picture {
  constructor(data, runs) {
    Object.assign(this, {runs, places: data.picture.contacts, layout: layoutOf(data.problem)});
    const frame = element('div', {class: 'drawing'});
    frame.innerHTML = data.picture.svg;  // drawn by the program, which escapes what it draws
    this.svg = frame.firstElementChild;
    this.marks = svgElement('g', {class: 'marks'});
    this.svg.append(this.marks);
    this.svg.setAttribute('role', 'img');
    this.svg.setAttribute('aria-label', `The scene ${data.name}, with the forces of its contacts`);
    let largest = 0;
    for (const run of runs) {
      for (let state = 0; state <= run.last; ++state) {
        for (let i = 0; i < this.places.length; ++i)
          largest = Math.max(largest, Math.hypot(...this.forceOf(run, state, i)));
      }
    }
    this.newton = largest === 0 ? 1 : kLongest * Number(this.svg.getAttribute('height')) / largest;
    this.node = frame;
  }

  // Of a contact, in the plane of the picture.
  forceOf(run, state, i) {
    const {first, rows} = this.layout[i], f = run.f(state), ways = this.places[i].rows;
    let x = 0, y = 0;
    for (let k = 0; k < rows; ++k) {
      x += toDouble(f[first + k]) * ways[k][0];
      y += toDouble(f[first + k]) * ways[k][1];
    }
    return [x, y];
  }

  show(states) {
    const marks = [];
    for (let r = this.runs.length - 1; r >= 0; --r) {
      this.places.forEach(({at}, i) => {
        const [x, y] = this.forceOf(this.runs[r], states[r], i);
        if (x !== 0 || y !== 0)
          marks.push(forceArrow(at, [at[0] + this.newton * x, at[1] + this.newton * y], `force run-${r}`));
      });
    }
    this.places.forEach(({at}, i) => {
      marks.push(
          svgElement('circle', {class: 'contact', cx: at[0], cy: at[1], r: 11}),
          svgElement(
              'text', {class: 'contact', x: at[0], y: at[1] + 5, 'text-anchor': 'middle'}, String(i + 1)));
    });
    this.marks.replaceChildren(...marks);
  }
}
