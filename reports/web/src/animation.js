// SPDX-License-Identifier: Apache-2.0
// A scene that moves. The address says what is shown: #frame=12, counted from 0.
import {Chart} from './charts.js';
import {Cones, forceArrow} from './cones.js';
import {byId, element, svgElement} from './dom.js';
import {framesOf} from './frames.js';
import {short} from './numbers.js';
import {button, copyLink, icons, save, setAddress, showPlaying, watchKeys} from './player.js';

const kNumbered = 12;   // contacts of a frame that have a number each; of more only the one that is chosen
const kLongest = 0.25;  // arrow, of the picture's height

const data = JSON.parse(byId('data').textContent), frames = await framesOf(data), last = frames.length - 1;

const shown = {
  frame: 0,
  began: null,
  from: 0,
  request: null,
  chosen: null,  // key of a contact; null: that of the largest force
};

// ---- Forces ----------------------------------------------------------------------------------

const tangential = f => Math.hypot(...f.slice(1));
const limit = force => force.mu * force.f[0];

// What is known of a contact by its force alone: at the limit it may rest or begin to slide.
function modeOf(force) {
  if (force.kind !== 'static') return force.kind;
  if (Math.hypot(...force.f) === 0) return 'no force';
  const most = limit(force), size = tangential(force.f);
  return size < most - 1e-6 * Math.max(size, most) ? 'sticking' : 'at the limit';
}

// The least powers of two that hold the forces of a frame, and the widest cones at them: not every frame
// changes the scale, and a blow in one leaves the forces of the others to be seen.
const powerAbove = x => x === 0 ? 0 : 2 ** Math.ceil(Math.log2(x));
function reachOf(forces) {
  let across = 0, up = 0;
  for (const force of forces) {
    across = Math.max(across, tangential(force.f), force.mu === undefined ? 0 : limit(force));
    up = Math.max(up, force.f[0]);
  }
  return [powerAbove(across), powerAbove(up)];
}

const value = x => element('data', {value: String(x)}, short(x));
const cell = x => element('td', {class: 'n'}, x === undefined ? '–' : value(x));
const inSpace = data.dimension === 3;

function row(force, i) {
  const f = force.f, most = force.mu === undefined ? undefined : limit(force);
  return element(
      'tr', {}, element('th', {scope: 'row'}, String(i + 1)),
      element('td', {class: 'pair'}, force.bodies.map(body => data.names[body]).join(' on ')), cell(f[0]),
      ...inSpace ? [cell(f[1]), cell(f[2])] : [], cell(f.length > 1 ? tangentialShown(f) : undefined),
      cell(most), cell(force.mu), element('td', {}, modeOf(force)));
}
// In the plane with its sign.
const tangentialShown = f => inSpace ? tangential(f) : f[1];

const below = index => element('sub', {}, index);

const headCell = ([style, ...name]) => element('th', {scope: 'col', class: style}, ...name);

// Of the forces with these numbers.
function table(forces, shownOnes) {
  if (forces.length === 0) return element('p', {class: 'note'}, 'No contact bears a force in this frame.');
  const head = [
    ['', 'Contact'], ['', 'Bodies'], ['n', 'f', below('N')],
    ...inSpace ? [['n', 'f', below('Fx')], ['n', 'f', below('Fy')], ['n', '|f', below('F'), '|']] :
                 [['n', 'f', below('F')]],
    ['n', 'μ f', below('N')], ['n', 'μ'], ['', 'Mode']
  ];
  return element(
      'table', {class: 'values'}, element('caption', {}, 'In newtons'),
      element('thead', {}, element('tr', {}, ...head.map(headCell))), element('tbody', {}, ...shownOnes.map(i => row(forces[i], i))));
}

