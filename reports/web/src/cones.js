// SPDX-License-Identifier: Apache-2.0
// The force of a contact in its friction cone. In the plane: fF to the right, fN up, and the way that the force
// has taken. In space: the disc of friction forces that fN allows, seen along the normal.
import {element, svgElement} from './dom.js';
import {compareWithLimit, roundBelow, short, spoken, toDouble} from './numbers.js';

const kWidth = 260, kHeight = 200, kMargin = 22;
const round = x => Math.round(100 * x) / 100;

// First row and number of rows of each contact.
export function layoutOf(problem) {
  let row = 0;
  return problem.contacts.map(contact => {
    const rows = contact.kind === 'static' || contact.kind === 'sliding' ? problem.dimension : 1;
    row += rows;
    return {first: row - rows, rows, contact};
  });
}

// Horizontal and vertical force of a contact, as doubles.
function pointOf(f, {first, rows}) {
  return [rows > 1 ? toDouble(f[first + 1]) : 0, toDouble(f[first])];
}

// ---- What is said of a force -----------------------------------------------------------------

// A contact whose `mode` is given has that, so that no two places of a page say different things of it.
function place(f, {first, rows, contact}) {
  if (contact.mode !== undefined) return contact.mode;
  if (contact.kind !== 'static') return contact.kind;
  const mu = contact.mu, normal = f[first];
  if (rows === 2) {
    const sign = compareWithLimit(f[first + 1], mu, normal);
    if (toDouble(normal) === 0 && sign === 0) return 'no force';
    return sign < 0 ? 'inside the cone' : sign === 0 ? 'on the edge of the cone' : 'outside the cone';
  }
  const size = Math.hypot(toDouble(f[first + 1]), toDouble(f[first + 2])),
        most = toDouble(mu) * toDouble(normal);
  if (size === 0 && most === 0) return 'no force';
  const near = 1e-9 * Math.max(size, most);
  return size < most - near ? 'inside the cone' :
      size <= most + near   ? 'on the edge of the cone' :
                              'outside the cone';
}

function words(f, layout) {
  const rows = f.slice(layout.first, layout.first + layout.rows).map(spoken);
  const names = layout.rows === 1 ? 'f_N' : layout.rows === 2 ? '(f_N, f_F)' : '(f_N, f_Fx, f_Fy)';
  return `${names} = ${layout.rows === 1 ? rows[0] : `(${rows.join(', ')})`}`;
}

// Of "f_N" N as an index.
const indexed = text => text.split(/_(N|Fx|Fy|F)\b/).map((part, i) => i % 2 === 1 ? element('sub', {}, part) : part);

// The name of an axis: "f", an index, and the unit.
const axisName = (place, index) => svgElement(
    'text', place, 'f', svgElement('tspan', {class: 'index', dy: 3}, index), svgElement('tspan', {dy: -3}, ', N'));

// ---- A picture -------------------------------------------------------------------------------

function arrow(from, to, style) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]], length = Math.hypot(dx, dy);
  if (length < 2)
    return svgElement('circle', {class: `${style} tip`, cx: round(to[0]), cy: round(to[1]), r: 4});
  const [ux, uy] = [dx / length, dy / length], head = Math.min(12, 0.6 * length);
  const base = [to[0] - head * ux, to[1] - head * uy], half = 0.45 * head;
  const points = [to, [base[0] - half * uy, base[1] + half * ux], [base[0] + half * uy, base[1] - half * ux]];
  return svgElement(
      'g', {class: style},
      svgElement('line', {x1: round(from[0]), y1: round(from[1]), x2: round(base[0]), y2: round(base[1])}),
      svgElement('polygon', {class: 'tip', points: points.map(p => p.map(round).join(',')).join(' ')}));
}
export const forceArrow = arrow;

