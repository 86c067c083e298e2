// SPDX-License-Identifier: Apache-2.0
// The pages of a report: draws its figures, plays its simplest loop and names its findings. Without it all else
// stands there.
import {byId, element} from './dom.js';
import {figures} from './figures.js';
import {lowerIndices} from './math.js';
import {addressOf, loopOf, nameOfFinding} from './names.js';
import {nameSetup, openFolded, watchTables} from './page.js';
import {drawFigures} from './places.js';
import {showPlay} from './play.js';

const data = JSON.parse(document.getElementById('data').textContent);

// Of a finding by its signature: what happens, as a link where a page plays it.
function nameFindings() {
  const findings = new Map(data.findings.map(finding => [finding.signature, finding]));
  for (const node of document.querySelectorAll('.name[data-signature]')) {
    const finding = findings.get(node.dataset.signature);
    if (finding === undefined) continue;
    const href = addressOf(finding, data.player?.problem.dimension ?? 0), name = nameOfFinding(finding);
    node.replaceChildren(href === null ? name : element('a', {href}, name));
    const loops = loopOf(finding.kind, finding.start, finding.period);
    if (loops !== null) node.parentNode.querySelector(':scope > small')?.prepend(`${loops}; `);
  }
}

nameFindings();
if (data.player !== null && byId('play') !== null) showPlay(data.player, byId('play'));
lowerIndices();
nameSetup();
watchTables();
openFolded();
drawFigures(data.figures, figures);
