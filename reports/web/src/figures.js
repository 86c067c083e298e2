// SPDX-License-Identifier: Apache-2.0
// The figures of a report, by the names of their places in the page (../../page/page.h has the tables).
// `choices(rows)`: what can be chosen, by column; `draw(rows, width, chosen)`: elements.
import {barX, dot, ruleX, ruleY} from '../vendor/plot.js';

import * as p from './plots.js';
import {drawOften, rates} from './rates.js';

const outcomes = ['solved', 'cycle', 'stall', 'ray', 'singular', 'limit', 'undecided'];
const byPolicy = rows => ({policy: p.unique(rows.map(row => row.policy))});

// ---- Doubles ----

function drawDoubles(rows, width, {policy}) {
  const mine = rows.filter(row => row.policy === policy);
  const totals = new Map([...p.groupBy(mine, row => row.in_doubles)].map(
      ([outcome, all]) => [outcome, p.sum(all, row => row.runs)]));
  const name = outcome => outcome === 'solved' ? 'solved, but wrong' : outcome;
  const bar = {
    y: 'in_doubles',
    x: row => row.runs / totals.get(row.in_doubles),
    fill: row => `var(--o-${row.exact})`,
    order: row => outcomes.indexOf(row.exact),
    insetRight: 1,
    title: row => `${name(row.in_doubles)} in doubles, exactly ${row.exact}: ${p.count(row.runs)} runs`
  };
  const drawn = across => p.drawn(
      {
        width: across,
        height: totals.size * 34 + 64,
        marginLeft: Math.min(190, across * 0.4),
        marginRight: 26,
        marginTop: 20,
        marginBottom: 36,
        x: {domain: [0, 1], label: 'share of the suspicious runs, %'},
        y: {
          type: 'band',
          domain: outcomes.filter(outcome => totals.has(outcome)),
          label: 'said by doubles (runs)',
          padding: 0.2
        },
        marks: [
          p.xAxis({tickFormat: p.share, tickSpacing: 70}),
          p.yAxis({tickFormat: outcome => `${name(outcome)} (${p.count(totals.get(outcome))})`}),
          barX(mine, bar)
        ]
      },
      'Suspicious runs in doubles and their exact outcome: ' +
          mine.map(row => `${name(row.in_doubles)} is ${row.exact}: ${p.count(row.runs)}`).join('; '));
  const present = outcomes.filter(outcome => mine.some(row => row.exact === outcome));
  return p.withLegend(width, present.map(outcome => [`exactly ${outcome}`, `o-${outcome}`]), drawn);
}

function drawTrust(rows, width) {
  const groups = [...p.groupBy(rows, row => row.what)], widths = p.widths(width, 360, groups.length);
  const plots = groups.map(
      ([what, mine], i) => p.small(
          what,
          p.shareLines(mine, `${what}: ${mine.map(row => `${row.generator}: ${p.told(row)}`).join('; ')}`, {
            width: widths[i],
            at: row => row.generator,
            each: 'generator',
            of: `share of ${what.startsWith('audited') ? 'the audited' : 'all'} runs, %`,
            left: 120,
            title: row => `${row.generator}: ${p.told(row)}`
          })));
  return [p.grid(plots)];
}

// ---- Steps ----

// A bar for each row from the floor to its share.
const bars = (rows, x, floor, total, paint, width, title) => ruleX(
    rows, {x, y1: floor, y2: row => (row.runs ?? row.loops) / total, stroke: paint, strokeWidth: width, title});

function medianOf(rows, total) {
  let below = 0;
  return rows.find(row => 2 * (below += row.runs) >= total).steps;
}

function stepsPlot(rows, {width, most, floor}) {
  const total = p.sum(rows, row => row.runs), last = rows.at(-1), contacts = p.contactsOf(rows[0].contacts);
  const stepsOf = row => `${row.steps}${row.or_more === 'yes' ? ' or more' : ''}`;
  const title = row => `${stepsOf(row)} steps: ${p.count(row.runs)} runs, ${p.share(row.runs / total)}`;
  const left = 72;  // room for 0.00001 %
  const thick = Math.max(1.4, (width - left - 6) / (most + 2) - 1);
  const svg = p.stepsChart(
      {width, marginLeft: left, most, floor, bars: [bars(rows, 'steps', floor, total, 'var(--bar)', thick, title)]},
      `Steps per problem of ${contacts}, ${p.count(total)} runs: from ${rows[0].steps} to ${
          stepsOf(last)}, half of them ` +
          `at most ${medianOf(rows, total)}`);
  return p.small(`${contacts}, ${p.count(total)} runs`, svg);
}