function cones(forces, i) {
  const force = forces[i], run = {last: 0, f: () => force.f};
  const contacts = [{kind: force.kind, mu: force.mu, mode: modeOf(force)}];
  const figures = new Cones({problem: {dimension: data.dimension, contacts}}, [run], reachOf(forces), i + 1);
  figures.show([0]);
  return [
    figures.node, figures.areToScale ? '' : element('p', {class: 'note'}, 'The axes have scales of their own.')
  ];
}

// ---- The contact chosen ----------------------------------------------------------------------

// Of each contact its bodies, and which of these it is: the same in another frame where as many touch.
function keysOf(forces) {
  const met = new Map();
  return forces.map(({bodies}) => {
    const pair = bodies.join(','), number = met.get(pair) ?? 0;
    met.set(pair, number + 1);
    return `${pair},${number}`;
  });
}

// Its place in the frame; the largest force where none is chosen, or it does not touch.
function chosenOf(forces) {
  const at = shown.chosen === null ? -1 : keysOf(forces).indexOf(shown.chosen);
  if (at >= 0) return at;
  const sizes = forces.map(({f}) => Math.hypot(...f));
  return sizes.indexOf(Math.max(...sizes));
}

function choose(i) {
  shown.chosen = keysOf(frames[shown.frame].forces)[i];
  draw();
}

const nameOf = ({bodies}, i) => `${i + 1}: ${bodies.map(body => data.names[body]).join(' on ')}`;
const choice = element(
    'select', {'aria-label': 'Contact', change: () => choose(Number(choice.value))});
byId('choice').append(choice);

function drawChosen(forces) {
  const chosen = forces.length === 0 ? -1 : chosenOf(forces);
  if (choice.options.length !== forces.length || [...choice.options].some((option, i) => option.text !== nameOf(forces[i], i)))
    choice.replaceChildren(...forces.map((force, i) => element('option', {value: i}, nameOf(force, i))));
  choice.value = chosen;
  byId('choice').hidden = chosen < 0;
  byId('chosen').replaceChildren(table(forces, chosen < 0 ? [] : [chosen]));
  byId('cones').replaceChildren(...chosen < 0 ? [] : cones(forces, chosen));
  byId('cones').parentNode.hidden = chosen < 0;
  if (byId('all').open) byId('forces').replaceChildren(table(forces, forces.map((_, i) => i)));
  byId('all').hidden = forces.length < 2;
}
byId('all').addEventListener('toggle', () => draw());

// ---- Energy and drift ------------------------------------------------------------------------

const ofFrames = (key, i) => frames.map(frame => frame[key][i]);
const times = frames.map(({time}) => time);
const charts = [
  new Chart(
      'Energy', 'J', times,
      [
        {name: 'total', values: frames.map(({energy: [kinetic, potential]}) => kinetic + potential)},
        {name: 'kinetic', values: ofFrames('energy', 0)}, {name: 'potential', values: ofFrames('energy', 1)}
      ]),
  new Chart(
      'Drift, at worst since the frame before', 'm', times,
      [{name: 'overlap', values: ofFrames('drift', 1)}, {name: 'joints apart', values: ofFrames('drift', 0)}],
      [0]),
];
byId('charts').append(...charts.map(({node}) => node));

const plurals = {rests: 'rest', creeps: 'creep', slides: 'slide', flies: 'fly', moves: 'move'};

// What bodies do at the end of the run: "creeps" is slow, and no rest.
function tellCreep(motions) {
  const rows = motions.filter(({word}) => word === 'creeps' || word === 'slides')
                   .sort((a, b) => b.speed - a.speed)
                   .slice(0, 5);
  const many = word => motions.filter(motion => motion.word === word).length;
  const words = Object.keys(plurals).filter(word => many(word) > 0);
  const told = words.map(word => `${many(word)} ${many(word) === 1 ? word : plurals[word]}`);
  return [
    element('p', {class: 'note'}, `Bodies at the end of the run: ${told.join(', ')}.`),
    rows.length === 0 ?
        null :
        element(
            'p', {class: 'note'},
            `Fastest of those that creep or slide: ${
                rows.map(({body, speed, word}) => `${data.names[body]} ${word}, ${short(speed)} m/s`).join('; ')}.`)
  ].filter(Boolean);
}
if (data.motions?.length > 0) byId('creep').append(...tellCreep(data.motions));

