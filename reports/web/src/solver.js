// SPDX-License-Identifier: Apache-2.0
// The solver as a WebAssembly module (cli/live), which asks for nothing of its host but time and an end.

// What the module's C library imports. Nothing is read or written; numbers are WASI's error codes.
function host(memory) {
  const nothing = () => 0, unsupported = () => 52;
  return {
    env: {emscripten_notify_memory_growth: nothing},
    wasi_snapshot_preview1: new Proxy(
        {
          environ_sizes_get(count, size) {
            new DataView(memory().buffer).setUint32(count, 0, true);
            new DataView(memory().buffer).setUint32(size, 0, true);
            return 0;
          },
          environ_get: nothing,
          proc_exit(code) {
            throw new Error(`the solver ended with ${code}`);
          },
        },
        {get: (given, name) => given[name] ?? unsupported}),
  };
}

export class Solver {
  // `bytes`: of the module.
  static async from(bytes) {
    let instance = null;
    ({instance} = await WebAssembly.instantiate(bytes, host(() => instance.exports.memory)));
    instance.exports._initialize();
    return new Solver(instance.exports);
  }

  constructor(exports) {
    this.exports = exports;
  }

  // The answer to a request (cli/live/live.h), both JSON texts.
  answer(request) {
    const bytes = new TextEncoder().encode(request), {exports} = this;
    const at = exports.request(bytes.length);
    new Uint8Array(exports.memory.buffer, at, bytes.length).set(bytes);
    const answer = exports.answer();
    return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, answer, exports.size()));
  }
}
