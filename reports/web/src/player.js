// SPDX-License-Identifier: Apache-2.0
// The buttons of a player.
import {element, icon} from './dom.js';

export const icons = {
  back: 'M12 2v12L4 8z',
  next: 'M4 2v12l8-6z',
  play: 'M4 1.5v13L14 8z',
  pause: 'M3.5 2H7v12H3.5zM9 2h3.5v12H9z',
  first: 'M2 2h2.2v12H2zM14 2v12L5 8z',
  last: 'M11.8 2H14v12h-2.2zM2 2v12l9-6z',
};
export const button = (shape, label, click, title = label) =>
    element('button', {type: 'button', 'aria-label': label, title, click}, icon(shape));
