// SPDX-License-Identifier: Apache-2.0
// A problem that is being edited, every number as the text that was typed; and the policy to run it under.
// In space a contact with friction has two rows of it, and a sliding one a direction of two components.

export const kKinds = ['static', 'frictionless', 'sliding', 'bilateral'];
export const hasMu = kind => kind === 'static' || kind === 'sliding';
const rowsOf = (kind, dimension) => hasMu(kind) ? dimension : 1;
const usualSlip = dimension => dimension === 3 ? ['1', '0'] : '1';

// A of a problem as rows.
function dense(A, size) {
  if (Array.isArray(A)) return A.map(row => [...row]);
  const rows = Array.from({length: size}, () => Array(size).fill('0'));
  const listed = new Set(A.entries.map(([i, j]) => `${i},${j}`));
  for (const [i, j, x] of A.entries) {
    rows[i][j] = x;
    if (!listed.has(`${j},${i}`)) rows[j][i] = x;
  }
  return rows;
}

// What was typed, as the reader of files takes it.
const typed = text => text.trim().replace(/\u2212/g, '-');

export class Draft {
  // `problem`: of a page; `policy`: "paper", or as "ties=contacts,drop=variable".
  constructor(problem, policy) {
    this.dimension = problem.dimension;
    this.contacts = problem.contacts.map(({kind, mu = '1', slip = usualSlip(this.dimension)}) => ({
                                           kind,
                                           mu,
                                           slip: Array.isArray(slip) ? [...slip] : slip,
                                         }));
    this.b = [...problem.b];
    this.A = dense(problem.A, this.b.length);
    this.policy = new Map(policy === 'paper' ? [] : policy.split(',').map(word => word.split('=')));
    this.isSymmetric = this.A.every((row, i) => row.every((x, j) => x === this.A[j][i]));
  }

  // "N1", "F1", in space "N1", "F1x", "F1y", ... by row.
  get rows() {
    const friction = this.dimension === 3 ? ['x', 'y'] : [''];
    return this.contacts.flatMap(
        ({kind}, i) => [`N${i + 1}`, ...(hasMu(kind) ? friction.map(axis => `F${i + 1}${axis}`) : [])]);
  }

  rowsOf(kind) {
    return rowsOf(kind, this.dimension);
  }

  firstRow(contact) {
    return this.contacts.slice(0, contact).reduce((sum, {kind}) => sum + this.rowsOf(kind), 0);
  }

  set(i, j, text) {
    this.A[i][j] = text;
    if (this.isSymmetric) this.A[j][i] = text;
  }

  // New rows are zero but for a one on the diagonal.
  insertRow(at) {
    for (const row of this.A) row.splice(at, 0, '0');
    this.A.splice(at, 0, Array(this.A.length + 1).fill('0'));
    this.A[at][at] = '1';
    this.b.splice(at, 0, '0');
  }

  removeRow(at) {
    for (const row of this.A) row.splice(at, 1);
    this.A.splice(at, 1);
    this.b.splice(at, 1);
  }

  setKind(contact, kind) {
    const at = this.firstRow(contact) + 1, before = this.rowsOf(this.contacts[contact].kind);
    for (let k = before; k < this.rowsOf(kind); ++k) this.insertRow(at);
    for (let k = before; k > this.rowsOf(kind); --k) this.removeRow(at);
    this.contacts[contact].kind = kind;
  }

  addContact() {
    this.contacts.push({kind: 'frictionless', mu: '1', slip: usualSlip(this.dimension)});
    this.insertRow(this.A.length);
    this.setKind(this.contacts.length - 1, 'static');
  }

  removeContact(contact) {
    const at = this.firstRow(contact);
    for (let k = this.rowsOf(this.contacts[contact].kind); k > 0; --k) this.removeRow(at);
    this.contacts.splice(contact, 1);
  }

  // What a problem file says of it beside its name.
  problem() {
    const contacts = this.contacts.map(({kind, mu, slip}) => {
      if (!hasMu(kind)) return {kind};
      if (kind !== 'sliding') return {kind, mu: typed(mu)};
      return {kind, mu: typed(mu), slip: Array.isArray(slip) ? slip.map(typed) : slip};
    });
    return {dimension: this.dimension, contacts, A: this.A.map(row => row.map(typed)), b: this.b.map(typed)};
  }

  policyName(switches) {
    const words =
        switches.map(({name, values}) => [name, this.policy.get(name) ?? values[0].name, values[0].name])
            .filter(([, value, usual]) => value !== usual)
            .map(([name, value]) => `${name}=${value}`);
    return words.length === 0 ? 'paper' : words.join(',');
  }
}

// The text of a problem file, a contact and a row of A a line.
export function fileOf(name, {dimension, contacts, A, b}) {
  const lines = list =>
      list.length === 0 ? '[]' : `[\n    ${list.map(x => JSON.stringify(x)).join(',\n    ')}\n  ]`;
  return `{\n  "format": "stiction-problem", "version": 1,\n  "name": ${
             JSON.stringify(name)}, "dimension": ${dimension},\n` +
      `  "contacts": ${lines(contacts)},\n  "A": ${lines(A)},\n  "b": ${JSON.stringify(b)}\n}\n`;
}

// ---- In an address -----------------------------------------------------------------------------

const kMostOfAddress = 6000;  // characters

// Letters of an address for a problem and a policy; empty for what is too long.
export function encoded(problem, policy) {
  const bytes = new TextEncoder().encode(JSON.stringify({...problem, policy}));
  const text = btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(''));
  return text.length > kMostOfAddress ? '' : text.replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

const isText = x => typeof x === 'string';
const isTexts = list => Array.isArray(list) && list.every(isText);

// {name, problem, policy} of such letters, the name empty of what was edited, of any texts; null for what has not their form and sizes.
export function decoded(letters) {
  try {
    const plain = atob(letters.replace(/-/g, '+').replace(/_/g, '/'));
    const bytes = Uint8Array.from(plain, letter => letter.charCodeAt(0));
    // An address that tells no dimension is of a problem in the plane.
    const {name = '', dimension = 2, contacts, A, b, policy} = JSON.parse(new TextDecoder().decode(bytes));
    if (dimension !== 2 && dimension !== 3) return null;
    const isSlip = slip => slip === undefined ||
        (dimension === 3 ? isTexts(slip) && slip.length === 2 : isText(slip));
    const isContact = contact => contact !== null && typeof contact === 'object' && isText(contact.kind) &&
        isText(contact.mu ?? '') && isSlip(contact.slip);
    if (!Array.isArray(contacts) || !contacts.every(isContact) || !isText(policy) || !isText(name)) return null;
    const rows = contacts.reduce((sum, {kind}) => sum + rowsOf(kind, dimension), 0);
    const has = list => isTexts(list) && list.length === rows;
    const fits = has(b) && Array.isArray(A) && A.length === rows && A.every(has);
    return fits ? {name, problem: {dimension, contacts, A, b}, policy} : null;
  } catch {
    return null;
  }
}
