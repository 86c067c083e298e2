// SPDX-License-Identifier: Apache-2.0
// The page of a report: draws its figures, and makes its findings sortable. Without it all else stands there.
import {figures} from './figures.js';
import {showGallery} from './gallery.js';
import {lowerIndices} from './math.js';
import {drawFigures} from './places.js';

const data = JSON.parse(document.getElementById('data').textContent);

lowerIndices();
showGallery(data.findings);
drawFigures(data.figures, figures);

// The folder of the page, where its commands stand.
const setup = document.querySelector('pre.setup code');
if (setup && location.protocol === 'file:') {
  const folder = decodeURIComponent(location.pathname).replace(/\/[^/]*$/, '') || '/';
  setup.textContent = `cd '${folder.replaceAll('\'', '\'\\\'\'')}'\n${setup.textContent}`;
}