// A mark at a round number of newtons on an axis, `at(newtons)`, of so many; it leaves room for the axis' name.
function newtonsAt(at, most) {
  const value = roundBelow(0.7 * most), [x, y] = at(value).map(round), isAcross = y === round(at(0)[1]);
  return [
    svgElement('line', {
      class: 'mark',
      x1: x - (isAcross ? 0 : 3),
      x2: x + (isAcross ? 0 : 3),
      y1: y - (isAcross ? 3 : 0),
      y2: y + (isAcross ? 3 : 0)
    }),
    svgElement('text', isAcross ? {x, y: y + 14, 'text-anchor': 'middle'} : {x: x + 6, y: y + 4}, short(value))
  ];
}

class ConeInPlane {
  constructor(runs, layout, [leastAcross = 0, leastUp = 0] = []) {
    this.layout = layout;
    const points = runs.flatMap(run => Array.from({length: run.last + 1}, (_, k) => pointOf(run.f(k), layout)));
    const right = Math.max(leastAcross, ...points.map(p => Math.abs(p[0])));
    const top = Math.max(leastUp, ...points.map(p => p[1])), low = Math.min(0, ...points.map(p => p[1]));
    const fit = size => size === 0 ? Infinity : size;
    let across = (kWidth / 2 - kMargin) / fit(right), up = (kHeight - 2 * kMargin) / fit(top - low);
    if (across === 0 && up === 0) across = up = 1;
    if (across === 0) across = up;
    if (up === 0) up = across;
    this.isToScale = Math.max(across, up) / Math.min(across, up) < 8;
    if (this.isToScale) across = up = Math.min(across, up);
    Object.assign(this, {across, up, low});
  }

  at([t, n]) {
    return [kWidth / 2 + this.across * t, kHeight - kMargin + this.up * (this.low - n)];
  }

  ground() {
    const {contact, rows} = this.layout;
    const apex = this.at([0, 0]), axes = [
      svgElement('line', {class: 'axis', x1: 0, x2: kWidth, y1: round(apex[1]), y2: round(apex[1])}),
      svgElement('line', {class: 'axis', x1: apex[0], x2: apex[0], y1: kHeight, y2: 0}),
    ];
    if (rows < 2 || contact.mu === undefined) return axes;
    // As far as the picture goes: n to the height of its top, t = mu n.
    const mu = toDouble(contact.mu), far = 2 * kHeight / this.up;
    const edges = [this.at([-mu * far, far]), this.at([mu * far, far])];
    const points = [apex, ...edges].map(p => p.map(round).join(',')).join(' ');
    return [svgElement('polygon', {class: 'cone', points}), ...axes];
  }

  way(run, from, to, style) {
    const points = [];
    for (let k = from; k <= to; ++k) points.push(this.at(pointOf(run.f(k), this.layout)).map(round).join(','));
    return svgElement('polyline', {class: style, points: points.join(' ')});
  }

  force(f, style) {
    return arrow(this.at([0, 0]), this.at(pointOf(f, this.layout)), style);
  }
  labels() {
    const apex = this.at([0, 0]);
    return [
      ...this.layout.rows > 1 ? [axisName({x: kWidth - 4, y: round(apex[1]) - 6, 'text-anchor': 'end'}, 'F')] : [],
      axisName({x: kWidth / 2 + 6, y: 12}, 'N'),
      ...this.layout.rows > 1 ? newtonsAt(x => this.at([x, 0]), kWidth / 2 / this.across) : [],
      ...newtonsAt(x => this.at([0, x]), kHeight / this.up),
    ];
  }
}

class DiscInSpace {
  constructor(runs, layout, [least = 0] = []) {
    this.layout = layout;
    this.isToScale = true;
    const sizes = runs.flatMap(run => Array.from({length: run.last + 1}, (_, k) => {
      const f = run.f(k).slice(layout.first, layout.first + 3).map(toDouble);
      return Math.max(Math.hypot(f[1], f[2]), toDouble(layout.contact.mu) * f[0]);
    }));
    const largest = Math.max(least, ...sizes);
    this.scale = largest === 0 ? 1 : (kHeight / 2 - 10) / largest;
  }

