// SPDX-License-Identifier: Apache-2.0
// The buttons of a player, and what its keys do.
import {element, icon} from './dom.js';

export const icons = {
  back: 'M12 2v12L4 8z',
  next: 'M4 2v12l8-6z',
  play: 'M4 1.5v13L14 8z',
  pause: 'M3.5 2H7v12H3.5zM9 2h3.5v12H9z',
  first: 'M2 2h2.2v12H2zM14 2v12L5 8z',
  last: 'M11.8 2H14v12h-2.2zM2 2v12l9-6z',
};

// A link to what is shown, which is copied when it is pressed.
export function copyLink(what) {
  const node = element(
      'a', {href: '#', class: 'link', title: `Copies the address of this ${what} (C)`, click: copy}, 'Copy link');
  async function copy(event) {
    event.preventDefault();
    try {
      await navigator.clipboard.writeText(new URL(node.getAttribute('href'), location.href).href);
      node.textContent = 'Copied';
    } catch {
      location.hash = node.getAttribute('href');
      node.textContent = 'In the address bar';
    }
    setTimeout(() => node.textContent = 'Copy link', 1500);
  }
  return node;
}

// All digits of all numbers, and again four.
export const showAllDigits = () => document.documentElement.classList.toggle('all-digits');

export const button = (shape, label, click, title = label) =>
    element('button', {type: 'button', 'aria-label': label, title, click}, icon(shape));
