// SPDX-License-Identifier: Apache-2.0
// `node live_lines.mjs MODULE`: a request a line, an answer a line, by the WebAssembly module.
import {readFileSync} from 'node:fs';
import {gunzipSync} from 'node:zlib';

import {Solver} from '../../reports/web/src/solver.js';

const solver = await Solver.from(gunzipSync(readFileSync(process.argv[2])));
for (const request of readFileSync(0, 'utf8').split('\n')) {
  if (request !== '') console.log(solver.answer(request));
}