function drawSteps(rows, width, {policy}) {
  const groups = [...p.groupBy(rows.filter(row => row.policy === policy), row => row.contacts).values()];
  const least =
      Math.min(...groups.map(group => Math.min(...group.map(row => row.runs)) / p.sum(group, row => row.runs)));
  const widths = p.widths(width, 250, groups.length), options = {
    most: Math.max(...groups.map(group => group.at(-1).steps)),
    floor: 0.7 * 10 ** Math.floor(Math.log10(least))
  };
  return [p.grid(groups.map((group, i) => stepsPlot(group, {...options, width: widths[i]})))];
}

function loopStepsPlot(rows, {width, most}) {
  const total = p.sum(rows, row => row.loops), contacts = p.contactsOf(rows[0].contacts);
  const title = row => `${row.zero_steps} of length zero: ${p.count(row.loops)} of ${p.count(total)} loops`;
  const thick = Math.min(22, Math.max(2, (width - 60) / (most + 1) - 2));
  const svg =
      p.drawn(
          {
            ...p.histogram,
            width,
            x: {domain: [-0.5, most + 0.5], label: 'steps of length zero in a period'},
            y: {domain: [0, Math.max(...rows.map(row => row.loops)) / total], label: 'share of loops, %'},
            marks: [
              p.lines('y', 40), p.yAxis({tickSpacing: 40, tickFormat: p.share}),
              p.xAxis({tickSpacing: 40, tickFormat: x => Number.isInteger(x) ? `${x}` : ''}),
              bars(rows, 'zero_steps', 0, total, 'var(--loop)', thick, title)
            ]
          },
          `Steps of length zero in the period of ${p.count(total)} loops of ${contacts}: ` +
              rows.map(row => `${row.zero_steps}: ${p.count(row.loops)}`).join('; '));
  return p.small(`${contacts}: ${p.count(total)} loop${total === 1 ? '' : 's'}`, svg);
}

function drawLoopSteps(rows, width) {
  const groups = [...p.groupBy(rows, row => row.contacts).values()], widths = p.widths(width, 250, groups.length);
  const most = Math.max(...rows.map(row => row.zero_steps));
  return [p.grid(groups.map((group, i) => loopStepsPlot(group, {width: widths[i], most})))];
}

function pivotingPlot(generator, rows, whats, {width, values, most}) {
  const title = row => `${generator}, ${p.contactsOf(row.contacts)}, ${row.what}: ${p.told(row)}`;
  const series = (what, i) => p.shares(
      rows.filter(row => row.what === what),
      {at: 'contacts', series: i, shift: p.aside(i, whats.length, 6), title});
  return p.small(
      generator,
      p.drawn(
          {
            ...p.histogram,
            width,
            x: {type: 'point', domain: values, label: 'number of contacts', padding: 0.6},
            y: {domain: [0, most], label: 'share of runs, %'},
            marks: [
              p.lines('y', 40), p.yAxis({tickSpacing: 40, tickFormat: p.share}), p.xAxis(),
              ...whats.flatMap(series)
            ]
          },
          `${generator}: ` +
              rows.map(row => `${p.contactsOf(row.contacts)}, ${row.what}: ${p.share(row.share)}`).join('; ')));
}

function drawPivoting(rows, width, {policy}) {
  const mine = rows.filter(row => row.policy === policy), whats = p.unique(mine.map(row => row.what));
  const groups = [...p.groupBy(mine, row => row.generator)], options = {
    values: p.ascending(p.unique(mine.map(row => row.contacts))),
    most: Math.max(...mine.map(row => row.high))
  };
  return p.withLegend(width, whats.map((what, i) => [what, `c${i + 1}`]), across => {
    const widths = p.widths(across, 250, groups.length);
    return p.grid(groups.map(
        ([generator, group], i) => pivotingPlot(generator, group, whats, {...options, width: widths[i]})));
  });
}

const within = [['median', 'half of the runs'], ['of_99_percent', '99 of 100 runs'], ['most', 'all runs']];
const shared = [['zero', 'a step of length zero', 'zero_steps'], ['give_up', 'a variable given up', 'give_ups']];

