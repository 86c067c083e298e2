// SPDX-License-Identifier: Apache-2.0
// A loop that plays inside a report: its numbers, cones, steps and words. The player has a page of its own
// (viewer.js), where it stands beside complete driving and can be edited.
import {Cones} from './cones.js';
import {element} from './dom.js';
import {loopOf} from './names.js';
import {button, icons, showPlaying} from './player.js';
import {Run} from './run.js';
import {tellStep} from './steps.js';
import {Timeline} from './timeline.js';
import {equation, foldedIfLarge} from './values.js';

const kTick = 1100;  // ms of a step that is played

export function showPlay(data, node) {
  const run = new Run(data.runs[0]), cones = new Cones(data, [run]);
  const algebra = element('div', {class: 'algebra scroll', tabindex: '0', role: 'group', 'aria-label': 'A f + b = a'});
  const heading = element('h4'), story = element('div', {class: 'story'});
  let moment = 0, timer = null;

  const clamp = to => Math.max(0, run.isLoop ? to : Math.min(to, run.last));
  const go = to => {
    moment = clamp(to);
    const state = run.stateAt(moment), round = run.roundAt(moment);
    algebra.replaceChildren(...equation(data, run, state));
    cones.show([state]);
    timeline.show(state);
    heading.textContent = (state === 0 ? 'Before the first step' : `Step ${state} of ${run.last}`) +
        (round > 0 ? `, round ${round + 1} of the loop` : '');
    story.replaceChildren(...tellStep(run, state, link, []));
    controls.back.disabled = moment === 0;
    controls.next.disabled = !run.isLoop && moment >= run.last;
  };
  const play = on => {
    if (timer !== null) clearInterval(timer);
    timer = on ? setInterval(() => moment >= run.last && !run.isLoop ? play(false) : go(moment + 1), kTick) : null;
    showPlaying(controls.play, on);
  };
  const stop = to => {
    play(false);
    go(to);
  };
  const link = (state, text) => element('button', {type: 'button', class: 'to', click: () => stop(state)}, text);
  const timeline = new Timeline(run, stop);
  const controls = {
    back: button(icons.back, 'Back', () => stop(moment - 1)),
    play: button(icons.play, 'Play', () => play(timer === null)),
    next: button(icons.next, 'Forward', () => stop(moment + 1)),
  };
  node.addEventListener('keydown', event => {
    const to = {ArrowRight: moment + 1, ArrowLeft: moment - 1}[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    stop(to);
    event.preventDefault();
  });
  const {outcome, start, period} = run.replay;
  node.replaceChildren(
      element('p', {class: 'verdict'}, loopOf(outcome, start, period) ?? run.end),
      element(
          'div', {class: 'player'}, ...Object.values(controls), timeline.node,
          element('a', {href: 'replay.html'}, 'Beside complete driving, to edit')),
      element('div', {class: 'two'}, element('div', {}, foldedIfLarge(data, algebra), heading, story), cones.node));
  go(run.isLoop ? run.loop.to : 0);
}
