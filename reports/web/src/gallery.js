// SPDX-License-Identifier: Apache-2.0
// The findings as a table to sort, filter and search, a page of it at a time. What the program wrote of the first ones
// below their rows is taken as it stands, with their pictures; all else is made of the data, which is unpacked when it
// is asked for: a page with ten thousand opens as fast as one with ten.
import {byId, element} from './dom.js';
import {addressOf, nameOfFinding} from './names.js';

const pageSize = 50;
const count = x => x.toLocaleString('en');
const counted = (n, noun) => `${count(n)} ${noun}${n === 1 ? '' : 's'}`;

// How the columns of the table sort: by what, and whether the largest comes first. The program's order is that
// of interest.
const columns = [
  {by: finding => finding.signature}, {by: finding => finding.kind},
  {by: finding => finding.smallest * 100 + finding.contacts}, {by: finding => finding.drives ?? Infinity},
  {by: finding => finding.steps ?? Infinity}, {by: finding => finding.met, down: true}, {
    by: finding =>
        `${finding.generator} ${String(finding.unit).padStart(12)} ${String(finding.index).padStart(12)}`
  },
  {by: finding => finding.grid ?? ''}, {by: finding => finding.minimized_grid ?? ''},
  {by: finding => finding.nonzeros === undefined ? Infinity : finding.nonzeros * 1e6 + finding.bits}
];

// ---- One finding ----

const small = content => element('small', {}, content);
const cell = (style, ...content) => element('td', {class: style}, ...content);

function badges(finding) {
  const all = [element('span', {class: finding.stands_out ? 'badge loop' : 'badge'}, finding.kind)];
  if (finding.whole) all.push(' ', element('span', {class: 'badge whole'}, 'whole grid'));
  if (finding.change) all.push(' ', element('span', {class: 'badge change'}, finding.change));
  return all;
}

function sizeOf(finding) {
  if (finding.nonzeros !== undefined)
    return `${counted(finding.nonzeros, 'nonzero')}, ${counted(finding.bits, 'bit')}`;
  return element('span', {class: 'soft'}, finding.state === 'pending' ? 'pending' : '–');
}

let plays = 0;  // the dimension of the player's problems

// What happens, as a link that plays it, above the signature.
function headOf(finding) {
  const href = addressOf(finding, plays), name = nameOfFinding(finding);
  return [href === null ? name : element('a', {href}, name), small(element('code', {}, finding.signature))];
}

function row(finding) {
  const words = finding.words === undefined ?
      null :
      small(`${finding.words_exact ? '' : 'about '}${counted(finding.words, 'word')}`);
  return element(
      'tr', {class: 'finding'},
      element('th', {scope: 'row', class: 'signature'}, ...headOf(finding)),
      cell(null, ...badges(finding)),
      cell(
          null,
          finding.contacts === finding.smallest ? `${finding.contacts}` :
                                                  `${finding.contacts} → ${finding.smallest}`),
      cell('n', finding.drives === undefined ? '' : count(finding.drives)),
      cell('n', finding.steps === undefined ? '' : count(finding.steps)), cell('n', count(finding.met), words),
      cell(
          null, `${finding.generator} ${finding.unit}/${finding.index}`,
          finding.policy === 'paper' ? null : small(finding.policy)),
      cell(null, finding.grid), cell(null, finding.minimized_grid), cell(null, sizeOf(finding)));
}

function numbers({names, A, b, mu}) {
  const head = element(
      'tr', {}, element('th', {scope: 'col'}, 'A'),
      ...[...names, 'b', 'mu'].map(name => element('th', {scope: 'col', class: 'n'}, name)));
  const number = (text, style = '') => cell(`n ${style}${text === '0' && style === '' ? 'zero' : ''}`, text);
  const body = A.map(
      (line, i) => element(
          'tr', {}, element('th', {scope: 'row'}, names[i]), ...line.map(text => number(text)),
          number(b[i], 'edge'), number(mu[i] ?? '', 'edge')));
  return element(
      'div', {class: 'scroll', role: 'region', tabindex: 0, 'aria-label': 'A, b and mu'},
      element('table', {}, element('thead', {}, head), element('tbody', {}, ...body)));
}

const fileTitles = ['problem', 'as found', 'certificate', 'a solution exists', 'likewise, as found', 'picture'];

function details(finding) {
  const files = finding.files.flatMap(
      (file, i) => file === '' ? [] : [i === 0 ? '' : ' · ', element('a', {href: file}, fileTitles[i])]);
  return element(
      'div', {class: 'details'}, element('p', {}, finding.story),
      finding.numbers === null ? element('p', {class: 'note'}, 'Its numbers are too long for a page.') :
                                 numbers(finding.numbers),
      element('pre', {}, element('code', {}, finding.commands)),
      element('p', {class: 'note'}, 'Files: ', ...(files.length > 0 ? files : ['left out of this report.'])));
}

function more(finding) {
  const box = element('details', {}, element('summary', {}, 'A, b, mu and commands'));
  box.addEventListener('toggle', () => box.append(details(finding)), {once: true});
  return element('tr', {class: 'more'}, element('td', {colspan: columns.length}, box));
}

// ---- The table ----

class Gallery {
  // `count` findings, of which the first are here; `choices`: the values of the fields that are filtered by. `lines()`:
  // a promise of all, a line of JSON each.
  constructor({count, findings, choices}, lines, table) {
    this.count = count;
    this.unpack = lines;
    this.read = findings.map((finding, place) => ({...finding, place}));
    this.body = table.tBodies[0];
    this.rows = new Map();
    const written = [...this.body.rows];
    for (let i = 0; i + 1 < written.length; i += 2) {
      const finding = this.at(i / 2);
      this.rows.set(finding.signature, [row(finding), written[i + 1]]);
    }
    this.sorted = null;
    this.down = false;
    this.first = 0;
    this.makeControls(choices);
    this.makeHeads(table);
    this.filter();
  }