  at(x, y) {
    return [kWidth / 2 + this.scale * x, kHeight / 2 - this.scale * y];
  }
  ground() {
    return [
      svgElement('line', {class: 'axis', x1: 0, x2: kWidth, y1: kHeight / 2, y2: kHeight / 2}),
      svgElement('line', {class: 'axis', x1: kWidth / 2, x2: kWidth / 2, y1: 0, y2: kHeight})
    ];
  }
  way(run, from, to, style) {
    const points = [];
    for (let k = from; k <= to; ++k)
      points.push(this.at(...run.f(k).slice(this.layout.first + 1, this.layout.first + 3).map(toDouble))
                      .map(round)
                      .join(','));
    return svgElement('polyline', {class: style, points: points.join(' ')});
  }
  force(f, style) {
    const [n, x, y] = f.slice(this.layout.first, this.layout.first + 3).map(toDouble);
    const r = Math.max(0, this.scale * toDouble(this.layout.contact.mu) * n);
    return svgElement(
        'g', {}, svgElement('circle', {class: `disc ${style}`, cx: kWidth / 2, cy: kHeight / 2, r: round(r)}),
        arrow([kWidth / 2, kHeight / 2], this.at(x, y), style));
  }
  labels() {
    return [
      svgElement('text', {x: kWidth - 4, y: kHeight / 2 - 5, 'text-anchor': 'end'}, 'x, N'),
      svgElement('text', {x: kWidth / 2 + 6, y: 12}, 'y, N'), ...newtonsAt(x => this.at(x, 0), kWidth / 2 / this.scale)
    ];
  }
}

// A figure for each contact, with the forces of all runs.
export class Cones {
  // `reach`: forces that the scales include, such as those of other frames (N across and up, of a disc one).
  // `first`: the number of the first contact.
  constructor(data, runs, reach = [], first = 1) {
    this.runs = runs;
    this.figures = layoutOf(data.problem).map((layout, i) => ({
                                                layout,
                                                number: i + first,
                                                picture: new (layout.rows === 3 ? DiscInSpace : ConeInPlane)(
                                                    runs, layout, reach)
                                              }));
    const many = this.figures.length > 9;
    this.node = element(
        'div',
        many ? {class: 'cones many', tabindex: '0', role: 'group', 'aria-label': 'Friction cones'} : {class: 'cones'});
  }

  get areToScale() {
    return this.figures.every(figure => figure.picture.isToScale);
  }

  // `states`: of each run.
  show(states) {
    this.node.replaceChildren(...this.figures.map(figure => this.figure(figure, states)));
  }

  figure({layout, number, picture}, states) {
    const {contact} = layout, shapes = picture.ground();
    const order = this.runs.map((_, i) => i).reverse();  // the first run on top
    for (const i of order) shapes.push(picture.way(this.runs[i], 0, this.runs[i].last, `way run-${i}`));
    for (const i of order) shapes.push(picture.way(this.runs[i], 0, states[i], `way gone run-${i}`));
    for (const i of order) shapes.push(picture.force(this.runs[i].f(states[i]), `force run-${i}`));
    const said =
        this.runs.map((run, i) => `${words(run.f(states[i]), layout)}, ${place(run.f(states[i]), layout)}`);
    const mu = contact.mu === undefined ? contact.kind : `μ = ${spoken(contact.mu)}`;
    return element(
        'figure', {},
        svgElement(
            'svg', {
              viewBox: `0 0 ${kWidth} ${kHeight}`,
              role: 'img',
              'aria-label': `Contact ${number}: ${said.join('; ')}`
            },
            ...shapes, ...picture.labels()),
        element(
            'figcaption', {}, element('strong', {}, `Contact ${number}`), ` ${mu}`,
            ...said.map((text, i) => element('span', {class: `run-${i}`}, ...indexed(text)))));
  }
}
