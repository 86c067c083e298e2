// SPDX-License-Identifier: Apache-2.0
// The panel in which a reader edits the problem and the policy, and runs again.
import {element} from './dom.js';
import {Draft, fileOf, hasMu, kKinds} from './draft.js';
import {kPatience, Live} from './live.js';
import {save} from './player.js';

const kMostRows = {  // of A that are set as fields; in space, of which the solver takes no more
  2: 24,
  3: 15,
};

// Why a page cannot run its problem again; empty if it can.
function obstacleOf({problem: {dimension}, rows}) {
  const most = kMostRows[dimension], where = dimension === 3 ? ' in space' : '';
  if (rows.length > most)
    return `Problems${where} of at most ${most} rows can be edited here; stiction replay takes more.`;
  return '';
}

// What the numbers of a run are, in words.
const wordsOf = commit =>
    'Numbers are taken exactly: integers, fractions as -3/4, decimals as 2.5e-3. The program\'s own solver runs ' +
    `in this page, and nothing leaves it. It is of commit ${commit}; the program may be newer. `;
const kArithmetic = {
  2: 'It runs over rationals.',
  3: 'In space the forces of the published algorithm are irrational: it runs over rounded numbers, as in the ' +
      'program, and a loop that it comes to is one of rounded states: stiction replay says what is proved of it. ' +
      'Complete driving, on polygons of friction, runs over rationals.',
};

const button = (text, click, attributes = {}) =>
    element('button', {type: 'button', 'aria-label': text, click, ...attributes}, text);

// Where an error of the reader of files stands: the field's key, its name for people, and the rest of the
// words.
function placeOf(error, rows) {
  const [, path, rest] = error.match(/^problem: ([^ ]+): (found .*)$/s) ?? [];
  const numbers = path?.match(/\d+/g)?.map(Number) ?? [];
  if (/^A\[\d+\]\[\d+\]$/.test(path ?? ''))
    return {
      key: `A ${numbers.join(' ')}`,
      name: `A, row ${rows[numbers[0]]}, column ${rows[numbers[1]]}`,
      rest
    };
  if (/^b\[\d+\]$/.test(path ?? '')) return {key: `b ${numbers[0]}`, name: `b, row ${rows[numbers[0]]}`, rest};
  const contact = path?.match(/^contacts\[(\d+)\]\.(kind|mu|slip)(\[\d\])?$/);
  if (contact)
    return {key: `${contact[2]} ${contact[1]}${contact[3] === '[1]' ? '[1]' : ''}`, name: `contact ${Number(contact[1]) + 1}, ${contact[2]}`, rest};
  return null;
}

export class Editor {
  // `shown(data, {problem, policy})`: called with the page's data of a run; `restored()`: back to the original.
  constructor(node, original, shown, restored) {
    Object.assign(this, {node, original, shown, restored, live: new Live(), switches: null, opening: null});
    node.append(element('h2', {id: 'edit-title'}, 'Edit, and run again'));
    const obstacle = obstacleOf(original);
    this.isPossible = obstacle === '';
    if (!this.isPossible) {
      node.append(element('p', {class: 'note'}, obstacle));
      return;
    }
    const replay = original.runs[0].replay;
    this.method = replay.method;
    this.fields = element('div');
    this.said = element('p', {class: 'told', role: 'alert'});
    this.buttons = {
      run: button('Run again', () => this.run(), {type: 'submit', click: null}),
      stop: button('Stop', () => this.live.end('stopped'), {hidden: true}),
      back: button('Back to the original', () => this.back()),
      save: button('Download the problem', () => this.save()),
    };
    this.form = element(
        'form', {
          autocomplete: 'off',
          submit: event => {
            event.preventDefault();
            this.run();
          }
        },
        this.fields, element('p', {class: 'buttons'}, ...Object.values(this.buttons)), this.said);
    this.details = element(
        'details', {toggle: () => this.details.open && this.open()},
        element('summary', {}, 'Change A, b, friction, kinds of contacts, or the policy'),
        element(
            'p', {class: 'note'}, wordsOf(node.dataset.solver) + kArithmetic[original.problem.dimension]),
        this.form);
    node.append(this.details);
    this.take(new Draft(original.problem, replay.policy ?? 'paper'));
  }

