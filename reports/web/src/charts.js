// SPDX-License-Identifier: Apache-2.0
// Lines over time, small, with a mark at the moment that is shown.
import {element, svgElement} from './dom.js';
import {short} from './numbers.js';

const kWidth = 350, kHeight = 140, kLeft = 84, kRight = 8, kTop = 8, kBottom = 22;

// In three digits, however small.
function level(x) {
  const text = Math.abs(x) >= 1e-3 || x === 0 ? Number(x.toPrecision(3)).toString() : x.toExponential(2);
  return text.replaceAll('-', '−');
}

const path = points =>
    points.map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x.toFixed(1)},${y.toFixed(1)}`).join('');

// `series`: {name, values}, a value for each of `times`, in ascending order. `atLeast`: what the range holds
// besides. Numbers that are not finite, which the data have as text, leave a gap.
export class Chart {
  constructor(title, unit, times, series, atLeast = []) {
    const all = [...series.flatMap(({values}) => values), ...atLeast].filter(Number.isFinite);
    const low = Math.min(...all), high = Math.max(...all), end = Math.max(times.at(-1), Number.MIN_VALUE);
    const across = time => kLeft + time / end * (kWidth - kLeft - kRight);
    const span = high - low || 1;  // of a constant, a line at the bottom
    const up = value => kTop + (low + span - value) / span * (kHeight - kTop - kBottom);
    this.x = times.map(across);
    this.cursor = svgElement('line', {class: 'cursor', y1: kTop, y2: kHeight - kBottom});
    const label = (x, y, anchor, text) => svgElement('text', {x, y, 'text-anchor': anchor}, text);
    const lines = series.map(({values}, i) => {
      const points = values.map((value, k) => Number.isFinite(value) ? [this.x[k], up(value)] : null);
      return svgElement('path', {class: `line line-${i}`, d: path(points.filter(point => point !== null))});
    });
    const levels = high === low ? [high] : [low, high];
    const told = series.map(({name, values}) => {
      const finite = values.filter(Number.isFinite);
      return `${name} ${short(Math.min(...finite))} to ${short(Math.max(...finite))} ${unit}`;
    });
    const svg = svgElement(
        'svg', {viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'aria-label': `${title}: ${told.join(', ')}`},
        ...levels.map(
            value => svgElement(
                'line', {class: 'axis', x1: kLeft, x2: kWidth - kRight, y1: up(value), y2: up(value)})),
        ...levels.map(value => label(kLeft - 6, up(value) + 4, 'end', `${level(value)} ${unit}`)),
        label(kLeft, kHeight - 6, 'start', '0 s'),
        label(kWidth - kRight, kHeight - 6, 'end', `${short(end)} s`), ...lines, this.cursor);
    const keys = series.map(({name}, i) => element('span', {class: `line-${i}`}, name));
    this.node = element('figure', {class: 'chart'}, svg, element('figcaption', {}, `${title}: `, ...keys));
  }

  show(frame) {
    this.cursor.setAttribute('x1', this.x[frame]);
    this.cursor.setAttribute('x2', this.x[frame]);
  }
}
