// SPDX-License-Identifier: Apache-2.0
// Where the system has no font for formulas, browsers set indices on the line of their letter: the style sheet
// lowers them then.
export function lowerIndices() {
  const sample = document.querySelector('msub');
  if (sample === null) return;
  const [letter, index] = [...sample.children].map(node => node.getBoundingClientRect());
  if (index.bottom - letter.bottom < 0.12 * letter.height)
    document.documentElement.classList.add('no-math-font');
}
