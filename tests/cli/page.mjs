// SPDX-License-Identifier: Apache-2.0
// What the tests of pages in a browser share. PAGES: the folder of the pages; PACKAGES: where playwright-core
// is; BROWSER: the browser's program.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {after, before} from 'node:test';
import {pathToFileURL} from 'node:url';

const {PAGES, PACKAGES, BROWSER} = process.env;
const {chromium} = createRequire(join(PACKAGES, 'package.json'))('playwright-core');
let browser;

before(async () => {
  browser = await chromium.launch({executablePath: BROWSER, args: ['--no-sandbox', '--disable-dev-shm-usage']});
});
after(() => browser.close());

// Opens a file, hands its page over, once `ready` is there if that is said, and expects that it complained of
// nothing and asked for nothing but itself and what `mayAsk(url)` allows. Other options are the browser's.
export async function openFile(
    file, use, {hash = '', prepare = () => {}, ready = null, mayAsk = () => false, ...options} = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
  const page = await context.newPage(), url = pathToFileURL(join(PAGES, file)).href + hash, wrong = [];
  page.on('console', message => wrong.push(`console: ${message.text()}`));
  page.on('pageerror', error => wrong.push(`error: ${error.message}`));
  page.on('request', request => {
    if (request.url() !== url.replace(/#.*/, '') && !mayAsk(request.url()))
      wrong.push(`request: ${request.url()}`);
  });
  try {
    await prepare(page);
    await page.goto(url);
    if (ready !== null) await page.waitForSelector(ready, {timeout: 60000, state: 'attached'});
    await use(page);
    assert.deepEqual(wrong, []);
  } finally {
    await context.close();  // or a page that failed plays on beside the next ones
  }
}

// The contrast of what is seen with what it stands on, the least of each name: [[name, contrast], ...].
// `kinds`: {selector, paint: 'color' by default, on: the ancestor it stands on, by default the nearest with a
// ground of its own, byPaint: whether each paint has a name of its own}.
export const contrasts = (page, kinds) => page.evaluate(kinds => {
  const parse = colour => colour.match(/[\d.]+/g).map(Number);
  const light = ([r, g, b]) => [r, g, b]
                                   .map(x => x / 255)
                                   .map(x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)
                                   .reduce((sum, x, i) => sum + x * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = node => {
    for (let at = node; at !== null; at = at.parentElement) {
      const colour = parse(getComputedStyle(at).backgroundColor);
      if (colour.length === 3 || colour[3] === 1) return colour;
    }
    return [255, 255, 255];
  };
  const found = new Map();
  for (const {selector, paint = 'color', on = null, byPaint = false} of kinds) {
    for (const node of document.querySelectorAll(selector)) {
      const style = getComputedStyle(node), below = ground(on === null ? node : node.closest(on));
      // Of a mark that is filled as the ground its line is seen, if it has one.
      const open =
          byPaint && ![style[paint], style.stroke].includes('none') && `${parse(style[paint])}` === `${below}`;
      const seen = open || style[paint] === 'none' ? style.stroke : style[paint];
      if (seen === 'none') continue;
      const [a, b] = [light(parse(seen)), light(below)];
      const name = byPaint ? `${selector} ${seen}` : selector;
      const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      found.set(name, Math.min(found.get(name) ?? Infinity, contrast));
    }
  }
  return [...found];
}, kinds);

export async function assertColourScheme(page, colorScheme) {
  const paper =
      await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
  assert.equal(paper[0] < 128, colorScheme === 'dark');
}

// One h1, and no level left out on the way down.
export async function assertHeadings(page) {
  const levels = await page.$$eval('h1, h2, h3, h4', all => all.map(node => Number(node.tagName[1])));
  assert.equal(levels.filter(level => level === 1).length, 1);
  for (const [i, level] of levels.entries()) assert.ok(level <= (levels[i - 1] ?? 0) + 1, levels.join(' '));
}

// A script that was not there when the page was joined does not run.
export async function assertRunsNoOtherScript(file) {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(pathToFileURL(join(PAGES, file)).href);
  const ran = await page.evaluate(() => {
    const script = document.createElement('script');
    script.textContent = 'window.ran = true;';
    document.body.append(script);
    return window.ran === true;
  });
  assert.equal(ran, false);
  await context.close();
}
