// SPDX-License-Identifier: Apache-2.0
// The page of a run of a scene in a browser; run by animation_test.py, which writes the pages.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';

import {framesOf} from '../../reports/web/src/frames.js';
import {assertColourScheme, assertHeadings, assertRunsNoOtherScript, contrasts, openFile} from './page.mjs';

const {PROGRAM} = process.env;
const names = ['plane', 'space', 'large'];
const opened = (name, use, options = {}) =>
    openFile(`${name}.html`, use, {ready: '#player input', mayAsk: url => url.startsWith('blob:'), ...options});
const dataOf = async page => {
  const data = await page.evaluate(() => JSON.parse(document.getElementById('data').textContent));
  return {...data, frames: await framesOf(data)};
};
const frame = page => page.$eval('#player input', slider => Number(slider.value));
// Of all contacts.
const openAll = page => page.click('#all summary');
const numbers = page => page.$$eval(
    '#forces tbody tr',
    rows => rows.map(row => [...row.querySelectorAll('data')].map(data => Number(data.value))));

test('frames are stepped by keys, buttons, slider and address', async () => {
  await opened('plane', async page => {
    const last = (await dataOf(page)).frames.length - 1;
    for (const [key, at] of [
             ['ArrowRight', 1], ['ArrowRight', 2], ['ArrowLeft', 1], ['End', last], ['Home', 0]]) {
      await page.keyboard.press(key);
      assert.equal(await frame(page), at);
    }
    await page.click('button[aria-label="Forward"]');
    assert.equal(await page.evaluate(() => location.hash), '#frame=1');
    await page.$eval('#player input', slider => {
      slider.value = 4;
      slider.dispatchEvent(new Event('input'));
    });
    assert.equal(await frame(page), 4);
    await page.evaluate(() => {
      location.hash = '#frame=7';
    });
    await page.waitForFunction(() => document.querySelector('#player input').value === '7');
  });
  await opened('plane', async page => assert.equal(await frame(page), 5), {hash: '#frame=5'});
});

test('playing goes to the last frame, and stops there', async () => {
  await opened('plane', async page => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press(' ');
    await page.waitForSelector('button[aria-label="Pause"]');
    await page.selectOption('#player select', '4');
    const last = (await dataOf(page)).frames.length - 1;
    await page.waitForFunction(last => Number(document.querySelector('#player input').value) === last, last);
    await page.waitForSelector('button[aria-label="Play"]');
  });
});

test('the tab key reaches the controls in their order', async () => {
  await opened('plane', async page => {
    const seen = [];
    for (let i = 0; i < 6; ++i) {
      await page.keyboard.press('Tab');
      seen.push(await page.evaluate(
          () => document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent));
    }
    assert.deepEqual(seen, ['Play', 'Forward', 'Last', 'Frame', 'Speed', 'Copy link']);
  });
});

test('energy and drift are drawn over time, with a mark at the frame that is shown', async () => {
  await opened('plane', async page => {
    const {frames} = await dataOf(page), last = frames.length - 1;
    assert.ok(frames.every(({energy, drift}) => [...energy, ...drift].every(Number.isFinite)));
    const points = await page.$$eval(
        '#charts path', paths => paths.map(path => path.getAttribute('d').split(/[ML]/).length - 1));
    assert.deepEqual(points, Array(5).fill(frames.length));
    const marks = () =>
        page.$$eval('#charts .cursor', lines => lines.map(line => Number(line.getAttribute('x1'))));
    const first = await marks();
    await page.keyboard.press('End');
    assert.equal(await frame(page), last);
    const end = await marks();
    assert.ok(first.length === 2 && first.every((x, i) => x < end[i]));
  });
});

test('the table has the numbers of the frame, and the problem that is saved gives them', async () => {
  await opened('plane', async page => {
    const {forces} = (await dataOf(page)).frames[0];
    await openAll(page);
    await page.waitForSelector('#forces tbody tr');
    const shown = await numbers(page);
    assert.deepEqual(shown.map(row => row.slice(0, 2)), forces.map(({f}) => f));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('.save')]);
    const file = await download.path();
    assert.equal(JSON.parse(readFileSync(file, 'utf8')).format, 'stiction-problem');
    const solved = JSON.parse(
        execFileSync(PROGRAM, ['solve', file, '--method', 'fast', '--arithmetic', 'double', '--json']));
    const expected = forces.flatMap(({f}) => f);
    solved.f.forEach(
        (f, i) => assert.ok(
            Math.abs(Number(f) - expected[i]) < 1e-6 * (1 + Math.abs(expected[i])), `${f}, ${expected[i]}`));
    await page.keyboard.press('End');
    assert.match(await page.textContent('#problem'), /No step follows/);
  });
});

