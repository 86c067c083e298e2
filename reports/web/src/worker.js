// SPDX-License-Identifier: Apache-2.0
// The solver in a thread of its own. The first message is the module, compressed, in base64; each other one a
// request.
import {unpackedBytes} from './packed.js';
import {Solver} from './solver.js';

let solver = null;  // a promise of it
self.onmessage = async ({data}) => {
  if (solver === null) {
    solver = unpackedBytes(data, 'gzip').then(bytes => Solver.from(bytes));
    solver.catch(() => {});  // told with the first request
    return;
  }
  try {
    self.postMessage((await solver).answer(data));
  } catch (error) {
    self.postMessage(JSON.stringify({error: `the solver does not run here: ${error.message}`}));
  }
};
