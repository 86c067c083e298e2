// SPDX-License-Identifier: Apache-2.0
// The scene, with the forces of the contacts.
import {forceArrow, layoutOf} from './cones.js';
import {element, svgElement} from './dom.js';
import {roundBelow, short, toDouble} from './numbers.js';

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
    this.ground = [...this.scaleOf(largest), ...this.gravityOf(data.picture.gravity)];
  }

  // An arrow of a round number of newtons.
  scaleOf(largest) {
    if (largest === 0) return [];
    const value = roundBelow(0.6 * largest), x = 14, y = Number(this.svg.getAttribute('height')) - 16;
    return [
      forceArrow([x, y], [x + this.newton * value, y], 'scale'),
      svgElement('text', {class: 'scale', x: x + this.newton * value + 8, y: y + 5}, `${short(value)} N`)
    ];
  }

  // The way of gravity, of which nothing is told where it is none.
  gravityOf(gravity) {
    const size = Math.hypot(...gravity ?? [0, 0]), kArrow = 46;
    if (size === 0) return [];
    const from = [Number(this.svg.getAttribute('width')) - 34, 34 - Math.min(0, gravity[1] / size * kArrow)];
    const to = gravity.map((g, i) => from[i] + g / size * kArrow);
    return [
      forceArrow(from, to, 'scale'),
      svgElement('text', {class: 'scale', x: from[0] - 10, y: from[1] + 16, 'text-anchor': 'end'}, 'g')
    ];
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
    const marks = [...this.ground];
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
