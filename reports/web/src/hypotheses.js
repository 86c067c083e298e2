// SPDX-License-Identifier: Apache-2.0
// Whether the theorem on existence speaks of a problem: A symmetric and semidefinite, b in its range; exact.

const gcd = (a, b) => b === 0n ? a : gcd(b, a % b);

// Fractions as [numerator, denominator > 0], in lowest terms.
function fraction(p, q) {
  const common = gcd(p < 0n ? -p : p, q);
  return common === 0n ? [0n, 1n] : [p / common, q / common];
}
const parsed = text => {
  const [p, q = '1'] = text.split('/');
  return fraction(BigInt(p), BigInt(q));
};
const isZero = ([p]) => p === 0n;
// x - y z / w, w not zero.
function eliminated([a, b], [c, d], [e, f], [g, h]) {
  const up = c * e * h, down = d * f * g, sign = down < 0n ? -1n : 1n;
  return fraction(a * down * sign - b * up * sign, b * down * sign);
}

// Of rows of exact texts. Where A is not symmetric, or not semidefinite, no more is looked at: null.
export function hypotheses(rows, column) {
  if (rows.some((row, i) => row.some((x, j) => x !== rows[j][i])))
    return {isSymmetric: false, isSemidefinite: null, isInRange: null};
  const A = rows.map(row => row.map(parsed)), b = column.map(parsed), left = new Set(A.keys());
  for (;;) {
    const pivot = [...left].find(i => !isZero(A[i][i]));
    if (pivot === undefined) break;
    if (A[pivot][pivot][0] < 0n) return {isSymmetric: true, isSemidefinite: false, isInRange: null};
    left.delete(pivot);
    for (const i of left) {
      b[i] = eliminated(b[i], A[i][pivot], b[pivot], A[pivot][pivot]);
      for (const j of left)
        if (j <= i) A[i][j] = A[j][i] = eliminated(A[i][j], A[i][pivot], A[pivot][j], A[pivot][pivot]);
    }
  }
  const rest = [...left];
  if (rest.some(i => rest.some(j => !isZero(A[i][j]))))
    return {isSymmetric: true, isSemidefinite: false, isInRange: null};
  return {isSymmetric: true, isSemidefinite: true, isInRange: rest.every(i => isZero(b[i]))};
}
