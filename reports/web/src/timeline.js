// SPDX-License-Identifier: Apache-2.0
// The steps of a run as buttons, drive by drive, which wrap where the page is narrow.
import {element} from './dom.js';

const kShown = 200;  // steps on each side of the present one, of a run that is longer

function labelOf(run, state) {
  if (state === 0) return 'before the first step';
  const words = [`step ${state}`, run.told[state - 1].label];
  if (run.isZeroStep(state)) words.push('length zero');
  if (run.mark(state) !== '') words.push(run.mark(state));
  if (run.isLoop && state === run.loop.from) words.push('the state that recurs');
  if (run.isLoop && state === run.loop.to) words.push(`the state of step ${run.loop.from} again`);
  return words.join(', ');
}

function styleOf(run, state) {
  const styles = ['state'];
  if (run.isZeroStep(state)) styles.push('zero');
  if (run.mark(state) === 'given up') styles.push('given-up');
  if (run.mark(state) === 'fold' || run.mark(state) === 'descent') styles.push('turn');
  if (run.isLoop && (state === run.loop.from || state === run.loop.to))
    styles.push('recurs');
  else if (run.isLoop && state > run.loop.from)
    styles.push('period');
  return styles.join(' ');
}

export class Timeline {
  constructor(run, choose) {
    this.run = run;
    this.choose = choose;
    this.node = element('ol', {class: 'timeline', 'aria-label': 'Steps, by drive'});
    this.buttons = new Map();
  }

  show(state) {
    if (!this.buttons.has(state) || this.isAtEdge(state)) this.draw(state);
    for (const [k, button] of this.buttons) {
      button.classList.toggle('past', k < state);
      if (k === state)
        button.setAttribute('aria-current', 'step');
      else
        button.removeAttribute('aria-current');
    }
  }

  isAtEdge(state) {
    const next = state + 1, before = state - 1;
    return (next <= this.run.last && !this.buttons.has(next)) || (before >= 0 && !this.buttons.has(before));
  }

  draw(around) {
    this.buttons.clear();
    const groups = [];
    const from = Math.max(0, around - kShown), to = Math.min(this.run.last, around + kShown);
    for (let state = from; state <= to; ++state) {
      const group = this.run.group(state);
      if (groups.length === 0 || groups[groups.length - 1].group !== group)
        groups.push({group, label: state === 0 ? 'start' : this.run.told[state - 1].label, buttons: []});
      groups[groups.length - 1].buttons.push(this.button(state));
    }
    this.node.replaceChildren(...groups.map(
        ({label, buttons}) => element(
            'li', {}, element('span', {class: 'group', 'aria-hidden': 'true'}, label),
            element('span', {}, ...buttons))));
  }

  button(state) {
    const label = labelOf(this.run, state);
    const button = element('button', {
      type: 'button',
      class: styleOf(this.run, state),
      'aria-label': label,
      title: label,
      tabindex: '-1',
      click: () => this.choose(state)
    });
    this.buttons.set(state, button);
    return button;
  }
}
