// SPDX-License-Identifier: Apache-2.0
// Numbers of a state: A f + b = a, and a table with a bar for each force and acceleration.
import {element} from './dom.js';
import {isZero, number, toDouble} from './numbers.js';

const variableOf = row => row.replace(/[xy]$/, '');  // in space F1x and F1y are two rows of F1

// ---- A f + b = a -----------------------------------------------------------------------------

function matrix(rows, shade = () => false, style = '') {
  return element(
      'table', {class: `matrix ${style}`, role: 'presentation'},
      element(
          'tbody', {},
          ...rows.map(
              (row, i) => element(
                  'tr', {},
                  ...row.map((x, j) => element('td', {class: shade(i, j) ? 'shade' : null}, number(x)))))));
}

const column = numbers => numbers.map(x => [x]);

export function equation(data, run, state) {
  const kept = data.rows.map(row => ['C', 'CF'].includes(run.setOf(variableOf(row), state)));
  const names = element(
      'table', {class: 'matrix names', role: 'presentation'},
      element('tbody', {}, ...data.rows.map(row => element('tr', {}, element('th', {scope: 'row'}, row)))));
  const sign = text => element('span', {class: 'sign'}, text);
  const mu = data.problem.contacts.filter(contact => contact.mu !== undefined).map(contact => contact.mu);
  const part = (label, table, style = 'part') =>
      element('div', {class: style}, element('span', {class: 'name'}, label), table);
  return [
    part('', names),
    part('A', matrix(data.problem.A, (i, j) => kept[i] && kept[j])),
    part('f', matrix(column(run.f(state)), () => false, 'force')),
    sign('+'),
    part('b', matrix(column(data.problem.b))),
    sign('='),
    part('a', matrix(column(run.a(state)), () => false, 'acceleration')),
    mu.length === 0 ? null : part('μ', matrix(column(mu)), 'part mu'),
  ].filter(Boolean);
}

const kMostRows = 8;  // of A, that stand open

// What shows A, behind a fold where it is large.
export const foldedIfLarge = (data, node) => data.rows.length <= kMostRows ?
    node :
    element('details', {class: 'folded'}, element('summary', {}, `A f + b = a, ${data.rows.length} rows`), node);

// ---- The table -------------------------------------------------------------------------------

function bar(x, largest, style) {
  const share = largest === 0 ? 0 : 50 * Math.min(1, Math.abs(toDouble(x)) / largest);
  const fill = element('span', {class: toDouble(x) < 0 ? 'below' : 'above'});
  fill.style.width = `${share}%`;
  return element('span', {class: `bar ${style}`, 'aria-hidden': 'true'}, fill);
}

export function largestOf(run, numbersOf) {
  let largest = 0;
  for (let state = 0; state <= run.last; ++state) {
    for (const x of numbersOf(state)) largest = Math.max(largest, Math.abs(toDouble(x)));
  }
  return largest;
}

export class Values {
  constructor(data, run) {
    Object.assign(this, {data, run});
    this.largestForce = largestOf(run, state => run.f(state));
    this.largestAcceleration = largestOf(run, state => run.a(state));
    this.hasSets = run.last > 0 && run.sets(1) !== null;
    this.hasDirections = run.last > 0 && run.pivots[0].df !== undefined;
    this.body = element('tbody');
    const head =
        ['', ...(this.hasSets ? ['set'] : []), 'f', '', 'a', '', ...(this.hasDirections ? ['Δf', 'Δa'] : [])];
    this.node = element(
        'div', {class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Forces and accelerations'},
        element(
            'table', {class: 'values'},
            element('caption', {}, 'Forces, accelerations and directions of each variable after this step'),
            element(
                'thead', {},
                element(
                    'tr', {},
                    ...head.map(text => text === '' ? element('td') : element('th', {scope: 'col'}, text)))),
            this.body));
  }

  show(state) {
    this.body.replaceChildren(...this.data.rows.map((row, i) => this.line(row, i, state)));
  }

  line(row, i, state) {
    const step = this.run.step(state), f = this.run.f(state)[i], a = this.run.a(state)[i];
    const direction = (name, sign) =>
        element('td', {class: `direction ${sign}`}, step === null ? '' : number(step[name][i]));
    const moved = step !== null && step.moved === variableOf(row);
    return element(
        'tr', {class: moved ? 'moved' : null}, element('th', {scope: 'row'}, row),
        this.hasSets ? element('td', {class: 'set'}, this.run.setOf(variableOf(row), state) || '–') : null,
        element('td', {class: isZero(f) ? 'n nothing force' : 'n force'}, number(f)),
        element('td', {}, bar(f, this.largestForce, 'force')),
        element('td', {class: isZero(a) ? 'n nothing acceleration' : 'n acceleration'}, number(a)),
        element('td', {}, bar(a, this.largestAcceleration, 'acceleration')),
        this.hasDirections ? direction('df', 'df') : null, this.hasDirections ? direction('da', 'da') : null);
  }
}
