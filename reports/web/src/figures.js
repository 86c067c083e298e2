// SPDX-License-Identifier: Apache-2.0
// The figures of a report. Each place in the page names its table and how it is drawn; colours are those of the style
// sheet, so that they follow it into the dark and onto paper.
import {axisX, axisY, barX, dot, gridX, gridY, plot, ruleX, ruleY, tickX} from '@observablehq/plot';
import {element} from './dom.js';

const colours = ['var(--c1)', 'var(--c2)', 'var(--c3)', 'var(--c4)', 'var(--c5)', 'var(--c6)', 'var(--c7)', 'var(--c8)'];
const outcomes = ['solved', 'cycle', 'stall', 'ray', 'singular', 'limit', 'undecided'];
const symbols = ['circle', 'diamond', 'square', 'triangle', 'star', 'cross', 'wye', 'asterisk'];

const count = x => x.toLocaleString('en');
const share = x => `${(100 * x).toLocaleString('en', {maximumSignificantDigits: 3})} %`;
const rate = x => x.toLocaleString('en', {maximumSignificantDigits: 3});
const contactsOf = n => n === 1 ? '1 contact' : `${n} contacts`;
const unique = values => [...new Set(values)];

// Objects by the names of the columns.
export const rowsOf = ({columns, rows}) =>
    rows.map(row => Object.fromEntries(columns.map((column, i) => [column, row[i]])));

// A plot with a name, and without the style element that it brings and the policy of the page refuses.
function drawn(options, label) {
  const svg = plot({className: 'plot-svg', ariaLabel: label, style: {fontSize: '12px'}, ...options});
  for (const style of svg.querySelectorAll('style')) style.remove();
  svg.setAttribute('role', 'img');
  return svg;
}

// One small plot beside the other, each below its title.
function small(title, svg) {
  const node = element('div', {class: 'small'});
  node.append(element('p', {class: 'title'}, title), svg);
  return node;
}

function legend(entries) {
  const list = element('ul', {class: 'legend'});
  for (const [text, style] of entries) {
    list.append(element('li', {class: style}, text));
  }
  return list;
}

const groupBy = (rows, key) => {
  const groups = new Map();
  for (const row of rows) {
    const name = key(row);
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(row);
  }
  return groups;
};

// How wide a small plot is: as many beside each other as the page has room for.
const columnWidth = (width, least) => {
  const many = Math.max(1, Math.floor((width + 16) / (least + 16)));
  return Math.floor((width - 16 * (many - 1)) / many);
};

// ---- Rates ----

function rates(by) {
  return {
    choices: rows => ({
      policy: unique(rows.map(row => row.policy)),
      outcome: unique(rows.filter(row => row.count > 0).map(row => row.outcome)),
    }),
    draw(rows, width, {policy, outcome = 'cycle'}) {
      const seen = rows.filter(row => row.by === by && row.policy === policy && row.outcome === outcome && row.runs > 0);
      const positive = seen.flatMap(row => [row.low, row.rate, row.high]).filter(x => x > 0);
      if (positive.length === 0) return [];
      const domain = [10 ** Math.floor(Math.log10(Math.min(...positive))), Math.max(...positive) * 1.1];
      const values = unique(seen.map(row => row.value)).sort((a, b) => numberOf(a) - numberOf(b));
      const series = by === 'contacts' ? [] : unique(seen.map(row => row.contacts)).sort((a, b) => a - b);
      const each = columnWidth(width, 250), parts = [];
      for (const [generator, all] of groupBy(seen, row => row.generator)) {
        const mine = by === 'contacts' ? all : all.filter(row => row.count > 0);
        const text = `${generator}: ${outcome} in a million runs, exactly, by ${names[by]}: ` +
            (mine.map(row => `${by === 'contacts' ? '' : contactsOf(row.contacts) + ', '}${row.value}: ${rate(row.rate)}`)
                 .join('; ') || 'none');
        if (mine.length === 0) continue;
        parts.push(small(generator, ratePlot(mine, text, {each, domain, values, series, by})));
      }
      if (parts.length === 0) return [];
      const none = unique(seen.map(row => row.generator)).filter(generator => !parts.some(part => part.firstChild.textContent === generator));
      const key = series.length === 0 ? [] : [legend(series.map(n => [contactsOf(n), `c${colourOf(n)}`]))];
      const rest = none.length === 0 ? [] : [element('p', {class: 'note'}, `None seen: ${none.join(', ')}.`)];
      return [...key, grid(parts), ...rest];
    }
  };
}

