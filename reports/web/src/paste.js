// SPDX-License-Identifier: Apache-2.0
// A problem that is pasted: what holds of it, what the algorithms do on it, and forces, in plain words. The
// address holds the problem: #problem=..., as that of the viewer does (draft.js).
import {byId, element} from './dom.js';
import {decoded, Draft, encoded, fileOf, hasMu} from './draft.js';
import {hypotheses} from './hypotheses.js';
import {Live} from './live.js';
import {isZero, number} from './numbers.js';
import {fileOfPasted, isWhole} from './pasted.js';
import {setAddress} from './player.js';

const kExamples = {
  'a loop': {A: '3 -4  2  0\n-4  7 -4  1\n2 -4  7 -6\n0  1 -6  7', b: '-1 0 0 -2', mu: '1'},
  'a block at rest': {A: '[[2. 0.]\n [0. 3.]]', b: '[-1.  1.]', mu: '0.5'},
  'a jam': {
    A: '%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 -1\n2 2 1',
    b: '-1\n0',
    mu: '1',
  },
  'in space': {
    A: '{"A": [[2, 0, 0], [0, 1, "1/2"], [0, "1/2", 1]],\n "b": [-1, 1, "-0.2"], "mu": "0.3"}',
    b: '',
    mu: ''
  },
};
// Pages of the site in which a problem of that dimension can be stepped through, and how many rows they take.
const kViewers = {
  2: ['play/cycle-every-policy-mu-1.html', 24],
  3: ['play/cycle-under-both-slips.html', 15]
};

const live = new Live(), fields = ['A', 'b', 'mu', 'dimension'];

const taken = () => Object.fromEntries(fields.map(name => [name, byId(name).value]));

function fill(values) {
  for (const name of fields) byId(name).value = values[name] ?? '';
  greyOut();
}

// What a whole problem has says so itself.
function greyOut() {
  for (const name of fields.slice(1)) byId(name).disabled = isWhole(byId('A').value);
}

// ---- In words ----------------------------------------------------------------------------------

const said = (holds, text) => element('li', {class: holds === null ? 'open' : holds ? 'is' : 'not'}, text);

// The theorem speaks of static and frictionless contacts, and bilateral ones (certify/existence.md).
function whatHolds(draft) {
  const found = hypotheses(draft.A, draft.b), slides = draft.contacts.some(({kind}) => kind === 'sliding');
  const list = [said(found.isSymmetric, found.isSymmetric ? 'A is symmetric.' : 'A is not symmetric.')];
  if (found.isSemidefinite !== null)
    list.push(said(found.isSemidefinite, `A is ${found.isSemidefinite ? '' : 'not '}positive semidefinite.`));
  if (found.isInRange !== null)
    list.push(said(found.isInRange, `b is ${found.isInRange ? '' : 'not '}in the range of A.`));
  if (slides) list.push(said(false, 'A contact slides.'));
  const exists = found.isInRange === true && !slides;
  list.push(
      exists ? said(true, 'So forces exist: a theorem says so, for every mu.') :
               said(null, 'So the theorem on existence says nothing: forces may exist, or not.'));
  return list;
}

const kEnds = {
  solved: () => 'ends, at forces that obey the law.',
  cycle: ({start, period}) =>
      `never ends: the state after ${start} drives comes back ${period} drives later, for ever.`,
  stall: () => 'never ends: within one drive a state comes back, for ever.',
  ray: () => 'takes a step without limit: along it the forces grow for ever.',
  singular: () => 'stops: it finds no direction in which to change the forces.',
  limit: () => 'did not end within what this page allows it.',
};

function whatHappens({title, end, replay}) {
  const how = kEnds[replay.outcome], loops = ['cycle', 'stall'].includes(replay.outcome);
  const words = how === undefined ? `ends so: ${end}.` : how(replay);
  const more = /; over doubles alone|after rounding/.test(end) ?
      ' Over rounded numbers: stiction replay says what is proved.' :
      '';
  const holds = replay.outcome === 'solved' ? true : loops || replay.outcome === 'ray' ? false : null;
  return said(holds, `${title.split(',')[0]} ${words}${more}`);
}

// What a contact does, by its rows of f and a.
function does(kind, f, a) {
  if (kind === 'bilateral') return 'holds';
  if (isZero(f[0])) return isZero(a[0]) ? 'touches, without a force' : 'parts';
  if (kind === 'frictionless') return 'pushes';
  return a.slice(1).every(isZero) ? 'sticks' : 'slips';
}

