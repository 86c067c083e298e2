// SPDX-License-Identifier: Apache-2.0
// Numbers of the data: exact ones are strings, "-3/4"; others are doubles.
import {element, mathElement} from './dom.js';

const kMostDigits = 9;  // of a fraction that is set as one

// [numerator, denominator] of an exact number.
function parts(exact) {
  const [p, q = '1'] = exact.split('/');
  return [BigInt(p), BigInt(q)];
}

// A double near it, also of what no double's numerator holds.
export function toDouble(x) {
  if (typeof x === 'number') return x;
  const [p, q] = parts(x);
  const plain = Number(p) / Number(q);
  if (Number.isFinite(plain)) return plain;
  const shift = BigInt(Math.max(p.toString(2).length, q.toString(2).length) - 1000);
  return Number(p >> shift) / Number(q >> shift);
}

export const isZero = x => typeof x === 'number' ? x === 0 : /^-?0+(\/|$)/.test(x);

// The sign of abs(x) - m y: exact where all are, otherwise 0 where they are the same but for rounding.
export function compareWithLimit(x, m, y) {
  if (typeof x === 'number' || typeof y === 'number') {
    const size = Math.abs(toDouble(x)), most = toDouble(m) * toDouble(y);
    return Math.abs(size - most) <= 1e-9 * Math.max(size, Math.abs(most)) ? 0 : Math.sign(size - most);
  }
  const [a, b] = parts(x), [c, d] = parts(m), [e, f] = parts(y);
  const difference = (a < 0n ? -a : a) * d * f - c * e * b;
  return difference > 0n ? 1 : difference < 0n ? -1 : 0;
}

export function short(x) {
  const value = toDouble(x);
  return Number(value.toPrecision(5)).toString().replaceAll('-', '−');
}

// "-3/4" as it is read: "−3/4".
export const spoken = x => (typeof x === 'number' ? short(x) : x).replace('-', '−');

function set(x) {
  const text = typeof x === 'number' ? short(x) : x;
  const minus = /^[-−]/.test(text), [p, q] = text.replace(/^[-−]/, '').split('/');
  const size = q === undefined ? mathElement('mn', {}, p) :
                                 mathElement('mfrac', {}, mathElement('mn', {}, p), mathElement('mn', {}, q));
  const sign = minus ? mathElement('mo', {form: 'prefix'}, '−') : null;
  return mathElement('math', {displaystyle: 'true'}, mathElement('mrow', {}, sign, size));
}

// A number as an element: a fraction; a long one on a line, with its size.
export function number(x) {
  const long = typeof x === 'string' && x.split('/').some(part => part.length > kMostDigits);
  if (!long) return element('data', {value: String(x)}, set(x));
  return element(
      'data', {value: x, class: 'long'}, x.replace('-', '−'), element('small', {}, ` ≈ ${short(x)}`));
}