const names = {contacts: 'number of contacts', friction: 'friction coefficient', rank: 'rank of A at most'};
const numberOf = text => {
  const [above, below = 1] = String(text).split('/').map(Number);
  return Number.isNaN(above) ? Infinity : above / below;
};
const colourOf = n => (n - 1) % 8 + 1;
const colour = n => colours[colourOf(n) - 1];

function grid(parts) {
  const node = element('div', {class: 'smalls'});
  node.append(...parts);
  return node;
}

function ratePlot(rows, label, {each, domain, values, series, by}) {
  // Beside each other, where several stand at one value.
  const shift = row => series.length < 2 ? 0 : (series.indexOf(row.contacts) - (series.length - 1) / 2) * 4;
  const parts = [];
  for (const [contacts, mine] of groupBy(rows, row => by === 'contacts' ? 0 : row.contacts)) {
    const paint = contacts === 0 ? 'var(--bar)' : colour(contacts), dx = contacts === 0 ? 0 : shift(mine[0]);
    const some = mine.filter(row => row.count > 0), none = mine.filter(row => row.count === 0);
    parts.push(
        ruleX(some, {x: 'value', y1: 'low', y2: 'high', stroke: paint, strokeWidth: 1.6, dx}),
        ruleX(none, {x: 'value', y1: domain[0], y2: 'high', stroke: paint, strokeOpacity: 0.55, strokeDasharray: '2,3', dx}),
        dot(none, {x: 'value', y: 'high', symbol: 'triangle', rotate: 180, r: 3, stroke: paint, dx}),
        dot(some, {
          x: 'value', y: 'rate', r: 3.2, fill: paint, dx,
          title: row => `${row.generator}, ${contactsOf(row.contacts)}, ${names[by]} ${row.value}: ${count(row.count)} of ` +
              `${count(row.runs)} runs, ${rate(row.rate)} [${rate(row.low)}, ${rate(row.high)}] in a million`
        }));
  }
  return drawn({
    width: each, height: 190, marginLeft: 48, marginBottom: 34, marginTop: 10,
    x: {type: 'point', domain: values, label: names[by], labelArrow: 'none', padding: 0.6},
    y: {type: 'log', domain, label: null, clamp: true},
    marks: [gridY({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing: 35}), axisY({tickSpacing: 35, tickFormat: shortNumber, tickSize: 0}),
            axisX({tickSize: 0}), ...parts]
  }, label);
}

// 0.01, 10, 1k, 1M
function shortNumber(x) {
  if (Math.abs(Math.log10(x) - Math.round(Math.log10(x))) > 1e-9) return '';
  if (x >= 1e6) return `${rate(x / 1e6)}M`;
  return x >= 1e3 ? `${rate(x / 1e3)}k` : rate(x);
}

// ---- Shares with intervals ----

// A row for each `row(line)`, a dot for each of its lines in the colour and the symbol of `series(line)`.
function sharePlot(rows, label, {width, row, series, seriesNames, title, left = 120, height = 22, zero = true}) {
  const places = unique(rows.map(row)), most = Math.max(...rows.map(line => line.high));
  const dy = line => seriesNames.length < 2 ? 0 : (seriesNames.indexOf(series(line)) - (seriesNames.length - 1) / 2) *
          Math.min(7, (height - 6) / (seriesNames.length - 1));
  const parts = [];
  for (const [name, mine] of groupBy(rows, series)) {
    const i = seriesNames.indexOf(name), paint = colours[i % 8], shift = dy(mine[0]);
    parts.push(ruleY(mine, {y: row, x1: 'low', x2: 'high', stroke: paint, strokeWidth: 1.6, dy: shift}),
               dot(mine, {y: row, x: 'share', symbol: symbols[i % 8], r: 3.4, fill: paint, dy: shift, title}));
  }
  return drawn({
    width, height: places.length * height + 46, marginLeft: left, marginTop: 6, marginBottom: 36, marginRight: 22,
    x: {domain: [zero ? 0 : Math.min(...rows.map(line => line.low)), Math.min(1, most * 1.02)], label: 'share of those asked', labelArrow: 'none'},
    y: {type: 'band', domain: places, label: null},
    marks: [gridX({stroke: 'var(--line)', strokeOpacity: 1}), axisX({tickSize: 0, tickFormat: share, tickSpacing: 70}), axisY({tickSize: 0, tickFormat: x => x}), ...parts]
  }, label);
}

