// SPDX-License-Identifier: Apache-2.0
// A run as states 0 (before the first step) to `last` (after the last one), and past that: a loop goes on for
// ever.
import {isZero} from './numbers.js';

export class Run {
  constructor(json) {
    Object.assign(this, json);  // title, before, end, told, partings, replay, loop
    this.pivots = json.replay.pivots;
    this.last = this.pivots.length;
  }

  get isLoop() {
    return this.loop !== null && this.loop.to > this.loop.from;
  }

  // The state that stands at a moment, which of a loop may lie beyond the last state.
  stateAt(moment) {
    if (moment <= this.last) return Math.max(0, moment);
    if (!this.isLoop) return this.last;
    const period = this.loop.to - this.loop.from;
    return this.loop.from + 1 + (moment - this.loop.from - 1) % period;
  }
  // How often the loop was gone round before a moment.
  roundAt(moment) {
    if (!this.isLoop || moment <= this.loop.to) return 0;
    return Math.floor((moment - this.loop.from - 1) / (this.loop.to - this.loop.from));
  }

  f(state) {
    return state === 0 ? this.replay.initial.f : this.pivots[state - 1].f;
  }
  a(state) {
    return state === 0 ? this.replay.initial.a : this.pivots[state - 1].a;
  }
  step(state) {
    return state === 0 ? null : {...this.pivots[state - 1], ...this.told[state - 1]};
  }
  isZeroStep(state) {
    return state > 0 && isZero(this.pivots[state - 1].step);
  }
  mark(state) {
    return state === 0 ? '' : this.told[state - 1].mark;
  }
  group(state) {
    return state === 0 ? 0 : this.told[state - 1].group;
  }
  // Why the variable of a step's drive is driven: said at the first step of the drive.
  why(state) {
    for (let k = state; k > 0 && this.group(k) === this.group(state); --k) {
      if (this.told[k - 1].why !== '') return this.told[k - 1].why;
    }
    return '';
  }
  // Sets after a state, as [name, members]; null where the method has none, and before the first step.
  sets(state) {
    return state === 0 ? null : this.told[state - 1].sets ?? null;
  }
  setOf(variable, state) {
    const found = (this.sets(state) ??
                   []).find(([, members]) => members.some(member => member.split(' ')[0] === variable));
    return found === undefined ? '' : found[0];
  }
  partingsAt(state) {
    return this.partings.filter(parting => parting.step + 1 === state);
  }
}

const equal = (f, g) => JSON.stringify(f) === JSON.stringify(g);

// Where the first run gives up what the second one turns back at: the same forces, exactly. Null if nowhere.
export function whereTheyPart(first, second) {
  for (let k = 1; k <= first.last; ++k) {
    if (first.mark(k) !== 'given up') continue;
    for (let i = 1; i <= second.last; ++i) {
      if (second.mark(i) === 'fold' && equal(first.f(k), second.f(i))) return {first: k, second: i};
    }
  }
  return null;
}
