// SPDX-License-Identifier: Apache-2.0
// The figures of two campaigns, of the cells of their CSV files.
import {dot, ruleX, ruleY} from '../vendor/plot.js';

import * as p from './plots.js';

const sides = ['a', 'b'], names = ['A', 'B'];
const key = names.map((name, i) => [name, `c${i + 1}`]);

// Method and arithmetic are named where they are not as usual.
const place = row => [p.contactsOf(Number(row.contacts)), row.method === 'baraff' ? '' : row.method,
                      row.arithmetic === 'double' ? '' : row.arithmetic].filter(Boolean).join(', ');

// ---- Rates ----

// The two sides of a row: counts, and rates in a million.
const sidesOf = row => sides.map((side, i) => {
  const number = name => Number(row[`${side}_${name}`]);
  const [rate, low, high] = ['rate', 'low', 'high'].map(name => 1e6 * number(name));
  return {place: place(row), i, generator: row.generator, count: number('count'), of: number('of'), rate, low, high};
});

const told = line => `${line.generator}, ${line.place}, ${names[line.i]}: ${p.count(line.count)} of ` +
    `${p.count(line.of)}, ${p.withInterval(line.rate, line.low, line.high)} in a million`;

// Where none was seen the rate is below the tip of a triangle.
function marks(lines, i, floor) {
  const stroke = p.colours[i], dy = p.aside(i, 2, 9), look = {y: 'place', dy, stroke};
  const some = lines.filter(line => line.count > 0), none = lines.filter(line => line.count === 0);
  const end = {y: 'place', dy, title: told};
  return [
    ruleY(some, {x1: 'low', x2: 'high', strokeWidth: 1.8, ...look}),
    ruleY(none, {x1: floor, x2: 'high', strokeWidth: 1.6, strokeDasharray: '2,3', ...look}),
    dot(none, {x: 'high', symbol: 'triangle', rotate: -90, r: 3.4, fill: stroke, ...end}),
    dot(some, {x: 'rate', symbol: p.symbols[i], r: 3.8, fill: stroke, ...end})
  ];
}

function ratePlot(generator, lines, width, domain) {
  const places = p.unique(lines.map(line => line.place));
  const longest = Math.max(...places.map(name => name.length));
  return p.small(
      generator,
      p.drawn(
          {
            width,
            height: places.length * 34 + 60,
            marginLeft: Math.min(width * 0.4, 16 + 6.5 * longest),
            marginTop: 20,
            marginBottom: 36,
            marginRight: 26,
            x: {type: 'log', domain, label: 'in a million runs', clamp: true},
            y: {type: 'band', domain: places, label: 'contacts'},
            marks: [
              p.lines('x', 60), p.xAxis({ticks: p.logTicks(domain), tickFormat: p.shortNumber}),
              p.yAxis({tickFormat: name => name}),
              ...sides.flatMap((_, i) => marks(lines.filter(line => line.i === i), i, domain[0]))
            ]
          },
          lines.map(told).join('; ')));
}

function drawRates(rows, width, {policy, measure}) {
  const lines = rows.filter(row => row.friction === '' && row.policy === policy && row.measure === measure)
                    .flatMap(sidesOf)
                    .filter(line => line.of > 0);
  if (!lines.some(line => line.count > 0)) return [];
  const ends = lines.flatMap(line => line.count > 0 ? [line.low, line.high] : [line.high]);
  // A line that reaches down to nothing still has room.
  const domain = [10 ** Math.floor(Math.log10(Math.min(...ends) / 1.5)), Math.max(...ends) * 1.1];
  const groups = [...p.groupBy(lines, line => line.generator)];
  return p.withLegend(width, key, across => {
    const widths = p.widths(across, 360, groups.length);
    return p.grid(groups.map(([generator, mine], i) => ratePlot(generator, mine, widths[i], domain)));
  });
}

// Steps have a figure of their own.
const drawable = row =>
    row.friction === '' && !row.measure.startsWith('steps-above') && Number(row.a_count) + Number(row.b_count) > 0;

// ---- Steps ----

const runsOf = (row, i) => Number(row[`${sides[i]}_problems`]);

function stepsPlot(rows, width, {most, floor}) {
  const totals = sides.map((_, i) => p.sum(rows, row => runsOf(row, i)));
  const stepsOf = row => `${row.steps}${row.or_more === 'yes' ? ' or more' : ''}`;
  const thick = Math.max(1, (width - 66) / (most + 2) / 2 - 0.6);
  const bars = (_, i) => ruleX(rows.filter(row => runsOf(row, i) > 0), {
    x: row => Number(row.steps),
    y1: floor,
    y2: row => runsOf(row, i) / totals[i],
    dx: p.aside(i, 2, thick),
    stroke: p.colours[i],
    strokeWidth: thick,
    title: row => `${names[i]}, ${stepsOf(row)} steps: ${p.count(runsOf(row, i))} runs, ` +
        p.share(runsOf(row, i) / totals[i])
  });
  const title = `${rows[0].generator}, ${place(rows[0])}`;
  return p.small(
      title,
      p.stepsChart(
          {width, height: 194, most, floor, bars: sides.map(bars)},
          `Steps of ${title}: ` +
              sides.map((_, i) => `${names[i]}, ${p.count(totals[i])} runs, from ${
                            stepsOf(rows.find(row => runsOf(row, i) > 0))} to ${
                            stepsOf(rows.filter(row => runsOf(row, i) > 0).at(-1))}`).join('; ')));
}

function drawSteps(rows, width, {policy}) {
  const groups = [...p.groupBy(rows.filter(row => row.policy === policy), row => `${row.generator}, ${place(row)}`)
                      .values()].filter(group => sides.every((_, i) => group.some(row => runsOf(row, i) > 0)));
  if (groups.length === 0) return [];
  const shares = groups.flatMap(group => sides.flatMap((_, i) => {
    const total = p.sum(group, row => runsOf(row, i));
    return group.map(row => runsOf(row, i) / total).filter(share => share > 0);
  }));
  const options = {
    most: Math.max(...groups.flat().map(row => Number(row.steps))),
    floor: 0.7 * 10 ** Math.floor(Math.log10(Math.min(...shares)))
  };
  return p.withLegend(width, key, across => {
    const widths = p.widths(across, 300, groups.length);
    return p.grid(groups.map((group, i) => stepsPlot(group, widths[i], options)));
  });
}

export const compared = {
  'comparison': {
    choices: rows => ({
      policy: p.unique(rows.map(row => row.policy)),
      measure: p.unique(rows.filter(drawable).map(row => row.measure)),
    }),
    draw: drawRates
  },
  'comparison_steps': {choices: rows => ({policy: p.unique(rows.map(row => row.policy))}), draw: drawSteps},
};
