// SPDX-License-Identifier: Apache-2.0
// Pasted text as a problem file in the short form: JSON as it is, MatrixMarket, or rows of numbers as numpy
// prints them. Every number stays the text that it was, so that nothing is rounded before the reader of files
// has it. What cannot be read throws an Error, in words.

const kNumber = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/, kFraction = /^[+-]?\d+\/\d+$/;

// As the reader of files takes it: "1." is "1", "+.5" is "0.5".
function exact(token, where) {
  const text = token.replace(/\u2212/g, '-').replace(/^\+/, '');
  if (kFraction.test(text)) return text;
  if (!kNumber.test(text)) throw new Error(`${where}: found ${token}, expected a number`);
  return text.replace(/^(-?)\./, '$10.').replace(/\.(?=$|[eE])/, '');
}

const isMarket = text => /^%%MatrixMarket/i.test(text);

// Rows of texts of numbers.
function market(text, where) {
  const [head, ...lines] = text.split('\n');
  const [, object, layout, field, symmetry] = head.toLowerCase().trim().split(/\s+/);
  if (object !== 'matrix' || !['coordinate', 'array'].includes(layout) ||
      !['real', 'integer'].includes(field) || !['general', 'symmetric'].includes(symmetry))
    throw new Error(
        `${where}: found ${head.trim()}, expected a matrix, coordinate or array, real or integer, ` +
        'general or symmetric');
  const tokens = lines.filter(line => !line.startsWith('%')).join(' ').trim().split(/\s+/);
  const [rows, columns] = tokens.splice(0, 2).map(Number);
  if (!(rows > 0 && columns > 0 && rows * columns <= 1e6))
    throw new Error(`${where}: expected its numbers of rows and columns after the first line`);
  const matrix = Array.from({length: rows}, () => Array(columns).fill('0')), isHalf = symmetry === 'symmetric';
  const set = (i, j, token) => {
    if (!(i >= 0 && i < rows && j >= 0 && j < columns))
      throw new Error(
          `${where}: found an entry in row ${i + 1}, column ${j + 1}, expected at most ${rows}, ${columns}`);
    matrix[i][j] = exact(token, where);
    if (isHalf) matrix[j][i] = matrix[i][j];
  };
  let places = [];
  if (layout === 'array') {  // column by column, of a symmetric one the lower half
    for (let j = 0; j < columns; ++j)
      for (let i = isHalf ? j : 0; i < rows; ++i) places.push([i, j]);
  } else {
    const entries = Number(tokens.shift());
    if (tokens.length !== 3 * entries)
      throw new Error(
          `${where}: found ${tokens.length} numbers after its sizes, expected three for each of its entries`);
    places = Array.from({length: entries}, (_, k) => [tokens[3 * k] - 1, tokens[3 * k + 1] - 1]);
  }
  const numbers = layout === 'array' ? tokens : tokens.filter((_, k) => k % 3 === 2);
  if (numbers.length !== places.length)
    throw new Error(`${where}: found ${numbers.length} numbers, expected ${places.length}`);
  places.forEach(([i, j], k) => set(i, j, numbers[k]));
  return matrix;
}

// A row ends where its bracket does, or else with its line.
function rowsOf(text, where) {
  if (text.includes('...'))
    throw new Error(
        `${where}: found ..., where numpy leaves numbers out; print all of them: ` +
        'numpy.set_printoptions(threshold=sys.maxsize)');
  const plain = text.replace(/^\s*(array|matrix)?\s*\(/, '').replace(/(,\s*dtype=[\w.]+)?\)\s*$/, '');
  const lines = plain.includes('[') ? plain.split(']') : plain.split(/[\n;]/);
  return lines.map(line => line.split(/[\s,[\];]+/).filter(token => token !== ''))
      .filter(row => row.length > 0)
      .map(row => row.map(token => exact(token, where)));
}

function matrixOf(text, where) {
  if (text.trim() === '') throw new Error(`${where}: found nothing, expected numbers`);
  const matrix = isMarket(text.trim()) ? market(text.trim(), where) : rowsOf(text, where);
  if (matrix.length === 0) throw new Error(`${where}: found no number`);
  return matrix;
}

export const isWhole = text => text.trimStart().startsWith('{');

// The text of a problem file. `dimension`: "2", "3", or "" where the sizes tell it.
export function fileOfPasted({A, b, mu, dimension}) {
  if (isWhole(A)) return A;
  const rows = matrixOf(A, 'A'), uneven = rows.findIndex(row => row.length !== rows[0].length);
  if (uneven >= 0)
    throw new Error(`A: found ${rows[uneven].length} numbers in row ${uneven + 1}, expected ${rows[0].length}`);
  if (rows.length !== rows[0].length)
    throw new Error(`A: found ${rows.length} rows of ${rows[0].length} numbers, expected as many rows`);
  const column = matrixOf(b, 'b').flat(), coefficients = matrixOf(mu, 'mu').flat();
  if (column.length !== rows.length)
    throw new Error(`b: found ${column.length} numbers, expected ${rows.length}, one for each row of A`);
  const file = {A: rows, b: column, mu: coefficients.length === 1 ? coefficients[0] : coefficients};
  if (dimension !== '') file.dimension = Number(dimension);
  return JSON.stringify(file);
}
