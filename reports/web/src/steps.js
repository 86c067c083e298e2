// SPDX-License-Identifier: Apache-2.0
// What happens in a step of a run, in words: those of `stiction replay --step`, which names the paper's
// sections.
import * as does from '../../../solver/complete/cells.json';  // what contacts of a cell do, by its letter
import {element} from './dom.js';
import {number} from './numbers.js';

// "a_N1" with its subscript, the underscore kept for who copies it; "mu" as a letter; `paper` as code.
function typeset(text) {
  return text.split(/(\b(?:[af]|d?[af])_[NF]\d+[xy]?\b|\bmu\b|`[^`]+`)/).map(part => {
    if (part === 'mu') return element('i', {}, 'μ');
    if (part.startsWith('`')) return element('code', {}, part.slice(1, -1));
    const found = part.match(/^([adf]+)_(\w+)$/);
    if (found === null) return part.replace(/(^|[\s(=,])-(?=\d|$)/g, '$1−');
    return element(
        'span', {class: 'symbol'}, element('i', {}, found[1]), element('span', {class: 'away'}, '_'),
        element('sub', {}, found[2]));
  });
}

const plural = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;

const value = (name, meaning, remark, style = null) =>
    element('li', {class: style}, element('code', {}, name), ` ${meaning} `, element('em', {}, `(${remark})`));

// One switch: what the text leaves open, what it says, and its values.
function choice(partings) {
  const [{
    switch: name, question, reads, here, meaning
  }] = partings;
  const others = partings.map(
      ({there, other, outcome}) => value(there, other, `that run leaves this one here; its end: ${outcome}`));
  return element(
      'div', {},
      element(
          'p', {}, element('strong', {}, name), `: ${question}. `,
          element('span', {class: 'soft'}, `The paper: ${reads}`)),
      element('ul', {}, value(here, meaning, 'here', 'here'), ...others));
}

// Where the text leaves a choice: what the policy chose, and how runs end that choose otherwise.
export function tellReadings(run, state) {
  const partings = run.partingsAt(state);
  if (partings.length === 0) return [];
  const names = [...new Set(partings.map(parting => parting.switch))];
  const choices = names.map(name => choice(partings.filter(parting => parting.switch === name)));
  const title = 'Here the text leaves a choice, and the policy decides';
  return [element('section', {class: 'readings'}, element('h4', {}, title), ...choices)];
}

function recurrence(run, state, link) {
  if (!run.isLoop) return null;
  const {from, to} = run.loop;
  const at = k => k === 0 ? 'the start' : `step ${k}`;
  if (state === from)
    return element(
        'p', {class: 'recurs'}, 'This state recurs after ', link(to, `step ${to}`),
        run.loop.exact ? ': same sets, same forces. From here on nothing new happens.' :
                         ', as far as rounded numbers tell: same sets, forces alike. That is no proof.');
  if (state !== to) return null;
  return element(
      'p', {class: 'recurs'}, 'Here the state of ', link(from, at(from)),
      ` recurs, ${plural(to - from, 'step')} later${run.loop.exact ? '' : ', but for rounding'}: `,
      'the loop closes. Forward goes round it.');
}

function sets(run, state) {
  const found = run.sets(state);
  if (found === null) return null;
  return element(
      'p', {class: 'sets'},
      ...found.map(
          ([name, members]) => element(
              'span', {class: members.length === 0 ? 'empty' : null}, element('b', {}, name),
              members.length === 0 ? ' ∅' : ` ${members.join(', ')}`)));
}

// Of complete driving: the cell of each contact along this piece. Those of one cell share a mark.
function cells(step) {
  if (step.word === undefined || step.word === '') return null;
  const contacts = new Map();
  step.word.split(' ').forEach((cell, i) => contacts.set(cell, [...contacts.get(cell) ?? [], i + 1]));
  return element(
      'p', {class: 'sets'},
      ...[...contacts].map(
          ([cell, numbers]) => element(
              'span', {class: cell === '?' ? 'empty' : null}, element('b', {}, cell.replace('-', '−')),
              ` ${cell === '?' ? 'not yet' : does[cell[0]] ?? 'cell'}: ${numbers.join(', ')}`)));
}

// Why a variable is driven; its cells stand below.
const withoutCells = why => why.replace(/, cells [^,]*(?=,|$)/, '');

const stageOf = step => step.word === undefined ? 'drive' : 'stage';

const kMostMarks = 8;  // links to steps of one kind

// "A variable is given up at step 5, 9."
function marked(run, mark, words, noun, link) {
  const states = [...run.told.keys()].map(k => k + 1).filter(state => run.mark(state) === mark);
  if (states.length === 0) return [];
  const links = states.slice(0, kMostMarks).flatMap((state, i) => [i === 0 ? ' ' : ', ', link(state, state)]);
  return [` ${words} at ${noun}`, ...links, states.length > kMostMarks ? ', and later.' : '.'];
}

// Before the first step: what is to come, and how one goes there.
function outlook(run, link) {
  if (run.last === 0) return [element('p', {class: 'outlook'}, 'No step is taken.')];
  const first = run.step(1), noun = run.replay.method === 'complete' ? 'piece' : 'step', why = run.why(1);
  const drives = first.entering === undefined ? ` in ${plural(run.group(run.last), stageOf(first))}` : '';
  const {from, to} = run.isLoop ? run.loop : {};
  return [
    why === '' ? null :
                 element(
                     'p', {class: 'why'},
                     element('b', {}, first.entering === undefined ? `First, ${stageOf(first)} 1 ` : 'First '),
                     ...typeset(withoutCells(why))),
    element(
        'p', {class: 'outlook'}, `${plural(run.last, noun)}${drives}.`,
        ...marked(run, 'given up', 'A variable is given up', noun, link),
        ...marked(run, 'fold', 'The path turns back', noun, link),
        ...marked(run, 'descent', 'A force returns to zero', noun, link),
        ...(run.isLoop && from > 0 ?
                [
                  ' The loop begins after ', link(from, `step ${from}`), ' and closes at ', link(to, `step ${to}`),
                  run.loop.exact ? '.' : ', but for rounding.'
                ] :
                [])),
  ].filter(Boolean);
}

// `link(state, text)`: a link to a state of the run. `how`: how one steps through it, before the first step.
export function tellStep(run, state, link, how) {
  const step = run.step(state);
  if (step === null) {
    const lines = run.before.trim().split('\n').filter(line => line !== '');
    return [
      ...lines.map(line => element('p', {class: 'event'}, ...typeset(line))), ...outlook(run, link),
      recurrence(run, 0, link), run.last === 0 ? null : element('p', {class: 'how'}, ...how)
    ].filter(Boolean);
  }
  const stage = stageOf(step);
  const why = run.why(state);
  return [
    why === '' ?
        null :
        element(
            'p', {class: 'why'}, element('b', {}, step.entering === undefined ? `${stage} ${step.group} ` : ''),
            ...typeset(withoutCells(why))),
    element(
        'p', {class: step.mark === '' ? 'event' : `event ${step.mark.replace(' ', '-')}`},
        element('span', {class: 's'}, element('i', {}, 's'), ' = ', number(step.step)), ' ',
        ...typeset(step.event)),
    ...(step.readings ?? [])
        .map(
            reading => element(
                'p', {class: 'reading'}, 'Reading ', element('code', {}, `${reading.switch}=${reading.here}`),
                ` (${reading.question}): ${reading.meaning}.`)),
    sets(run, state),
    cells(step),
    recurrence(run, state, link),
  ].filter(Boolean);
}
