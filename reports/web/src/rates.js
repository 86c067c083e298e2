// SPDX-License-Identifier: Apache-2.0
// Figures of exact rates: a small plot for each generator, on a logarithmic scale that all of them share.
// Colour and symbol are the number of contacts, where that is not the axis itself.
import {dot, ruleX} from '../vendor/plot.js';

import {element} from './dom.js';
import * as p from './plots.js';

const names = {
  contacts: 'number of contacts',
  friction: 'friction coefficient',
  rank: 'rank of A at most'
};

// "1/2" < "2" < "mixed"
const numberOf = text => {
  const [above, below = 1] = text.split('/').map(Number);
  return Number.isNaN(above) ? Infinity : above / below;
};

// Of all generators together: a plot for each number of contacts, by friction coefficient.
function oftenPlot(rows, {width, domain, values}) {
  const told = row => `μ = ${row.friction}, ${p.contactsOf(row.contacts)}: ${p.count(row.loops)} of ${
      p.count(row.runs)} runs, ${p.withInterval(row.rate, row.low, row.high)} in a million`;
  const series = rows[0].contacts - 1, some = rows.filter(row => row.loops > 0), none = rows.filter(row => row.loops === 0);
  const stroke = 'var(--loop)', line = {x: 'friction', y2: 'high', stroke, strokeWidth: 1.8};
  return p.small(
      p.contactsOf(rows[0].contacts),
      p.drawn(
          {
            width,
            height: 230,
            marginLeft: 40,
            marginBottom: 36,
            marginTop: 24,
            marginRight: 14,
            x: {type: 'point', domain: values, label: 'friction coefficient μ', padding: 0.4},
            y: {type: 'log', domain, label: 'loops in a million runs', clamp: true},
            marks: [
              p.logLines(domain), p.logAxis(domain, p.shortNumber),
              p.xAxis({ticks: fitting(values, width)}), ruleX(some, {y1: 'low', ...line}),
              ruleX(none, {y1: domain[0], ...line, strokeOpacity: 0.6, strokeDasharray: '2,3'}),
              dot(none, {x: 'friction', y: 'high', symbol: 'triangle', rotate: 180, r: 3.4, stroke, title: told}),
              dot(some, {x: 'friction', y: 'rate', r: 4, fill: stroke, title: told})
            ]
          },
          `${p.contactsOf(series + 1)}, loops in a million runs by friction coefficient: ${
              some.map(row => `${row.friction}: ${p.rate(row.rate)}`).join('; ') || 'none seen'}`));
}

export function drawOften(rows, width, {policy}) {
  const mine = rows.filter(row => row.policy === policy), groups = [...p.groupBy(mine, row => row.contacts).values()];
  if (!mine.some(row => row.loops > 0)) return [];
  const ends = mine.flatMap(row => row.loops > 0 ? [row.low, row.high] : [row.high]);
  const options = {
    domain: [10 ** Math.floor(Math.log10(Math.min(...ends))), Math.max(...ends) * 1.1],
    values: p.unique(mine.map(row => row.friction)).sort((a, b) => numberOf(a) - numberOf(b)),
  };
  const widths = p.widths(width, 190, groups.length);
  return [p.grid(groups.map((group, i) => oftenPlot(group, {...options, width: widths[i]})))];
}

const titleOf = by => row => `${row.generator}, ${p.contactsOf(row.contacts)}, ${names[by]} ${row.value}: ` +
    `${p.count(row.count)} of ${p.count(row.runs)} runs, ${p.withInterval(row.rate, row.low, row.high)} in a million`;

// As many of the values as there is room for.
const fitting = (values, width) =>
    values.filter((_, i) => i % Math.ceil(values.length * 24 / (width - 60)) === 0);