test('the contact that is chosen has a table and a figure; all are in a table that scrolls', async () => {
  for (const name of names) {
    await opened(name, async page => {
      const {forces} = (await dataOf(page)).frames[0], numbered = forces.length <= 12;
      assert.equal(await page.locator('.marks .force').count(), forces.filter(({f}) => f[0] !== 0).length);
      const sizes = forces.map(({f}) => Math.hypot(...f)), largest = sizes.indexOf(Math.max(...sizes));
      const seen = () => page.$$eval('.marks text', texts => texts.map(text => Number(text.textContent)));
      assert.deepEqual(await seen(), numbered ? forces.map((_, i) => i + 1) : [largest + 1]);
      const check = async at => {
        assert.equal(await page.textContent('#chosen tbody th'), String(at + 1));
        assert.equal(await page.locator('#chosen tbody tr').count(), 1);
        assert.equal(await page.locator('#cones figure').count(), 1);
        assert.equal(await page.textContent('#cones figcaption strong'), `Contact ${at + 1}`);
        const mode = await page.textContent('#chosen tbody td:last-child');
        assert.ok((await page.textContent('#cones figcaption span')).endsWith(`, ${mode}`));
        assert.equal(Number(await page.getAttribute('#chosen td.n data', 'value')), forces[at].f[0]);
      };
      await check(largest);
      const next = (largest + 1) % forces.length;
      await page.keyboard.press('n');
      await check(next);
      await page.selectOption('#choice select', '0');
      await check(0);
      assert.equal((await page.textContent('#cones')).includes('scales of their own'), false);
      await openAll(page);
      await page.waitForSelector('#forces tbody tr');
      assert.equal(await page.locator('#forces tbody tr').count(), forces.length);
      const {height} = await page.locator('#forces').boundingBox();
      assert.ok(height <= 0.6 * 900 + 1, `${height} pixels high`);
    });
  }
});

test('what is less than a billionth of the largest force is shown as 0', async () => {
  await opened('plane', async page => {
    const {frames} = await dataOf(page), all = frames.flatMap(({forces}) => forces.flatMap(({f}) => f.map(Math.abs)));
    const noise = 1e-9 * Math.max(...all);
    assert.ok(all.every(size => size === 0 || size >= noise));
    await openAll(page);
    for (const {forces} of frames) {
      const shown = await numbers(page);
      for (const [i, {f}] of forces.entries()) {
        assert.deepEqual(shown[i].slice(0, 2), f);
      }
      await page.keyboard.press('ArrowRight');
    }
  });
});

test('energy, drift and creep stand under the scene', async () => {
  await opened('plane', async page => {
    const [scene, charts] = await page.$$eval(
        '#picture svg, #charts', all => all.map(node => node.getBoundingClientRect().toJSON()));
    assert.ok(charts.top >= scene.bottom && charts.left < scene.right);
    assert.match(await page.textContent('#creep'), /^Bodies at the end of the run: \d+ (rests?|creeps?|slides?|fl(y|ies)|moves?)/);
  });
});

// As in mu = 1/2: the cone rises two for one that it goes aside.
test('a cone has its own angle', async () => {
  await opened('large', async page => {
    const [[x0, y0], [x1, y1]] = await page.$eval(
        '#cones .cone',
        cone => cone.getAttribute('points').split(' ').map(point => point.split(',').map(Number)));
    assert.equal((await dataOf(page)).frames[0].forces[0].mu, 0.5);
    assert.ok(Math.abs((y0 - y1) / (x0 - x1) - 2) < 1e-3, `${x0},${y0} to ${x1},${y1}`);
  });
});

test('all cones have one scale', async () => {
  await opened('space', async page => {
    const {forces} = (await dataOf(page)).frames[0], scales = [];
    for (const [i, {f}] of forces.entries()) {
      await page.selectOption('#choice select', String(i));
      const length = await page.$eval('#cones svg', figure => {
        const from = Number(figure.querySelector('.force line').getAttribute('y1'));
        return from - Number(figure.querySelector('.tip').getAttribute('points').split(/[ ,]/)[1]);
      });
      scales.push(length / f[0]);
    }
    assert.ok(scales.every(scale => Math.abs(scale / scales[0] - 1) < 0.01), String(scales));
  });
});

test('narrow, dark and printed pages can be read', async () => {
  for (const name of names) {
    for (const colorScheme of ['light', 'dark']) {
      await opened(name, async page => {
        await assertColourScheme(page, colorScheme);
        await assertHeadings(page);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= 390, `${wide} pixels wide`);
        for (const [what, contrast] of await contrasts(
                 page, [{selector: 'p, th, td, h1, h2, button, select, figcaption, .cones figcaption *'}]))
          assert.ok(contrast >= 4.5, `${what}: ${contrast}`);
      }, {viewport: {width: 390, height: 800}, colorScheme});
    }
  }
  await opened('plane', async page => {
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
    assert.equal(await frame(page), 0);
    await page.emulateMedia({media: 'print'});
    assert.equal(await page.isVisible('#player'), false);
    await page.emulateMedia({media: 'screen'});
    await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    assert.equal(await frame(page), 3);
  }, {hash: '#frame=3'});
});

test('no other script runs', () => assertRunsNoOtherScript('plane.html'));