// ---- The picture -----------------------------------------------------------------------------

const [width, height] = data.size;
const bodies = data.bodies.map(markup => {
  const group = svgElement('g');
  group.innerHTML = markup;  // drawn by the program, which escapes what it draws
  return group;
});
const placed = svgElement('g'), marks = svgElement('g', {class: 'marks'});
const svg = svgElement(
    'svg', {viewBox: `0 0 ${width} ${height}`, role: 'img'},
    svgElement('rect', {width: '100%', height: '100%'}), ...bodies, placed, marks);

function arrow({at, along: [x, y]}) {
  const size = Math.hypot(x, y), longest = kLongest * height, share = size > longest ? longest / size : 1;
  const style = `force run-0${size > longest ? ' cut' : ''}`;
  return forceArrow(at, [at[0] + share * x, at[1] + share * y], style);
}

function numberOf({at: [x, y]}, i, isChosen) {
  return [
    svgElement('circle', {class: isChosen ? 'contact chosen' : 'contact', cx: x, cy: y, r: 9, click: () => choose(i)}),
    svgElement('text', {class: 'contact', x, y, dy: '0.36em', 'text-anchor': 'middle'}, String(i + 1)),
  ];
}

function drawPicture(frame) {
  frame.transforms.forEach((transform, i) => bodies[i].setAttribute('transform', transform));
  placed.innerHTML = frame.placed;  // as above
  const numbered = frame.forces.length <= kNumbered, chosen = frame.forces.length === 0 ? -1 : chosenOf(frame.forces);
  marks.replaceChildren(
      ...frame.points.map(([cx, cy]) => svgElement('circle', {class: 'touch', cx, cy, r: 3})),
      ...frame.forces.filter(({along}) => along[0] !== 0 || along[1] !== 0).map(arrow),
      ...frame.forces.flatMap((force, i) => numbered || i === chosen ? numberOf(force, i, i === chosen) : []));
  svg.setAttribute(
      'aria-label', `${data.name} at ${frame.time.toFixed(3)} s, ${frame.forces.length} contacts with forces`);
}

// ---- The problem of a frame ------------------------------------------------------------------

const command = () => element('code', {}, 'stiction simulate SCENE -o FOLDER --problems PROBLEMS');
const remarks = {
  last: () =>
      ['No step follows this frame, so it has no problem: contacts and forces are those of the step before.'],
  undecided: () =>
      ['The step from here has no answer; its problem is in ', element('code', {}, 'undecided.json'), '.'],
  large: () =>
      ['A of this frame has more than 10,000 entries, too many for a page. ', command(),
       ' writes its problem.'],
  without: () => ['This page holds no problems of its frames. ', command(), ' writes them.'],
  room: () =>
      ['The problems of frames before this one fill what a page holds, 200 kB. ', command(), ' writes all.'],
};

function problems({problems: texts, remark}) {
  if (remark !== '') return remarks[remark]();
  if (texts.length === 0) return ['Nothing touches, and nothing is joined: there is no problem.'];
  return texts.map(
      (text, i) => element(
          'button', {type: 'button', class: 'save', click: () => save(text, JSON.parse(text).name.replace(/[^\w.-]/g, '_'))},
          texts.length === 1 ? 'Problem of this frame' : `Problem ${i + 1} of ${texts.length} of this frame`));
}

// ---- The player ------------------------------------------------------------------------------

const isPlaying = () => shown.request !== null;