  take(draft) {
    this.draft = draft;
    this.draw();
  }

  // The table of switches is the solver's; asked for once.
  open() {
    this.opening ??= this.askSwitches().finally(() => this.opening = null);
    return this.opening;
  }

  async askSwitches() {
    if (this.switches !== null) return;
    const answer = await this.live.ask({ask: 'switches'});
    if (answer.error !== undefined) {
      this.tell(answer.error);
      return;
    }
    this.switches = this.original.problem.dimension === 3 ? answer.in_space : answer.switches;
    this.limits = answer.limits;
    this.draw();
  }

  // ---- Fields ----

  input(key, label, value, change) {
    return element('input', {
      type: 'text',
      inputmode: 'text',
      spellcheck: 'false',
      autocapitalize: 'off',
      size: Math.max(4, Math.min(12, value.length + 1)),
      'data-key': key,
      'aria-label': label,
      value,
      input: event => change(event.target.value)
    });
  }

  select(key, label, value, options, change) {
    const node = element(
        'select', {'data-key': key, 'aria-label': label, change: event => change(event.target.value)},
        ...options.map(([name, text]) => element('option', {value: name, selected: name === value}, text)));
    return node;
  }

  // Changes what fields there are.
  change(how) {
    how();
    this.draw();
  }

  draw() {
    this.fields.replaceChildren(this.contacts(), this.matrix(), this.policy());
  }

  contacts() {
    const {draft} = this;
    const one = (contact, i) => {
      const name = `contact ${i + 1}`;
      const kind = this.select(
          `kind ${i}`, `Kind of ${name}`, contact.kind,
          [...new Set([...kKinds, contact.kind])].map(kind => [kind, kind]), kind => {
            this.change(() => draft.setKind(i, kind));
            this.field(`kind ${i}`).focus();
          });
      const mu =
          this.input(`mu ${i}`, `Friction coefficient of ${name}`, contact.mu, text => contact.mu = text);
      return element(
          'li', {}, element('b', {}, `Contact ${i + 1} `), kind,
          hasMu(contact.kind) ? element('span', {}, ' μ = ', mu) : null,
          contact.kind === 'sliding' ? this.slip(contact, i) : null,
          button('Remove', () => this.change(() => draft.removeContact(i)), {'aria-label': `Remove ${name}`}));
    };
    const isFull = draft.b.length + draft.rowsOf('static') > kMostRows[draft.dimension];
    return element(
        'fieldset', {}, element('legend', {}, 'Contacts'),
        element('ol', {class: 'contacts'}, ...draft.contacts.map(one)),
        button('Add a contact', () => this.change(() => draft.addContact()), {disabled: isFull}));
  }

  // Of a sliding contact: along its axis; in space a unit vector in the plane of the contact.
  slip(contact, i) {
    const label = `Direction of slip of contact ${i + 1}`;
    if (this.draft.dimension === 2)
      return this.select(
          `slip ${i}`, label, contact.slip, [['1', 'slips along +'], ['-1', 'slips along -']],
          slip => contact.slip = slip);
    const one = k => this.input(
        k === 0 ? `slip ${i}` : `slip ${i}[${k}]`, `${label}, ${'xy'[k]}`, contact.slip[k],
        text => contact.slip[k] = text);
    return element('span', {}, ' slips along ', one(0), ' ', one(1));
  }

