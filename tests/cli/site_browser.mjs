// SPDX-License-Identifier: Apache-2.0
// The site in a browser, from disk: nothing is complained of, nothing foreign asked for; keyboard, contrast,
// widths; and what is pasted. site_test.py runs it.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {assertColourScheme, assertHeadings, contrasts, openFile} from './page.mjs';

const kPages = [
  'index.html', 'gallery.html', 'theorem.html', 'paste.html', 'docs/index.html', 'docs/words.html',
  'docs/corpus/formats/problems.html', 'docs/certify/grounds.html'
];
const kNarrow = {
  viewport: {width: 390, height: 844},
  colorScheme: 'dark'
};
const kWide = {
  viewport: {width: 1400, height: 900},
  colorScheme: 'light'
};
const kText = [
  'h1', 'h2', 'p', 'li', 'a', 'b', 'code', 'th', 'td', 'dt', 'dd', 'figcaption', 'label', 'button', 'textarea',
  'select', 'summary'
];
const mayAsk = url => url.startsWith('file:') || url.startsWith('blob:null/');  // the solver's worker

// All that can be reached, by the Tab key alone.
async function assertKeyboardReachesAll(page) {
  const all = await page.$$eval(
      'a[href], button, select, textarea, [tabindex="0"]',
      nodes => nodes.filter(node => !node.disabled && !node.hidden).length);
  const seen = await page.evaluateHandle(() => new Set());
  for (let i = 0; i < all; ++i) {
    await page.keyboard.press('Tab');
    await seen.evaluate(set => set.add(document.activeElement));
  }
  assert.equal(await seen.evaluate(set => [...set].filter(node => node !== document.body).length), all);
}

for (const [width, options] of Object.entries({narrow: kNarrow, wide: kWide})) {
  for (const name of kPages) {
    test(`${name}, ${width}`, () => openFile(name, async page => {
                                assert.match(await page.title(), /^.+ - stiction$/);
                                await assertColourScheme(page, options.colorScheme);
                                await assertHeadings(page);
                                const most = await page.evaluate(() => document.documentElement.scrollWidth);
                                assert.ok(most <= options.viewport.width, `${most} pixels wide`);
                                for (const [selector, contrast] of await contrasts(
                                         page, kText.map(selector => ({selector}))))
                                  assert.ok(contrast >= 4.5, `${selector}: contrast ${contrast.toFixed(2)}`);
                                if (width === 'narrow' && !name.startsWith('docs/'))
                                  await assertKeyboardReachesAll(page);
                              }, {mayAsk, ...options}));
  }
}

const answered = page => page.waitForFunction(
    () => document.querySelector('#answer li') !== null && !document.querySelector('#run').disabled);
const words = page => page.$eval('#answer', node => node.innerText.replace(/\s+/g, ' '));

async function paste(page, values) {
  for (const [name, value] of Object.entries({A: '', b: '', mu: '', ...values})) {
    if (!await page.isDisabled(`#${name}`)) await page.fill(`#${name}`, value);
  }
  await page.click('#run');
  await page.waitForFunction(() => !document.querySelector('#run').disabled);
}

test(
    'what is pasted is run, said in words, and stands in the address',
    () => openFile('paste.html', async page => {
      await page.click('#examples >> text=a loop');
      await answered(page);
      const loop = await words(page);
      assert.match(
          loop, /A is symmetric\. A is positive semidefinite\. b is in the range of A\. So forces exist/);
      assert.match(loop, /The published algorithm never ends: the state after 2 drives comes back 5 drives/);
      assert.match(loop, /Complete driving ends, at forces that obey the law/);
      assert.match(loop, /1 slips/);
      const link = await page.$eval('#answer .calls a', node => node.getAttribute('href'));
      assert.match(link, /^#problem=[\w-]+$/);

      await page.click('#examples >> text=a jam');
      await page.waitForFunction(() => document.querySelector('#answer').innerText.includes('a step without limit'));
      assert.match(await words(page), /b is not in the range of A\. So the theorem on existence says nothing/);
      assert.match(await words(page), /No forces were found\. That is no proof/);

      await page.click('#examples >> text=in space');
      await page.waitForFunction(() => document.querySelector('#answer').innerText.includes('polygon'));

      await page.evaluate(hash => location.hash = hash, link);
      await page.waitForFunction(() => document.querySelector('#answer').innerText.includes('comes back'));
      assert.equal(await words(page), loop);

      await paste(page, {A: '1 2\n3', b: '1 2', mu: '1'});
      assert.equal(await page.innerText('#told'), 'A: found 1 numbers in row 2, expected 2');
      assert.equal(await words(page), '');  // no answer to another problem
      await paste(page, {A: '[[0.1 0]\n [0 1]]', b: '[-.30 0.]', mu: '1/3'});
      assert.match(await words(page), /1 sticks 3 0/);  // 0.3 / 0.1, of decimals
      await paste(page, {A: '2 0\n0 3', b: '1 2', mu: '-1'});
      assert.match(await page.innerText('#told'), /^problem: mu: found "-1", expected mu >= 0/);
    }, {mayAsk, ...kWide}));

test('a problem that was pasted is stepped through on a page beside', async () => {
  let href = '';
  await openFile('paste.html', async page => {
    await paste(page, {A: '2 0\n0 3', b: '-1 1', mu: '1'});
    await answered(page);
    href = await page.$eval('#answer .calls a + a', node => node.getAttribute('href'));
  }, {mayAsk, ...kWide});
  const [file, hash] = href.split('#');
  await openFile(file, async page => {
    await page.waitForSelector('#edited:not([hidden])');
    assert.match(await page.innerText('#verdicts'), /policy paper: solved/);
  }, {mayAsk, hash: `#${hash}`, ...kWide});
});
