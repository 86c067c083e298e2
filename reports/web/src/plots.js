// SPDX-License-Identifier: Apache-2.0
// What the figures of a report are made of. Colours are those of the style sheet, so that they follow it into
// the dark and onto paper.
import {axisX, axisY, dot, gridX, gridY, plot, ruleX, ruleY} from '../vendor/plot.js';

import {element} from './dom.js';

export const colours = [1, 2, 3, 4, 5, 6, 7, 8].map(i => `var(--c${i})`);
export const symbols = ['circle', 'diamond', 'square', 'triangle', 'star', 'cross', 'wye'];

// ---- Numbers for people ----

export const count = x => x.toLocaleString('en');
export const rate = x => x.toLocaleString('en', {maximumSignificantDigits: 3});
export const share = x => `${rate(100 * x)} %`;
export const contactsOf = n => n === 1 ? '1 contact' : `${n} contacts`;

// "30 % [6.67, 65.2]": in three digits, or as many as tell the ends from the value.
export function withInterval(value, low, high, unit = '') {
  let digits = 3;
  while (digits < 15 && [low, high].some(end => end !== value && end.toPrecision(digits) === value.toPrecision(digits)))
    ++digits;
  const text = x => x.toLocaleString('en', {maximumSignificantDigits: digits});
  return `${text(value)}${unit} [${text(low)}, ${text(high)}]`;
}

// "3 of 10: 30 % [6.67, 65.2]"
export const told = line => `${count(line.count ?? line.solved)} of ${count(line.of ?? line.asked)}: ` +
    withInterval(100 * line.share, 100 * line.low, 100 * line.high, ' %');

// 0.01, 20, 1k, 1M.
export function shortNumber(x) {
  if (x >= 1e6) return `${rate(x / 1e6)}M`;
  return x >= 1e3 ? `${rate(x / 1e3)}k` : rate(x);
}

// ---- Rows ----

export const unique = values => [...new Set(values)];
export const ascending = values => [...values].sort((a, b) => a - b);
export const sum = (rows, value) => rows.reduce((all, row) => all + value(row), 0);

// A map of arrays, in the order in which the keys come.
export function groupBy(rows, key) {
  const groups = new Map();
  for (const row of rows) groups.set(key(row), [...groups.get(key(row)) ?? [], row]);
  return groups;
}

// ---- Plots ----

export const xAxis = options => axisX({tickSize: 0, labelArrow: 'none', labelAnchor: 'center', ...options});
export const yAxis = options => axisY({tickSize: 0, labelArrow: 'none', labelAnchor: 'top', ...options});
export const lines = (axis, tickSpacing) =>
    (axis === 'x' ? gridX : gridY)({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing});

// Ticks of a logarithmic axis, and lines at them: powers of ten, and 2 and 5 of each where these are few.
export function logTicks([low, high]) {
  const powers = [];
  for (let e = Math.floor(Math.log10(low)); 10 ** e <= high; ++e) powers.push(10 ** e);
  const all = powers.length > 2 ? powers : powers.flatMap(x => [x, 2 * x, 5 * x]);
  return all.filter(x => x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9));
}
export const logLines = domain => gridY({stroke: 'var(--line)', strokeOpacity: 1, ticks: logTicks(domain)});
export const logAxis = (domain, tickFormat) => yAxis({ticks: logTicks(domain), tickFormat});

// A plot with a name, and without the style element that it brings and the policy of the page refuses.
export function drawn(options, label) {
  const svg = plot({className: 'plot-svg', ariaLabel: label, style: {fontSize: '12px'}, ...options});
  for (const style of svg.querySelectorAll('style')) style.remove();
  svg.setAttribute('role', 'img');
  return svg;
}

export const histogram = {
  height: 184,
  marginLeft: 54,
  marginTop: 22,
  marginBottom: 34,
  marginRight: 16
};

// Shares of runs by their steps: bars from the floor, on a logarithmic scale.
export const stepsChart = ({most, floor, bars, ...frame}, label) => drawn(
    {
      ...histogram,
      ...frame,
      x: {domain: [-0.5, most + 1], label: 'steps'},
      y: {type: 'log', domain: [floor, 1], label: 'share of runs, %'},
      marks: [logLines([floor, 1]), logAxis([floor, 1], share), xAxis({tickSpacing: 45}), ...bars]
    },
    label);

// A plot below its title, of those that stand beside each other.
export const small = (title, svg) =>
    element('div', {class: 'small'}, element('p', {class: 'title'}, title), svg);
export const grid = parts => element('div', {class: 'smalls'}, ...parts);

// How wide each of so many is: as many beside each other as there is room for, and every row filled.
export function widths(width, least, count) {
  const gap = 16, most = Math.max(1, Math.floor((width + gap) / (least + gap))), rows = Math.ceil(count / most);
  return Array.from({length: rows}, (_, row) => Math.floor((count + rows - 1 - row) / rows))
      .flatMap(many => Array(many).fill(Math.floor((width - gap * (many - 1)) / many)));
}

// Texts with the class that has their colour.
const legend = entries =>
    element('ul', {class: 'legend'}, ...entries.map(([text, style]) => element('li', {class: style}, text)));

// `draw(width)`, an element, with its legend beside it where there is room, otherwise above.
export function withLegend(width, entries, draw) {
  const kLegend = 160;
  if (width < 560) return [legend(entries), draw(width)];
  return [element('div', {class: 'with-legend'}, draw(width - kLegend), legend(entries))];
}

// Marks of shares with their intervals: upwards, or (`across`) from left to right. `shift` in pixels, aside.
export function shares(rows, {at, series, shift, title, across = false}) {
  const look = {stroke: colours[series % colours.length], strokeWidth: 1.6};
  const mark =
      {r: 3.4, symbol: symbols[series % symbols.length], fill: colours[series % colours.length], title};
  return across ?
      [
        ruleY(rows, {y: at, x1: 'low', x2: 'high', dy: shift, ...look}),
        dot(rows, {y: at, x: 'share', dy: shift, ...mark})
      ] :
      [
        ruleX(rows, {x: at, y1: 'low', y2: 'high', dx: shift, ...look}),
        dot(rows, {x: at, y: 'share', dx: shift, ...mark})
      ];
}

// How far aside each of several series stands.
export const aside = (i, many, distance) => (i - (many - 1) / 2) * distance;

// Shares from left to right, a line for each `at(row)`, in the colours of `series(row)`.
// `each`: what `at` names; `of`: what the shares are of.
export function shareLines(
    rows, label, {width, at, series = () => 0, title, left, height = 22, each, of = 'share of those asked'}) {
  const groups = [...groupBy(rows, series).values()], places = unique(rows.map(at));
  const most = Math.min(1, 1.02 * Math.max(...rows.map(row => row.high)));
  return drawn(
      {
        width,
        height: places.length * height + 60,
        marginLeft: left,
        marginTop: 20,
        marginBottom: 36,
        marginRight: 26,
        x: {domain: [0, most], label: of},
        y: {type: 'band', domain: places, label: each},
        marks: [
          lines('x', 70), xAxis({tickFormat: share, tickSpacing: 70}), yAxis({tickFormat: name => name}),
          ...groups.flatMap(
              (group, i) =>
                  shares(group, {at, series: i, shift: aside(i, groups.length, 7), title, across: true}))
        ]
      },
      label);
}
