// SPDX-License-Identifier: Apache-2.0
// The replay viewer. The address says what is shown: #step-5, and #step-5,3 where the second run was moved by
// itself; #step-5;problem=... of a problem that was edited (draft.js).
import {Cones} from './cones.js';
import {byId, element} from './dom.js';
import {decoded, Draft, encoded} from './draft.js';
import {Editor} from './editor.js';
import {Picture} from './picture.js';
import {loopOf, nameOfRun} from './names.js';
import {button, copyLink, icons, setAddress, showAllDigits, showPlaying, watchKeys} from './player.js';
import {Run, whereTheyPart} from './run.js';
import {tellReadings, tellStep} from './steps.js';
import {Timeline} from './timeline.js';
import {equation, foldedIfLarge, Values} from './values.js';

const kTick = 1100;  // ms of a step that is played
const kSwipe = 45;   // pixels
const kNarrow = 4;   // rows of A that leave room for a picture beside it

const original = JSON.parse(byId('data').textContent);
let data = null, runs = [], parting = null, cones = null, picture = null, panels = [];
let cameAs = '';  // the name of a problem that came with the address
const shown = {
  moment: 0,
  second: null,
  timer: null,
  problem: '',  // letters of an address, of one that was edited
};

// ---- Where the runs are ----------------------------------------------------------------------

// The second run keeps step with the first; where the first gives up, it is at the fold.
function secondFor(moment) {
  const last = runs[1].last;
  if (parting === null) return Math.min(moment, last);
  if (moment < parting.first) return Math.min(moment, parting.second);
  return Math.min(parting.second + moment - parting.first, last);
}

function states() {
  const first = runs[0].stateAt(shown.moment);
  return runs.length === 1 ? [first] : [first, shown.second ?? secondFor(shown.moment)];
}

const tail = () => shown.problem === '' ? '' : `;problem=${shown.problem}`;
const address = () => `#step-${shown.moment}${shown.second === null ? '' : `,${shown.second}`}${tail()}`;

const kAddress = /^#step-(\d{1,9})(?:,(\d{1,9}))?(?:;problem=([\w-]+))?$/;

// Runs the problem of the address first, where it has another.
async function followAddress() {
  const hash = location.hash, letters = hash.match(kAddress)?.[3] ?? '';
  if (letters !== shown.problem) {
    const found = letters === '' ? null : decoded(letters);
    if (found !== null && editor.isPossible && found.problem.dimension === original.problem.dimension) {
      editor.details.open = true;
      editor.take(new Draft(found.problem, found.policy));
      cameAs = found.name;
      if (!await editor.run()) return;
    } else if (shown.problem !== '') {
      showOriginal();
    }
  }
  readAddress(hash);
  go(shown.moment, shown.second);
}

function readAddress(hash) {
  const found = hash.match(kAddress);
  shown.moment = found === null ? 0 : clamp(Number(found[1]));
  shown.second = found === null || found[2] === undefined || runs.length === 1 ?
      null :
      Math.min(Number(found[2]), runs[1].last);
}

// A loop has no end.
const clamp = moment => Math.max(0, runs[0].isLoop ? moment : Math.min(moment, runs[0].last));

function go(moment, second = null) {
  shown.moment = clamp(moment);
  shown.second = second;
  draw();
  setAddress(address());
}

// ---- The player ------------------------------------------------------------------------------

const isPlaying = () => shown.timer !== null;

function play(on) {
  if (isPlaying()) clearInterval(shown.timer);
  shown.timer = on ? setInterval(() => {
    if (!runs[0].isLoop && shown.moment >= runs[0].last)
      play(false);
    else
      go(shown.moment + 1);
  }, kTick) : null;
  showPlaying(controls.play, on);
}

