// SPDX-License-Identifier: Apache-2.0
// The findings of a report: sorted, filtered, searched, named by what happens, and with links that play them.
import {showGallery} from './gallery.js';
import {unpacked} from './packed.js';
import {nameSetup, watchTables} from './page.js';

const data = JSON.parse(document.getElementById('data').textContent);
const lines = async () => (await unpacked(document.getElementById('lines').textContent)).split('\n');

showGallery(data, lines);
nameSetup();
watchTables();
