// SPDX-License-Identifier: Apache-2.0
// What the pages of a report have in common: commands know the folder, tables say that they scroll, and what is
// folded opens for a link to it.
import {element} from './dom.js';

// The folder of the page, where its commands stand.
export function nameSetup() {
  const setup = document.querySelector('pre.setup code');
  if (!setup || location.protocol !== 'file:') return;
  const folder = decodeURIComponent(location.pathname).replace(/\/[^/]*$/, '') || '/';
  setup.textContent = `cd '${folder.replaceAll('\'', '\'\\\'\'')}'\n${setup.textContent}`;
}

export function watchTables() {
  const told = new Map();
  const tell = box => {
    const scrolls = box.scrollWidth > box.clientWidth + 1;
    if (scrolls && !told.has(box)) {
      told.set(box, element('p', {class: 'scrolls', 'aria-hidden': 'true'}, 'Scrolls sideways →'));
      box.before(told.get(box));
    }
    if (told.has(box)) told.get(box).hidden = !scrolls;
  };
  const watch = new ResizeObserver(entries => entries.forEach(({target}) => tell(target)));
  for (const box of document.querySelectorAll('.scroll')) watch.observe(box);
}

export function openFolded() {
  const open = () => {
    const target = location.hash.length > 1 ? document.getElementById(location.hash.slice(1)) : null;
    const folded = target?.querySelector(':scope > details');
    if (folded) folded.open = true;
  };
  addEventListener('hashchange', open);
  open();
}