const stop = handler => () => {
  play(false);
  handler();
};
const controls = {
  first: button(icons.first, 'First', stop(() => go(0)), 'First (Home)'),
  back: button(icons.back, 'Back', stop(() => go(shown.moment - 1)), 'Back (←)'),
  play: button(icons.play, 'Play', () => play(!isPlaying()), 'Play (Space)'),
  next: button(icons.next, 'Forward', stop(() => go(shown.moment + 1)), 'Forward (→)'),
  last: button(icons.last, 'Last', stop(() => go(runs[0].last)), 'Last (End)'),
  slider: element('input', {
    type: 'range',
    min: 0,
    step: 1,
    'aria-label': 'Step',
    input: stop(() => go(Number(controls.slider.value)))
  }),
  place: element('span', {class: 'place'}),
  link: copyLink('step'),
};

const keys = {
  ' ': () => play(!isPlaying()),
  ArrowRight: stop(() => go(shown.moment + 1)),
  ArrowLeft: stop(() => go(shown.moment - 1)),
  Home: stop(() => go(0)),
  End: stop(() => go(runs[0].last)),
  e: stop(showAllDigits),
  c: stop(() => controls.link.click()),
};

// A finger that is drawn sideways over what does not itself scroll sideways.
function watchSwipes(node) {
  let start = null;
  node.addEventListener('touchstart', event => {
    const scrolls = [...node.querySelectorAll('.scroll')].some(
        part => part.contains(event.target) && part.scrollWidth > part.clientWidth);
    start = event.touches.length === 1 && !scrolls ? event.touches[0] : null;
  }, {passive: true});
  node.addEventListener('touchend', event => {
    if (start === null) return;
    const dx = event.changedTouches[0].clientX - start.clientX,
          dy = event.changedTouches[0].clientY - start.clientY;
    start = null;
    if (Math.abs(dx) > kSwipe && Math.abs(dx) > 2 * Math.abs(dy))
      stop(() => go(shown.moment + (dx < 0 ? 1 : -1)))();
  }, {passive: true});
}

// ---- The page --------------------------------------------------------------------------------

const key = name => element('kbd', {}, name);
const howToStep = () =>
    [key('→'), ' or a swipe to the left goes on, ', key('Space'), ' plays; each dot above is a state.'];
const howBeside = () => ['It keeps step with the first run; the arrows at its title move it alone.'];

// A loop by the drives that recur, with what else is said of it.
function endOf({replay: {outcome, start, period}, loop, end}) {
  const loops = loop !== null && loop.exact ? loopOf(outcome, start, period) : null;
  return loops === null ? end : `${loops}, for ever`;
}

const algebra = element(
    'div', {id: 'equation', class: 'algebra scroll', tabindex: '0', role: 'group', 'aria-label': 'A f + b = a'});

function panel(run, i) {
  const choose = i === 0 ? state => stop(() => go(state))() : state => stop(() => go(shown.moment, state))();
  const timeline = new Timeline(run, choose), values = new Values(data, run);
  const story = element('div', {class: 'story'}), readings = element('div'), heading = element('h3');
  const by = steps => choose(Math.max(0, Math.min(run.last, states()[1] + steps)));
  const buttons = element(
      'span', {class: 'own'}, button(icons.back, `${run.title}: back`, () => by(-1)),
      button(icons.next, `${run.title}: forward`, () => by(1)));
  const node = element(
      'section', {class: `run run-${i}`, 'aria-label': run.title}, element('h2', {}, run.title),
      element('p', {class: 'end'}, endOf(run)), timeline.node,
      element('div', {class: 'heading'}, heading, i === 0 ? null : buttons), story, values.node, readings);
  const link = (state, text) =>
      element('a', {href: `#step-${i === 0 ? state : `${shown.moment},${state}`}${tail()}`}, text);
  return {
    node,
    show(state, round) {
      timeline.show(state);
      values.show(state);
      const noun = run.replay.method === 'complete' ? 'Piece' : 'Step';
      heading.textContent = state === 0 ? 'Before the first step' : `${noun} ${state} of ${run.last}`;
      if (round > 0) heading.textContent += `, round ${round + 1} of the loop`;
      story.replaceChildren(...tellStep(run, state, link, i === 0 ? howToStep() : howBeside()));
      readings.replaceChildren(...tellReadings(run, state));
    },
  };
}