  at(place) {
    return this.read[place] ??= {...JSON.parse(this.lines[place]), place};
  }

  async readAll() {
    const table = this.body.parentNode;
    table.setAttribute('aria-busy', 'true');
    this.lines ??= await this.unpack();
    table.removeAttribute('aria-busy');
  }

  makeControls({kind, smallest, generator, policy, state, change = []}) {
    const select = (name, label, values) => {
      if (values.length < 2) return [];
      const node = element(
          'select', {id: `gallery-${name}`}, element('option', {value: ''}, 'all'),
          ...values.map(value => element('option', {value}, value)));
      node.addEventListener('change', () => this.filter());
      this.choices.push([name, node]);
      return [element('label', {class: 'choice'}, `${label} `, node)];
    };
    this.choices = [];
    this.search =
        element('input', {type: 'search', id: 'gallery-search', autocomplete: 'off', spellcheck: 'false'});
    this.search.addEventListener('input', () => this.filter());
    const controls = element(
        'div', {class: 'controls', role: 'search'}, element('label', {class: 'choice'}, 'Search ', this.search),
        ...select('kind', 'kind', kind),
        ...select('smallest', 'contacts', smallest),
        ...select('generator', 'generator', generator),
        ...select('policy', 'policy', policy),
        ...select('state', 'state', state),
        ...(change.length > 0 ? select('change', 'since', ['changed', ...change]) : []));
    this.said = element('p', {class: 'said', role: 'status'});
    const button = (text, step) => {
      const node = element('button', {type: 'button'}, text);
      node.addEventListener('click', () => this.turn(step));
      return node;
    };
    this.before = button('Previous', -pageSize);
    this.after = button('Next', pageSize);
    const order = element('button', {type: 'button', class: 'order'}, 'In order of interest');
    order.addEventListener('click', () => this.sortBy(null));
    this.order = order;
    byId('gallery').append(
        controls, element('div', {class: 'pager'}, this.before, this.after, this.said, order));
  }

  makeHeads(table) {
    this.heads = [...table.tHead.rows[0].cells];
    this.heads.forEach((head, i) => {
      const button = element('button', {type: 'button', class: 'sort'}, head.textContent);
      if (head.title) button.title = head.title;
      head.replaceChildren(button);
      button.addEventListener('click', () => this.sortBy(i));
    });
  }

  // Again by the same column: the other way round.
  sortBy(i) {
    this.down = i === null ? false : this.sorted === i ? !this.down : columns[i].down === true;
    this.sorted = i;
    this.heads.forEach((head, k) => {
      if (k === i)
        head.setAttribute('aria-sort', this.down ? 'descending' : 'ascending');
      else
        head.removeAttribute('aria-sort');
    });
    this.filter();
  }

  async filter() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted =
        this.choices.filter(([, node]) => node.value !== '').map(([name, node]) => [name, node.value]);
    const asks = words.length + wanted.length > 0;
    if (this.lines === undefined && (asks || this.sorted !== null)) {
      await this.readAll();
      return this.filter();  // by what is chosen now
    }
    const fits = finding => words.every(word => (finding.text ??= textOf(finding)).includes(word)) &&
        wanted.every(
            ([name, value]) => value === 'changed' ? finding.change !== '' : String(finding[name]) === value);
    this.shown = Array.from({length: this.count}, (_, place) => place);
    if (asks) this.shown = this.shown.filter(place => fits(this.at(place)));
    if (this.sorted !== null) {
      const {by} = columns[this.sorted], sign = this.down ? -1 : 1;
      const keys = new Map(this.shown.map(place => [place, by(this.at(place))]));
      this.shown.sort((left, right) => {
        const a = keys.get(left), b = keys.get(right);
        return a < b ? -sign : a > b ? sign : left - right;
      });
    }
    this.first = 0;
    this.show();
  }

  async turn(step) {
    await this.readAll();
    this.first = Math.max(0, Math.min(this.first + step, this.shown.length - 1));
    this.show();
  }

  rowsOf(finding) {
    if (!this.rows.has(finding.signature)) this.rows.set(finding.signature, [row(finding), more(finding)]);
    return this.rows.get(finding.signature);
  }

  show() {
    const last = Math.min(this.first + pageSize, this.shown.length);
    this.body.replaceChildren(...this.shown.slice(this.first, last).flatMap(place => this.rowsOf(this.at(place))));
    this.before.disabled = this.first === 0;
    this.after.disabled = last >= this.shown.length;
    this.order.hidden = this.sorted === null;
    const all = count(this.count);
    this.said.textContent = this.shown.length === 0 ?
        `None of ${all} findings fits.` :
        `${count(this.first + 1)} to ${count(last)} of ${counted(this.shown.length, 'finding')}` +
            (this.shown.length === this.count ? '' : `, of ${all} in all`);
  }
}

// What a search looks through.
const textOf =
    finding => [finding.signature, nameOfFinding(finding), finding.kind, finding.generator, finding.policy, finding.state,
                finding.change, finding.grid, finding.minimized_grid, finding.whole ? 'whole grid' : '']
                   .filter(Boolean)
                   .join(' ')
                   .toLowerCase();

// `data`: that of the page (../data.md); `lines()`: as of the table.
export function showGallery(data, lines) {
  plays = data.plays;
  if (byId('gallery') !== null) new Gallery(data, lines, document.querySelector('#findings > .scroll > table'));
}
