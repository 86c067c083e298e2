// SPDX-License-Identifier: Apache-2.0
// What a problem is called: by what it is, and by what happens to it; and where it is played.
import {encoded} from './draft.js';

const numerals = ['No', 'One', 'Two', 'Three', 'Four', 'Five', 'Six', 'Seven', 'Eight', 'Nine', 'Ten'];

// "single digits", "fractions of up to 3 digits"; of exact numbers, as text.
function sizeOf(texts) {
  const parts = texts.flatMap(text => text.replace('-', '').split('/'));
  const digits = Math.max(1, ...parts.map(part => part.length)), whole = texts.every(text => !text.includes('/'));
  if (digits === 1) return whole ? 'single digits' : 'fractions of single digits';
  return `${whole ? 'integers' : 'fractions'} of up to ${digits} digits`;
}

// "Two contacts, single digits, under every policy". `numbers`: as text, null where they are too long to be told;
// `looping` of `policies` loop.
export function nameOf({contacts, dimension, numbers, outcome, policy, looping, policies}) {
  const parts = [
    `${numerals[contacts] ?? contacts} contact${contacts === 1 ? '' : 's'}${dimension === 3 ? ' in space' : ''}`,
    numbers === null ? 'long numbers' : sizeOf(numbers)
  ];
  if (!['cycle', 'stall', 'safe-cycle'].includes(outcome)) return `${parts.join(', ')}: ${outcome.replaceAll('-', ' ')}`;
  if (looping > 0 && looping === policies) return [...parts, 'under every policy'].join(', ');
  if (looping > 0) return [...parts, `under ${looping.toLocaleString('en')} of ${policies.toLocaleString('en')} policies`].join(', ');
  return [...parts, policy === 'paper' ? 'as published' : `under ${policy}`].join(', ');
}

const numbersOf = ({A, b, contacts}) => [
  ...(Array.isArray(A) ? A.flat() : A.entries.map(entry => entry[2])), ...b,
  ...contacts.map(contact => contact.mu).filter(mu => mu !== undefined)
];

// Of the data of a viewer.
export function nameOfRun({problem, runs: [{replay}], every_policy: every, looping, policies}) {
  const grid = every ? {looping: 1, policies: 1} : {looping, policies};
  return nameOf({
    contacts: problem.contacts.length,
    dimension: problem.dimension,
    numbers: numbersOf(problem),
    outcome: replay.outcome,
    policy: replay.policy ?? 'paper',
    ...grid
  });
}

// Of a finding of a report.
export const nameOfFinding = ({numbers, smallest, kind, policy, looping, policies}) => nameOf({
  contacts: smallest,
  dimension: numbers?.dimension ?? 2,
  numbers: numbers && numbersOf(numbers),
  outcome: kind,
  policy,
  looping,
  policies
});

// Where the player of a report runs a finding; null for what no address holds, and what is of another dimension than
// the player's, which is 0 where there is none.
export function addressOf({numbers, policy, signature}, plays) {
  if (!numbers || numbers.dimension !== plays) return null;
  const {dimension, contacts, A, b} = numbers;
  const letters = encoded({name: signature, dimension, contacts, A, b}, policy);
  return letters === '' ? null : `replay.html#step-0;problem=${letters}`;
}

// "loops: drives 3 to 7 recur"; null for what is no loop.
export function loopOf(outcome, start, period) {
  const unit = outcome === 'cycle' || outcome === 'safe-cycle' ? 'drive' : outcome === 'stall' ? 'step' : null;
  if (unit === null || !period) return null;
  return period === 1 ? `loops: ${unit} ${start + 1} recurs` : `loops: ${unit}s ${start + 1} to ${start + period} recur`;
}