  matrix() {
    const {draft} = this, {rows} = draft, head = text => element('th', {scope: 'col'}, text);
    const entry = (i, j) => element(
        'td', {}, this.input(`A ${i} ${j}`, `A, row ${rows[i]}, column ${rows[j]}`, draft.A[i][j], text => {
          draft.set(i, j, text);
          if (draft.isSymmetric && i !== j) this.field(`A ${j} ${i}`).value = text;
        }));
    const line = (row, i) => element(
        'tr', {}, element('th', {scope: 'row'}, row), ...rows.map((_, j) => entry(i, j)),
        element(
            'td', {class: 'b'}, this.input(`b ${i}`, `b, row ${row}`, draft.b[i], text => draft.b[i] = text)));
    const mirror = element('input', {
      type: 'checkbox',
      'aria-label': 'Keep A symmetric',
      checked: draft.isSymmetric,
      change: event => draft.isSymmetric = event.target.checked
    });
    return element(
        'fieldset', {}, element('legend', {}, 'A and b'),
        element(
            'div', {class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Entries of A and b'},
            element(
                'table', {class: 'entries'},
                element('thead', {}, element('tr', {}, element('td'), ...rows.map(head), head('b'))),
                element('tbody', {}, ...rows.map(line)))),
        element('label', {}, mirror, ' an entry of A stands for its mirror image, too'));
  }

  policy() {
    if (this.method !== 'baraff') return '';
    const {policy} = this.draft;
    const one = ({name, question, values}) => element(
        'label', {}, element('span', {}, element('b', {}, name), ` ${question}`),
        this.select(
            `policy ${name}`, `${name}: ${question}`, policy.get(name) ?? values[0].name,
            values.map(
                (value, i) => [value.name, `${value.name}${i === 0 ? ' (paper)' : ''}: ${value.meaning}`]),
            value => policy.set(name, value)));
    return element(
        'fieldset', {class: 'policy'}, element('legend', {}, 'Policy: how the text is read'),
        ...(this.switches ?? []).map(one));
  }

  // ---- What is done ----

  field(key) {
    return this.fields.querySelector(`[data-key="${key}"]`);
  }

  tell(text) {
    this.said.textContent = text;
  }

  tellError(error) {
    const place = placeOf(error, this.draft.rows), field = place === null ? null : this.field(place.key);
    this.tell(place === null ? error : `${place.name}: ${place.rest}`);
    if (field === null) return;
    field.setAttribute('aria-invalid', 'true');
    field.focus();
  }

  isBusy(on) {
    this.buttons.run.disabled = on;
    this.buttons.stop.hidden = !on;
    if (on) this.tell(`Running; it is stopped after ${kPatience} seconds.`);
  }

  // Of the problem as it is in the panel: the original's own name for the original.
  file() {
    const problem = this.draft.problem(), original = new Draft(this.original.problem, 'paper').problem();
    this.isOriginal = JSON.stringify(problem) === JSON.stringify(original);
    return fileOf(this.isOriginal ? this.original.name : `${this.original.name}-edited`, problem);
  }

  async run() {
    await this.open();
    if (this.switches === null) return false;
    for (const field of this.fields.querySelectorAll('[aria-invalid]')) field.removeAttribute('aria-invalid');
    const problem = this.file(), policy = this.draft.policyName(this.switches), isOriginal = this.isOriginal;
    this.isBusy(true);
    const answer = await this.live.ask({ask: 'run', problem, method: this.method, policy});
    this.isBusy(false);
    if (answer.error !== undefined) {
      this.tellError(answer.error);
      return false;
    }
    if (isOriginal) {
      const {picture, every_policy, looping, policies} = this.original;
      Object.assign(answer.data, {picture, every_policy, looping, policies});
    }
    this.tell(this.summary(answer.data.runs));
    this.shown(answer.data, {problem: this.draft.problem(), policy});
    return true;
  }

  // How the runs ended; budgets of the page are said where one is spent.
  summary(runs) {
    const ends = runs.map(run => `${run.title}: ${run.end}.`).join(' ');
    const most = Object.entries(this.limits).map(([name, value]) => `--${name} ${value}`).join(' ');
    return runs.some(run => run.replay.outcome === 'limit') ? `${ends} A run in this page has ${most}.` : ends;
  }

  back() {
    this.live.end('stopped');
    this.take(new Draft(this.original.problem, this.original.runs[0].replay.policy ?? 'paper'));
    this.tell('The original.');
    this.restored();
  }

  save() {
    const file = this.file();
    save(file, JSON.parse(file).name);
  }
}