// Marks of the rows of one number of contacts. Where none was seen the rate is below the tip of a triangle.
function marks(rows, by, floor, shift) {
  const i = by === 'contacts' ? 0 : rows[0].contacts - 1, stroke = p.colours[i % p.colours.length];
  const some = rows.filter(row => row.count > 0), none = rows.filter(row => row.count === 0);
  const line = {x: 'value', y2: 'high', stroke, strokeWidth: 1.6, dx: shift};
  return [
    ruleX(some, {y1: 'low', ...line}),
    ruleX(none, {y1: floor, ...line, strokeOpacity: 0.6, strokeDasharray: '2,3'}),
    dot(none, {x: 'value', y: 'high', symbol: 'triangle', rotate: 180, r: 3, stroke, dx: shift}), dot(some, {
      x: 'value',
      y: 'rate',
      r: 3.2,
      fill: stroke,
      symbol: p.symbols[i % p.symbols.length],
      dx: shift,
      title: titleOf(by)
    })
  ];
}

function ratePlot(rows, by, outcome, {width, domain, values, contacts}) {
  const groups = by === 'contacts' ? [rows] : [...p.groupBy(rows, row => row.contacts).values()];
  const seen = rows.filter(row => row.count > 0)
                   .map(
                       row => `${by === 'contacts' ? '' : `${p.contactsOf(row.contacts)}, `}${row.value}: ${
                           p.rate(row.rate)}`);
  const shift = group =>
      by === 'contacts' ? 0 : p.aside(contacts.indexOf(group[0].contacts), contacts.length, 4);
  return p.drawn(
      {
        width,
        height: 200,
        marginLeft: 48,
        marginBottom: 34,
        marginTop: 22,
        x: {type: 'point', domain: values, label: names[by], padding: 0.6},
        y: {type: 'log', domain, label: 'in a million runs', clamp: true},
        marks: [
          p.logLines(domain), p.logAxis(domain, p.shortNumber),
          p.xAxis({ticks: fitting(values, width)}),
          ...groups.flatMap(group => marks(group, by, domain[0], shift(group)))
        ]
      },
      `${rows[0].generator}: ${outcome} in a million runs, exactly, by ${names[by]}: ${
          seen.join('; ') || 'none seen'}`);
}

function draw(by, rows, width, {policy, outcome}) {
  const all = rows.filter(row => row.by === by && row.policy === policy && row.outcome === outcome);
  const ends = all.flatMap(row => row.count > 0 ? [row.low, row.high] : [row.high]);
  if (!all.some(row => row.count > 0)) return [];
  const options = {
    domain: [10 ** Math.floor(Math.log10(Math.min(...ends))), Math.max(...ends) * 1.1],
    values: p.unique(all.map(row => row.value)).sort((a, b) => numberOf(a) - numberOf(b)),
    contacts: p.ascending(p.unique(all.filter(row => row.count > 0).map(row => row.contacts))),
  };
  const shown = [], none = [];
  for (const [generator, mine] of p.groupBy(all, row => row.generator)) {
    const some = by === 'contacts' ? mine : mine.filter(row => row.count > 0);
    if (some.length === 0)
      none.push(generator);
    else
      shown.push([generator, some]);
  }
  const key = options.contacts.map(n => [p.contactsOf(n), `c${(n - 1) % p.colours.length + 1}`]);
  const plots = across => {
    const widths = p.widths(across, 250, shown.length);
    return p.grid(shown.map(
        ([generator, some], i) =>
            p.small(generator, ratePlot(some, by, outcome, {...options, width: widths[i]}))));
  };
  return [
    ...by === 'contacts' ? [plots(width)] : p.withLegend(width, key, plots),
    ...none.length === 0 ? [] : [element('p', {class: 'note'}, `None seen: ${none.join(', ')}.`)]
  ];
}

export const rates = by => ({
  choices: rows => ({
    policy: p.unique(rows.map(row => row.policy)),
    outcome: p.unique(rows.filter(row => row.count > 0).map(row => row.outcome)),
  }),
  draw: (rows, width, chosen) => draw(by, rows, width, chosen),
});