const told = line => `${count(line.count ?? line.solved)} of ${count(line.of ?? line.asked)}: ${share(line.share)} ` +
    `[${share(line.low)}, ${share(line.high)}]`;

const figures = {
  'rates.contacts': rates('contacts'),
  'rates.friction': rates('friction'),
  'rates.rank': rates('rank'),

  doubles: {
    choices: rows => ({policy: unique(rows.map(row => row.policy))}),
    draw(rows, width, {policy}) {
      const mine = rows.filter(row => row.policy === policy);
      const totals = new Map([...groupBy(mine, row => row.in_doubles)].map(([name, all]) => [name, all.reduce((sum, row) => sum + row.runs, 0)]));
      const name = outcome => outcome === 'solved' ? 'solved, but wrong' : outcome;
      const present = outcomes.filter(outcome => mine.some(row => row.exact === outcome));
      const label = 'Suspicious runs in doubles and their exact outcome: ' +
          mine.map(row => `${name(row.in_doubles)} is ${row.exact}: ${count(row.runs)}`).join('; ');
      const svg = drawn({
        width, height: totals.size * 34 + 50, marginLeft: Math.min(190, width * 0.4), marginRight: 22, marginTop: 6, marginBottom: 36,
        x: {domain: [0, 1], label: 'share of the suspicious runs', labelArrow: 'none'},
        y: {type: 'band', domain: outcomes.filter(outcome => totals.has(outcome)), label: null, padding: 0.2},
        marks: [
          axisX({tickSize: 0, tickFormat: share, tickSpacing: 70}),
          axisY({tickSize: 0, tickFormat: outcome => `${name(outcome)} (${count(totals.get(outcome))})`}),
          barX(mine, {
            y: 'in_doubles', x: row => row.runs / totals.get(row.in_doubles),
            fill: row => outcomeColours[row.exact], order: row => outcomes.indexOf(row.exact), insetRight: 1,
            title: row => `${name(row.in_doubles)} in doubles, exactly ${row.exact}: ${count(row.runs)} runs`
          })
        ]
      }, label);
      return [legend(present.map(outcome => [`exactly ${outcome}`, `o-${outcome}`])), svg];
    }
  },

  trust: {
    draw(rows, width) {
      const whats = unique(rows.map(row => row.what));
      return [grid(whats.map(what => {
        const mine = rows.filter(row => row.what === what), each = columnWidth(width, 360);
        return small(what, sharePlot(mine, `${what}: ` + mine.map(row => `${row.generator}: ${told(row)}`).join('; '), {
          width: each, row: line => line.generator, series: line => line.what, seriesNames: [what], title: line => `${line.generator}: ${told(line)}`
        }));
      }))];
    }
  },

  steps: {
    choices: rows => ({policy: unique(rows.map(row => row.policy))}),
    draw(rows, width, {policy}) {
      const mine = rows.filter(row => row.policy === policy);
      const most = Math.max(...mine.map(row => row.steps)), each = columnWidth(width, 250);
      const all = new Map([...groupBy(mine, row => row.contacts)].map(([n, part]) => [n, part.reduce((sum, row) => sum + row.runs, 0)]));
      const least = Math.min(...mine.map(row => row.runs / all.get(row.contacts)));
      const domain = [10 ** Math.floor(Math.log10(least)) * 0.7, 1];
      return [grid([...groupBy(mine, row => row.contacts)].map(([contacts, part]) => {
        const total = all.get(contacts), last = part.at(-1);
        return small(`${contactsOf(contacts)}, ${count(total)} runs`, drawn({
          width: each, height: 170, marginLeft: 44, marginTop: 8, marginBottom: 32, marginRight: 10,
          x: {domain: [-0.5, most + 1], label: 'steps', labelArrow: 'none'},
          y: {type: 'log', domain, label: null},
          marks: [
            gridY({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing: 32}),
            axisY({tickSize: 0, tickSpacing: 32, tickFormat: x => Math.abs(Math.log10(x) % 1) < 1e-9 ? share(x) : ''}),
            axisX({tickSize: 0, tickSpacing: 45}),
            ruleX(part, {
              x: 'steps', y1: domain[0], y2: row => row.runs / total, stroke: 'var(--bar)', strokeWidth: Math.max(1.4, (each - 60) / (most + 2) - 1),
              title: row => `${row.steps}${row.or_more === 'yes' ? ' or more' : ''} steps: ${count(row.runs)} runs, ${share(row.runs / total)}`
            }),
            last.or_more === 'yes' ? tickX([last], {x: 'steps', stroke: 'var(--ink)', strokeOpacity: 0.2}) : null
          ]
        }, `Steps per problem of ${contactsOf(contacts)}, ${count(total)} runs: from ${part[0].steps} to ${last.steps}` +
           `${last.or_more === 'yes' ? ' or more' : ''}, half of them at most ${medianOf(part, total)}`));
      }))];
    }
  },

  'loop-steps': {
    draw(rows, width) {
      const each = columnWidth(width, 250), most = Math.max(...rows.map(row => row.zero_steps));
      return [grid([...groupBy(rows, row => row.contacts)].map(([contacts, part]) => {
        const total = part.reduce((sum, row) => sum + row.loops, 0);
        return small(`${contactsOf(contacts)} in the period, ${count(total)} loop${total === 1 ? '' : 's'}`, drawn({
          width: each, height: 160, marginLeft: 44, marginTop: 8, marginBottom: 32, marginRight: 10,
          x: {domain: [-0.5, most + 0.5], label: 'steps of length zero in a period', labelArrow: 'none'},
          y: {domain: [0, Math.max(...part.map(row => row.loops)) / total], label: null},
          marks: [
            gridY({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing: 40}),
            axisY({tickSize: 0, tickSpacing: 40, tickFormat: share}), axisX({tickSize: 0, tickSpacing: 40, tickFormat: x => Number.isInteger(x) ? `${x}` : ''}),
            ruleX(part, {
              x: 'zero_steps', y1: 0, y2: row => row.loops / total, stroke: 'var(--loop)', strokeWidth: Math.min(22, Math.max(2, (each - 60) / (most + 1) - 2)),
              title: row => `${row.zero_steps} of length zero: ${count(row.loops)} of ${count(total)} loops`
            })
          ]
        }, `Steps of length zero in the period of ${count(total)} loops of ${contactsOf(contacts)}: ` +
           part.map(row => `${row.zero_steps}: ${count(row.loops)}`).join('; ')));
      }))];
    }
  },

  pivoting: {
    choices: rows => ({policy: unique(rows.map(row => row.policy))}),
    draw(rows, width, {policy}) {
      const mine = rows.filter(row => row.policy === policy), whats = unique(mine.map(row => row.what));
      const each = columnWidth(width, 250), most = Math.max(...mine.map(row => row.high));
      const values = unique(mine.map(row => row.contacts)).sort((a, b) => a - b);
      return [legend(whats.map((what, i) => [what, `c${i + 1}`])), grid([...groupBy(mine, row => row.generator)].map(([generator, part]) =>
        small(generator, drawn({
          width: each, height: 170, marginLeft: 46, marginTop: 8, marginBottom: 32, marginRight: 10,
          x: {type: 'point', domain: values, label: 'number of contacts', labelArrow: 'none', padding: 0.6},
          y: {domain: [0, most], label: null},
          marks: [
            gridY({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing: 40}), axisY({tickSize: 0, tickSpacing: 40, tickFormat: share}), axisX({tickSize: 0}),
            ...whats.flatMap((what, i) => {
              const lines = part.filter(row => row.what === what), dx = (i - (whats.length - 1) / 2) * 6;
              return [ruleX(lines, {x: 'contacts', y1: 'low', y2: 'high', stroke: colours[i], strokeWidth: 1.6, dx}),
                      dot(lines, {x: 'contacts', y: 'share', r: 3.2, symbol: symbols[i], fill: colours[i], dx, title: row => `${generator}, ${contactsOf(row.contacts)}, ${what}: ${told(row)}`})];
            })
          ]
        }, `${generator}: ` + part.map(row => `${contactsOf(row.contacts)}, ${row.what}: ${share(row.share)}`).join('; ')))))];
    }
  },

  driving: {
    draw(rows, width) {
      const whats = unique(rows.map(row => row.what));
      return [legend(whats.map((what, i) => [`with ${what}`, `c${i + 1}`])), sharePlot(rows,
        'Share of the paths of complete driving: ' + rows.map(row => `${contactsOf(row.contacts)}, with ${row.what}: ${told(row)}`).join('; '),
        {width: Math.min(width, 760), row: line => contactsOf(line.contacts), series: line => line.what, seriesNames: whats, left: 84, height: 34,
         title: line => `${contactsOf(line.contacts)}, with ${line.what}: ${told(line)}`})];
    }
  },

  methods: {
    draw(rows, width) {
      const each = columnWidth(width, 330);
      return [grid([...groupBy(rows, row => `${row.method}: ${row.asked_about}`)].map(([name, part]) => small(name, sharePlot(part,
        `${name}, share solved: ` + part.map(row => `${contactsOf(row.contacts)}: ${told(row)}`).join('; '),
        {width: each, row: line => contactsOf(line.contacts), series: () => name, seriesNames: [name], left: 84, title: line => `${contactsOf(line.contacts)}: ${told(line)}`}))))];
    }
  },

  rungs: {
    draw(rows, width) {
      const each = columnWidth(width, 330);
      const times = rows.map(row => Math.max(row.microseconds, 1e-3)), most = Math.max(0.01, ...rows.map(row => row.lost));
      return [grid([...groupBy(rows, row => row.family)].map(([family, part]) => small(family, drawn({
        width: each, height: 220, marginLeft: 48, marginTop: 10, marginBottom: 34, marginRight: 16,
        x: {type: 'log', domain: [Math.min(...times) / 1.3, Math.max(...times) * 1.3], label: 'microseconds', labelArrow: 'none'},
        y: {domain: [0, most], label: null},
        marks: [
          gridY({stroke: 'var(--line)', strokeOpacity: 1, tickSpacing: 45}), axisY({tickSize: 0, tickSpacing: 45, tickFormat: share}), axisX({tickSize: 0, tickFormat: shortNumber}),
          dot(part, {
            x: row => Math.max(row.microseconds, 1e-3), y: 'lost', r: 4, stroke: 'var(--bar)', strokeWidth: 1.5,
            fill: row => ['filtered', 'exact'].includes(row.arithmetic) ? 'var(--bar)' : 'none',
            title: row => `${row.method} ${row.arithmetic}: ${rate(row.microseconds)} microseconds, ${count(row.solved)} solved, ${count(row.wrong)} wrong, ` +
                `${count(row.undecided)} undecided of ${count(row.asked)}`
          })
        ]
      }, `Time and lost answers on ${family}: ` + part.map(row => `${row.method} ${row.arithmetic}: ${rate(row.microseconds)} microseconds, ${share(row.lost)} lost`).join('; ')))))];
    }
  },
};

