// SPDX-License-Identifier: Apache-2.0
// The scene, with the forces of the contacts.
import {forceArrow, layoutOf} from './cones.js';
import {element, svgElement} from './dom.js';
import {roundBelow, short, toDouble} from './numbers.js';

const kBand = 36;       // pixels below the scene
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
    const [width, height] = ['width', 'height'].map(name => Number(this.svg.getAttribute(name)));
    this.middle = height + kBand / 2;
    this.width = width;
    this.svg.setAttribute('height', height + kBand);
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height + kBand}`);
    this.newton = largest === 0 ? 1 : kLongest * height / largest;
    this.node = frame;
    this.ground = [svgElement('rect', {class: 'band', y: height, width, height: kBand}), ...this.scaleOf(largest), ...this.gravityOf(data.picture.gravity)];
  }

  // An arrow of a round number of newtons, on a band below the scene, as the way of gravity is.
  scaleOf(largest) {
    if (largest === 0) return [];
    const value = roundBelow(0.6 * largest), x = 14, y = this.middle;
    return [
      forceArrow([x, y], [x + this.newton * value, y], 'scale'),
      svgElement('text', {class: 'scale', x: x + this.newton * value + 8, y: y + 5}, `${short(value)} N`)
    ];
  }

  // The way of gravity, of which nothing is told where it is none.
  gravityOf(gravity) {
    const size = Math.hypot(...gravity ?? [0, 0]), kArrow = 26;
    if (size === 0) return [];
    const at = [this.width - 30, this.middle], along = gravity.map(g => g / size * kArrow / 2);
    const [from, to] = [-1, 1].map(sign => at.map((x, i) => x + sign * along[i]));
    return [
      forceArrow(from, to, 'scale'),
      svgElement('text', {class: 'scale', x: at[0] - 20, y: at[1] + 5, 'text-anchor': 'end'}, 'g')
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