// Steps, on a logarithmic scale: as many as half of the runs, 99 of 100, and all take at most.
function withinPlot(rows, values, width) {
  const domain = [0.9, 1.2 * Math.max(...rows.map(row => row.most))];
  const told = ([key, name]) => row =>
      `${p.contactsOf(row.contacts)}, ${name}: at most ${p.count(row[key])} steps; ${p.count(row.runs)} runs`;
  return p.small(
      'Steps of a run, at most',
      p.drawn(
          {
            ...p.histogram,
            width,
            height: 250,
            x: {type: 'point', domain: values, label: 'number of contacts', padding: 0.6},
            y: {type: 'log', domain, label: 'steps', clamp: true},
            marks: [
              p.logLines(domain), p.logAxis(domain, p.shortNumber), p.xAxis(),
              ...within.map((each, i) => dot(rows, {
                              x: 'contacts',
                              y: row => Math.max(0.9, row[each[0]]),
                              r: 4,
                              symbol: p.symbols[i],
                              fill: p.colours[i],
                              title: told(each)
                            }))
            ]
          },
          `Steps of a run: ${rows.map(row => within.map(each => told(each)(row)).join('; ')).join('; ')}`));
}

function sharedPlot(rows, values, width) {
  const lines = shared.map(
      ([key, what, count]) => rows.map(row => ({
                                         contacts: row.contacts,
                                         what,
                                         share: row[`${key}_share`],
                                         low: row[`${key}_low`],
                                         high: row[`${key}_high`],
                                         count: row[count],
                                         of: row.runs
                                       })));
  const title = row => `${p.contactsOf(row.contacts)}, ${row.what}: ${p.told(row)}`;
  return p.small(
      'Runs with',
      p.drawn(
          {
            ...p.histogram,
            width,
            height: 250,
            x: {type: 'point', domain: values, label: 'number of contacts', padding: 0.6},
            y: {domain: [0, 1.05 * Math.max(...lines.flat().map(row => row.high))], label: 'share of runs, %'},
            marks: [
              p.lines('y', 34), p.yAxis({tickSpacing: 34, tickFormat: p.share}), p.xAxis(),
              ...lines.flatMap(
                  (group, i) =>
                      p.shares(group, {at: 'contacts', series: i + within.length, shift: p.aside(i, 2, 7), title}))
            ]
          },
          `Shares of runs: ${lines.flat().map(title).join('; ')}`));
}

function drawCost(rows, width, {policy}) {
  const mine = rows.filter(row => row.policy === policy), values = p.ascending(p.unique(mine.map(row => row.contacts)));
  const key = [...within, ...shared].map(([, name], i) => [name, `c${i + 1}`]);
  return p.withLegend(width, key, across => {
    const widths = p.widths(across, 220, 2);
    return p.grid([withinPlot(mine, values, widths[0]), sharedPlot(mine, values, widths[1])]);
  });
}

// ---- Methods ----

function drawDriving(rows, width) {
  const whats = p.unique(rows.map(row => row.what));
  const title = row => `${p.contactsOf(row.contacts)}, with ${row.what}: ${p.told(row)}`;
  const drawn = across =>
      p.shareLines(rows, `Share of the paths of complete driving: ${rows.map(title).join('; ')}`, {
        width: across,
        at: row => p.contactsOf(row.contacts),
        series: row => row.what,
        each: 'contacts',
        of: 'share of the paths, %',
        left: 84,
        height: 34,
        title
      });
  return p.withLegend(width, whats.map((what, i) => [`with ${what}`, `c${i + 1}`]), drawn);
}

function drawMethods(rows, width) {
  const title = row => `${p.contactsOf(row.contacts)}: ${p.told(row)}`;
  const groups = [...p.groupBy(rows, row => `${row.method}: ${row.asked_about}`)],
        widths = p.widths(width, 330, groups.length);
  const plots = groups.map(
      ([name, group], i) => p.small(
          name,
          p.shareLines(
              group, `${name}, share solved: ${group.map(title).join('; ')}`,
              {
                width: widths[i],
                at: row => p.contactsOf(row.contacts),
                each: 'contacts',
                of: 'share of those asked, %',
                left: 84,
                title
              })));
  return [p.grid(plots)];
}

function rungsPlot(family, rows, {width, domain, most}) {
  const title = row =>
      `${row.method} ${row.arithmetic}: ${p.rate(row.microseconds)} microseconds, ${p.count(row.solved)} ` +
      `solved, ${p.count(row.wrong)} wrong, ${p.count(row.undecided)} undecided of ${p.count(row.asked)}`;
  const mark = {
    x: row => Math.max(row.microseconds, 1e-3),
    y: 'lost',
    r: 4,
    stroke: 'var(--bar)',
    strokeWidth: 1.5,
    fill: row => ['filtered', 'exact'].includes(row.arithmetic) ? 'var(--bar)' : 'var(--card)',
    title
  };
  return p.small(
      family,
      p.drawn(
          {
            ...p.histogram,
            width,
            height: 234,
            x: {type: 'log', domain, label: 'microseconds a problem'},
            y: {domain: [0, most], label: 'wrong or undecided, %'},
            marks: [
              p.lines('y', 45), p.yAxis({tickSpacing: 45, tickFormat: p.share}),
              p.xAxis({ticks: p.logTicks(domain), tickFormat: p.shortNumber}), dot(rows, mark)
            ]
          },
          `Time and lost answers on ${family}: ${rows.map(title).join('; ')}`));
}