const outcomeColours = Object.fromEntries(outcomes.map(outcome => [outcome, `var(--o-${outcome})`]));

function medianOf(part, total) {
  let sum = 0;
  for (const row of part) {
    sum += row.runs;
    if (2 * sum >= total) return row.steps;
  }
  return part.at(-1).steps;
}

// ---- Places in the page ----

class Place {
  constructor(node, figure, rows) {
    this.node = node;
    this.figure = figure;
    this.rows = rows;
    this.drawing = node.querySelector('.drawing');
    this.chosen = {};
    for (const [name, values] of Object.entries(figure.choices?.(rows) ?? {})) this.addChoice(name, values);
  }

  // The reference reading, or a loop, where there is one.
  addChoice(name, values) {
    this.chosen[name] = values.find(value => value === 'paper' || value === 'cycle') ?? values[0];
    if (values.length < 2) return;
    const select = element('select');
    for (const value of values) select.append(element('option', {}, value));
    select.value = this.chosen[name];
    select.addEventListener('change', () => {
      this.chosen[name] = select.value;
      this.draw();
    });
    const label = element('label', {class: 'choice'}, `${name} `);
    label.append(select);
    this.drawing.before(label);
  }

  draw() {
    this.width = this.drawing.clientWidth;
    const parts = this.width === 0 ? [] : this.figure.draw(this.rows, this.width, this.chosen);
    this.drawing.replaceChildren(...(parts.length > 0 ? parts : [element('p', {class: 'note'}, 'Nothing to draw: none was seen.')]));
  }
}

// Draws one after the other, so that the page can be read meanwhile; and again where the width changes.
export function drawFigures(tables) {
  const places = [];
  for (const node of document.querySelectorAll('figure[data-figure]')) {
    const name = node.dataset.figure, table = tables[name.split('.')[0]];
    if (table === undefined) {
      node.remove();
    } else {
      places.push(new Place(node, figures[name], rowsOf(table)));
    }
  }
  const widths = new ResizeObserver(() => {
    for (const place of places) {
      if (place.width !== undefined && place.drawing.clientWidth !== place.width) place.draw();
    }
  });
  const next = i => {
    if (i === places.length) {
      document.documentElement.dataset.drawn = 'all';
      return;
    }
    places[i].draw();
    widths.observe(places[i].drawing);
    setTimeout(next, 0, i + 1);
  };
  setTimeout(next, 0, 0);
}
