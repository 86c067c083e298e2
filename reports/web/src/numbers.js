// SPDX-License-Identifier: Apache-2.0
// Numbers of the data: exact ones are strings, "-3/4"; others are doubles.
import {element, mathElement} from './dom.js';

const kDigits = 4;       // that are shown, of what has more
const kMostDigits = 6;   // of a whole number that is shown in full

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
  return Number(value.toPrecision(kDigits)).toString().replaceAll('-', '−');
}

// The largest of 1, 2, 5, 10, ... up to x.
export function roundBelow(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [5, 2, 1].find(factor => factor * power <= x);
}

// Whether all of it is shown.
function isShort(x) {
  if (typeof x === 'number') return Number(x.toPrecision(kDigits)) === x;
  return x.includes('/') ? x.replace(/[-/]/g, '').length <= kDigits : x.replace('-', '').length <= kMostDigits;
}

// "-3/4" as it is read: "−3/4"; in few digits where it is long.
export const spoken = x => (typeof x === 'number' || !isShort(x) ? short(x) : x).replace('-', '−');

function set(text) {
  const minus = /^[-−]/.test(text), [p, q] = text.replace(/^[-−]/, '').split('/');
  const size = q === undefined ? mathElement('mn', {}, p) :
                                 mathElement('mfrac', {}, mathElement('mn', {}, p), mathElement('mn', {}, q));
  const sign = minus ? mathElement('mo', {form: 'prefix'}, '−') : null;
  return mathElement('math', {displaystyle: 'true'}, mathElement('mrow', {}, sign, size));
}

// A number as an element: exact where it is short, otherwise rounded, and exact where one points at it or asks for
// all digits (player.js).
export function number(x) {
  if (isShort(x)) return element('data', {value: String(x)}, set(typeof x === 'number' ? short(x) : x));
  const exact = String(x).replaceAll('-', '−');
  return element(
      'data', {value: String(x), title: exact}, element('span', {class: 'near'}, set(short(x))),
      element('span', {class: 'exact'}, exact));
}