function draw() {
  const now = states(), round = runs[0].roundAt(shown.moment);
  panels.forEach((part, i) => part.show(now[i], i === 0 ? round : 0));
  algebra.replaceChildren(...equation(data, runs[0], now[0]));
  cones.show(now);
  picture?.show(now);
  controls.slider.value = now[0];
  const place = `${now[0]} / ${runs[0].last}`;
  controls.place.textContent = round > 0 ? `${place} · round ${round + 1}` : place;
  controls.link.href = address();
  controls.back.disabled = controls.first.disabled = shown.moment === 0;
  controls.next.disabled = controls.last.disabled = !runs[0].isLoop && shown.moment >= runs[0].last;
  const step = runs[0].step(now[0]);
  if (!isPlaying())
    byId('said').textContent = step === null ? 'Before the first step' : `Step ${now[0]}: ${step.event}`;
}

// The page of some data: the original's, or those of a run in the page.
function use(given) {
  play(false);
  data = given;
  runs = data.runs.map(run => new Run(run));
  parting = runs.length > 1 ? whereTheyPart(runs[0], runs[1]) : null;
  cones = new Cones(data, runs);
  picture = data.picture === null ? null : new Picture(data, runs);
  panels = runs.map((run, i) => panel(run, i));
  Object.assign(shown, {moment: 0, second: null});
  byId('name').textContent = nameOfRun(data);
  byId('file').textContent = cameAs === '' ? data.name : cameAs;
  byId('verdicts')
      .replaceChildren(...runs.map(
          (run, i) => element('p', {class: `run-${i}`}, element('b', {}, `${run.title}: `), endOf(run))));
  byId('edited').hidden = data === original || cameAs !== '';
  byId('algebra').replaceChildren(foldedIfLarge(data, algebra));
  controls.slider.max = runs[0].last;
  byId('runs').replaceChildren(...panels.map(part => part.node));
  byId('cones').replaceChildren(cones.node);
  byId('cones-note')
      .replaceChildren(
          ...runs.map((run, i) => element('span', {class: `key run-${i}`}, run.title)),
          cones.areToScale ? '' : ' The axes have scales of their own.');
  const problem = document.querySelector('.problem');
  problem.classList.toggle('large', data.rows.length > kNarrow);
  problem.classList.toggle('with-picture', picture !== null);
  byId('picture').replaceChildren();
  if (picture !== null) {
    byId('picture').append(
        picture.node,
        element(
            'figcaption', {},
            'The scene, and the force of each numbered contact at this step, in newtons; g: the way of gravity'));
  }
  byId('picture').hidden = picture === null;
}

function showOriginal() {
  shown.problem = cameAs = '';
  use(original);
  go(0);
}

// `edited`: {problem, policy} of the run.
function showEdited(data, {problem, policy}) {
  const came = cameAs === '' ? null : decoded(location.hash.match(kAddress)?.[3] ?? '');
  if (came === null || JSON.stringify(came.problem) !== JSON.stringify(problem) || came.policy !== policy) cameAs = '';
  shown.problem = encoded(cameAs === '' ? problem : {name: cameAs, ...problem}, policy);
  use(data);
  go(0);
}

const editor = new Editor(byId('edit'), original, showEdited, showOriginal);

function build() {
  byId('player').append(
      controls.first, controls.back, controls.play, controls.next, controls.last, controls.slider,
      controls.place, controls.link);
  watchKeys(keys, '#edit input, #edit select');
  addEventListener('hashchange', followAddress);
  watchSwipes(document.querySelector('main'));
}

build();
use(original);
readAddress(location.hash);
draw();
if (kAddress.test(location.hash)) followAddress();