function draw() {
  const frame = frames[shown.frame];
  drawPicture(frame);
  controls.slider.value = shown.frame;
  controls.slider.setAttribute('aria-valuetext', `frame ${shown.frame}, ${frame.time.toFixed(3)} s`);
  controls.place.textContent = `${shown.frame} / ${last} · ${frame.time.toFixed(3)} s`;
  controls.link.href = `#frame=${shown.frame}`;
  controls.back.disabled = controls.first.disabled = shown.frame === 0;
  controls.next.disabled = controls.last.disabled = shown.frame === last;
  for (const chart of charts) chart.show(shown.frame);
  drawChosen(frame.forces);
  if (isPlaying()) return;
  byId('problem').replaceChildren(...problems(frame));
  byId('said').textContent = `Frame ${shown.frame}, ${frame.time.toFixed(3)} s`;
}

function go(frame) {
  shown.frame = Math.max(0, Math.min(last, frame));
  draw();
  if (!isPlaying()) setAddress(`#frame=${shown.frame}`);
}

// The last frame up to a time.
function frameAt(time) {
  let k = shown.frame;
  while (k < last && frames[k + 1].time <= time + 1e-9) ++k;
  return k;
}

function tick(now) {
  if (shown.began === null) Object.assign(shown, {began: now, from: frames[shown.frame].time});
  const next = frameAt(shown.from + Number(controls.speed.value) * (now - shown.began) / 1000);
  shown.request = requestAnimationFrame(tick);
  if (next !== shown.frame) go(next);
  if (shown.frame === last) play(false);
}

function play(on) {
  if (isPlaying()) cancelAnimationFrame(shown.request);
  shown.request = null;
  shown.began = null;
  if (on && shown.frame === last) go(0);
  if (on) shown.request = requestAnimationFrame(tick);
  showPlaying(controls.play, on);
  if (!on) go(shown.frame);
}

const to = frameOf => () => {
  const frame = frameOf();
  play(false);
  go(frame);
};
const speeds = [['0.1', '1/10'], ['0.25', '1/4'], ['0.5', '1/2'], ['1', '1'], ['2', '2'], ['4', '4']];
const controls = {
  first: button(icons.first, 'First', to(() => 0), 'First (Home)'),
  back: button(icons.back, 'Back', to(() => shown.frame - 1), 'Back (←)'),
  play: button(icons.play, 'Play', () => play(!isPlaying()), 'Play (Space)'),
  next: button(icons.next, 'Forward', to(() => shown.frame + 1), 'Forward (→)'),
  last: button(icons.last, 'Last', to(() => last), 'Last (End)'),
  slider: element('input', {
    type: 'range',
    min: 0,
    max: last,
    step: 1,
    'aria-label': 'Frame',
    input: to(() => Number(controls.slider.value))
  }),
  place: element('span', {class: 'place'}),
  speed: element(
      'select', {'aria-label': 'Speed', change: () => (shown.began = null)},
      ...speeds.map(([value, name]) => element('option', {value, selected: value === '1'}, `${name} ×`))),
  link: copyLink('frame'),
};
const keys = {
  ' ': () => controls.play.click(),
  ArrowRight: () => controls.next.click(),
  ArrowLeft: () => controls.back.click(),
  Home: () => controls.first.click(),
  End: () => controls.last.click(),
  c: () => controls.link.click(),
  n: () => frames[shown.frame].forces.length > 0 &&
      choose((chosenOf(frames[shown.frame].forces) + 1) % frames[shown.frame].forces.length),
};

function followAddress() {
  const found = location.hash.match(/^#frame=(\d{1,9})$/);
  if (isPlaying()) play(false);
  go(found === null ? 0 : Number(found[1]));
}

byId('name').textContent = data.name;
byId('picture').prepend(element('div', {class: 'drawing'}, svg));
controls.play.disabled = last === 0;
byId('player').append(...Object.values(controls));
watchKeys(keys, 'select');
addEventListener('hashchange', followAddress);
let before = 0;
addEventListener('beforeprint', () => {  // the first frame
  if (isPlaying()) play(false);
  before = shown.frame;
  shown.frame = 0;
  draw();
});
addEventListener('afterprint', () => go(before));
followAddress();
