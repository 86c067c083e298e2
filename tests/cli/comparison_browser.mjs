// SPDX-License-Identifier: Apache-2.0
// The page of two campaigns in a browser; run by report_page_test.py, which writes it: `compared`.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {assertColourScheme, assertHeadings, assertRunsNoOtherScript, contrasts, openFile} from './page.mjs';

const {PAGES} = process.env;
const file = join('compared', 'index.html');
const opened = (use, options = {}) => openFile(file, use, {ready: 'html[data-drawn]', ...options});

// No cell of these has a comma in it.
function csv(name) {
  const [head, ...rows] =
      readFileSync(join(PAGES, 'compared', name), 'utf8').trimEnd().split('\r\n').map(line => line.split(','));
  return rows.map(row => Object.fromEntries(head.map((column, i) => [column, row[i]])));
}

const count = text => Number(text).toLocaleString('en');
const titles = (page, figure) =>
    page.$$eval(`figure[data-figure="${figure}"] svg title`, all => all.map(node => node.textContent));

test('every plot of two campaigns is drawn, has a name, and has the numbers of the tables', async () => {
  await opened(async page => {
    for (const name of ['comparison', 'comparison_steps']) {
      const plots = await page.$$eval(
          `figure[data-figure="${name}"] svg`,
          all => all.map(svg => [svg.getAttribute('role'), svg.getAttribute('aria-label') ?? '',
                                 svg.querySelectorAll('line, path, circle').length]));
      assert.ok(plots.length > 0, name);
      for (const [role, label, marks] of plots) {
        assert.equal(role, 'img');
        assert.ok(label.length > 20 && marks > 2, `${name}: ${label}, ${marks} marks`);
      }
    }
    const loops = csv('comparison.csv').filter(row => row.measure === 'loops' && row.friction === ''),
          told = await titles(page, 'comparison');
    assert.equal(told.length, 2 * loops.length);
    for (const row of loops) {
      for (const side of ['a', 'b']) {
        const start = `${row.generator}, ${row.contacts} contact${row.contacts === '1' ? '' : 's'}, ` +
            `${side.toUpperCase()}: ${count(row[`${side}_count`])} of ${count(row[`${side}_of`])}, `;
        assert.ok(told.some(text => text.startsWith(start)), start);
      }
    }
    const steps = csv('comparison_steps.csv'), runs = await titles(page, 'comparison_steps');
    const expected = ['a', 'b'].flatMap(side => steps.map(row => row[`${side}_problems`]).filter(n => n !== '0'));
    assert.deepEqual(runs.map(text => text.match(/: ([\d,]+) runs/)[1]).sort(), expected.map(count).sort());
    assert.doesNotMatch(await page.innerHTML('main'), /NaN|undefined|Infinity/);
    await assertHeadings(page);
  });
});

test('where none was seen a dotted line ends at the upper end of the interval', async () => {
  await opened(async page => {
    const none = csv('comparison.csv').filter(row => row.measure === 'loops' && row.friction === '')
                     .flatMap(row => [row.a_count, row.b_count]).filter(n => n === '0');
    const dotted = await page.$$eval(
        'figure[data-figure="comparison"] svg [stroke-dasharray] line, figure[data-figure="comparison"] svg line[stroke-dasharray]',
        all => all.filter(node => node.getBoundingClientRect().width > 2).length);
    assert.ok(none.length > 0);
    assert.equal(dotted, none.length);
  });
});

test('two campaigns in the dark and in the light have contrast', async () => {
  for (const colorScheme of ['light', 'dark']) {
    await opened(async page => {
      await assertColourScheme(page, colorScheme);
      const read = await contrasts(page, [
        ...['h1', 'p', 'li', '.note', 'th', 'td', 'td small', 'figcaption', '.legend li', 'dt', 'pre code'].map(
            selector => ({selector})),
        {selector: '.plot-svg text', paint: 'fill', on: 'figure'}
      ]);
      for (const [text, contrast] of read) assert.ok(contrast >= 4.5, `${colorScheme}: ${text}: ${contrast}`);
    }, {colorScheme});
  }
});

test('two campaigns on a phone are not cut off, and no other script runs', async () => {
  await opened(async page => {
    assert.deepEqual(
        await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]), [360, 360]);
    await page.emulateMedia({media: 'print'});
    assert.ok(await page.isVisible('figure[data-figure="comparison"] svg'));
    assert.ok(!await page.isVisible('nav'));
  }, {viewport: {width: 360, height: 740}, isMobile: true, hasTouch: true});
  await assertRunsNoOtherScript(file);
});