function drawRungs(rows, width) {
  const times = rows.map(row => Math.max(row.microseconds, 1e-3));
  const groups = [...p.groupBy(rows, row => row.family)], widths = p.widths(width, 330, groups.length);
  const options = {
    domain: [Math.min(...times) / 1.3, Math.max(...times) * 1.3],
    most: Math.max(0.01, ...rows.map(row => row.lost))
  };
  return [p.grid(groups.map(([family, group], i) => rungsPlot(family, group, {...options, width: widths[i]})))];
}

// ---- Records ----

// Ticks of an axis over so many decades that a label at each would not fit.
function thousandfold([low, high]) {
  const ticks = [];
  for (let e = 3 * Math.ceil(Math.log10(low) / 3); 10 ** e <= high; e += 3) ticks.push(10 ** e);
  return ticks;
}
const tickName = x => x < 0.01 ? x.toExponential(0) : p.rate(x);

// A line for each record of an objective, from the best of random problems to it.
function frontierPlot(objective, rows, width) {
  const name = row => row.frontier.replace(`${objective}-`, '').replaceAll('-', ' ');
  const found = row =>
      row.random === null ? 'random problems reached nothing' : `best of random problems ${p.rate(row.random)}`;
  const title = row => `${row.what}: ${p.rate(row.record)}; ${found(row)} of ${p.count(row.evaluations)}`;
  const both = rows.filter(row => row.random !== null);
  const values = [...rows.map(row => row.record), ...both.map(row => row.random)];
  const scale = Math.min(...values) > 0 ? 'log' : 'linear';
  const place = {y: name, r: 4, stroke: 'var(--bar)', strokeWidth: 1.5, title};
  const span = [Math.min(...values), Math.max(...values)];
  const domain = scale === 'log' ? [span[0] / 1.3, span[1] * 1.3] : [0, span[1] * 1.05];
  return p.small(
      objective,
      p.drawn(
          {
            width,
            height: rows.length * 26 + 60,
            marginLeft: Math.min(150, width * 0.42),
            marginTop: 20,
            marginBottom: 36,
            marginRight: 26,
            x: {
              type: scale,
              domain,
              label: `${objective.replaceAll('-', ' ')}, worse the ${rows[0].worse}`
            },
            y: {type: 'band', domain: rows.map(name), label: 'record'},
            marks: [
              p.lines('x', 60), p.xAxis({
                ...span[1] > 1e4 * span[0] ? {ticks: thousandfold(domain)} : {tickSpacing: 60},
                tickFormat: tickName
              }),
              p.yAxis(), ruleY(both, {y: name, x1: 'random', x2: 'record', stroke: 'var(--bar)'}),
              dot(both, {...place, r: 6, x: 'random', fill: 'var(--card)'}),
              dot(rows, {...place, x: 'record', fill: 'var(--bar)'})
            ]
          },
          `Records of ${objective}: ${rows.map(title).join('; ')}`));
}

function drawFrontiers(rows, width) {
  const groups = [...p.groupBy(rows, row => row.objective)], widths = p.widths(width, 330, groups.length);
  return [p.grid(groups.map(([objective, group], i) => frontierPlot(objective, group, widths[i])))];
}

export const figures = {
  'often': {choices: byPolicy, draw: drawOften},
  'cost': {choices: byPolicy, draw: drawCost},
  'rates.contacts': rates('contacts'),
  'rates.friction': rates('friction'),
  'rates.rank': rates('rank'),
  'doubles': {choices: byPolicy, draw: drawDoubles},
  'trust': {draw: drawTrust},
  'steps': {choices: byPolicy, draw: drawSteps},
  'loop-steps': {draw: drawLoopSteps},
  'pivoting': {choices: byPolicy, draw: drawPivoting},
  'driving': {draw: drawDriving},
  'methods': {draw: drawMethods},
  'frontiers': {draw: drawFrontiers},
  'rungs': {draw: drawRungs},
};