function table(draft, {f, a}) {
  const head = names => element('tr', {}, ...names.map(name => element('th', {scope: 'col'}, name)));
  const cell = values => element('td', {}, ...values.flatMap((x, i) => [i === 0 ? null : ', ', number(x)]));
  const row = ({kind}, i) => {
    const first = draft.firstRow(i), rows = [first, first + draft.rowsOf(kind)];
    const [force, acceleration] = [f.slice(...rows), a.slice(...rows)];
    return element(
        'tr', {}, element('th', {scope: 'row'}, String(i + 1)),
        element('td', {}, does(kind, force, acceleration)), cell(force.slice(0, 1)),
        hasMu(kind) ? cell(force.slice(1)) : element('td', {}, '-'), cell(acceleration));
  };
  return element(
      'div', {class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Forces'},
      element(
          'table', {},
          element('thead', {}, head(['contact', 'it', 'normal force', 'friction', 'acceleration'])),
          element('tbody', {}, ...draft.contacts.map(row))));
}

function solution(draft, runs) {
  const solved = runs.findLast(({replay}) => replay.outcome === 'solved');
  if (solved === undefined)
    return [element(
        'p', {}, 'No forces were found. That is no proof that there are none: ',
        element('code', {}, 'stiction certify'), ' decides it for small problems.')];
  const note = solved.replay.arithmetic === 'exact' ? 'Exact' : 'Rounded';
  const sides = draft.dimension === 3 && solved.replay.method === 'complete' ?
      ', with a polygon in place of the friction cone' :
      '';
  return [
    element('p', {class: 'note'}, `${note}, by ${solved.title.toLowerCase()}${sides}. There may be others.`),
    table(draft, solved.replay)
  ];
}

function links(draft) {
  const letters = encoded(draft.problem(), 'paper'), [page, most] = kViewers[draft.dimension];
  if (letters === '') return element('p', {class: 'note'}, 'It is too long for an address.');
  setAddress(`#problem=${letters}`);
  const here = element('a', {href: `#problem=${letters}`}, 'A link that contains this problem');
  const steps = draft.b.length > most ?
      null :
      element('a', {href: `${page}#step-0;problem=${letters}`}, 'Step through both runs');
  return element('p', {class: 'calls'}, here, ' ', steps);
}

// `data`: of a page, with the runs.
function show(data) {
  const draft = new Draft(data.problem, 'paper');
  byId('answer').replaceChildren(element(
      'div', {}, element('h2', {}, 'What holds'), element('ul', {}, ...whatHolds(draft)),
      element('h2', {}, 'What happens'), element('ul', {}, ...data.runs.map(run => whatHappens(run))),
      element('h2', {}, 'The solution'), ...solution(draft, data.runs), links(draft)));
}

// ---- What is done ------------------------------------------------------------------------------

function isBusy(on) {
  byId('run').disabled = on;
  byId('stop').hidden = !on;
  byId('told').textContent = on ? 'Running.' : '';
}

async function run() {
  let problem = '';
  try {
    problem = fileOfPasted(taken());
  } catch (error) {
    byId('answer').replaceChildren();  // which was another problem's
    byId('told').textContent = error.message;
    return;
  }
  isBusy(true);
  const answer = await live.ask({ask: 'run', problem, method: 'baraff', policy: 'paper'});
  isBusy(false);
  if (answer.error === undefined) {
    show(answer.data);
  } else {
    byId('answer').replaceChildren();
    byId('told').textContent = answer.error;
  }
}

function followAddress() {
  const found = decoded(location.hash.match(/^#problem=([\w-]+)$/)?.[1] ?? '');
  if (found === null) return false;
  fill({A: fileOf('pasted', found.problem)});
  run();
  return true;
}

byId('form').addEventListener('submit', event => {
  event.preventDefault();
  run();
});
byId('stop').addEventListener('click', () => live.end('stopped'));
byId('A').addEventListener('input', greyOut);
addEventListener('hashchange', followAddress);
for (const [name, values] of Object.entries(kExamples)) {
  byId('examples')
      .append(element(
          'button', {
            type: 'button',
            click: () => {
              fill(values);
              run();
            }
          },
          name));
}
if (!followAddress()) fill(kExamples['a loop']);
