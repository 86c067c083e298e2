// SPDX-License-Identifier: Apache-2.0
// What pages do with their buttons, keys, address and files.
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

export function showPlaying(node, on) {
  node.replaceChildren(icon(on ? icons.pause : icons.play));
  node.setAttribute('aria-label', on ? 'Pause' : 'Play');
}

// `keys`: what each does, but where the focus is on one of `others`; the space bar presses what can be pressed.
export function watchKeys(keys, others) {
  document.addEventListener('keydown', event => {
    const {key, target} = event, passes = key === ' ' ? `${others}, button, a, summary` : others;
    if (event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    if (keys[key] === undefined || target.closest?.(passes)) return;
    keys[key]();
    event.preventDefault();
  });
}

export function setAddress(hash) {
  try {
    history.replaceState(null, '', hash);
  } catch {
    // Some browsers allow only so many a second.
  }
}

export function save(text, name) {
  const url = URL.createObjectURL(new Blob([text], {type: 'application/json'}));
  element('a', {href: url, download: `${name}.json`}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const button = (shape, label, click, title = label) =>
    element('button', {type: 'button', 'aria-label': label, title, click}, icon(shape));
