// SPDX-License-Identifier: Apache-2.0
// The solver that the page brings along, asked from the page: it runs beside it, and is ended when it takes too
// long.
import {byId} from './dom.js';

export const kPatience = 20;  // seconds

export class Live {
  constructor() {
    this.worker = null;
    this.waiting = null;
  }

  start() {
    const source = new Blob([WORKER_SOURCE], {type: 'text/javascript'}), url = URL.createObjectURL(source);
    this.worker = new Worker(url);
    URL.revokeObjectURL(url);
    this.worker.onmessage = ({data}) => this.settle(JSON.parse(data));
    this.worker.onerror = event => {
      event.preventDefault();
      this.end(`the solver does not run here: ${event.message || 'this browser allows a page no worker'}`);
    };
    this.worker.postMessage(byId('solver').textContent.trim());
  }

  settle(answer) {
    clearTimeout(this.timer);
    const resolve = this.waiting;
    this.waiting = null;
    resolve?.(answer);
  }

  // Gives up what runs, and says why.
  end(reason) {
    this.worker?.terminate();
    this.worker = null;
    this.settle({error: reason});
  }

  // The answer to a request (cli/live/live.h), of which there is one at a time.
  ask(request) {
    if (this.waiting !== null) this.end('another run was asked for');
    return new Promise(resolve => {
      this.waiting = resolve;
      try {
        if (this.worker === null) this.start();
        this.timer = setTimeout(
            () => this.end(`no end within ${kPatience} seconds: the run was stopped`), 1000 * kPatience);
        this.worker.postMessage(JSON.stringify(request));
      } catch (error) {
        this.end(`the solver does not run here: ${error.message}`);
      }
    });
  }
}
