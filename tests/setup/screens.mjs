// SPDX-License-Identifier: Apache-2.0
// Takes pictures of pages, to be looked at: each at 390, 820 and 1,400 pixels, light and dark, and on paper.
//
//     node tests/setup/screens.mjs FOLDER FILE.html[#ADDRESS]...
//
// Wants reports/web/node_modules (npm ci there) and a browser, chromium or that of BROWSER. A picture is
// FOLDER/NAME-WIDTH-SCHEME.png; what is longer than a few screens is cut into several.
import {execFileSync} from 'node:child_process';
import {mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {basename, dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const {chromium} = createRequire(join(root, 'reports/web/package.json'))('playwright-core');
const [folder, ...files] = process.argv.slice(2);
const browserPath = process.env.BROWSER ?? execFileSync('which', ['chromium'], {encoding: 'utf8'}).trim();
const longest = 2000;
const sizes = (process.env.WIDTHS ?? '390,820,1400').split(',').map(Number);
const schemes = (process.env.SCHEMES ?? 'light,dark').split(',');

mkdirSync(folder, {recursive: true});
const browser = await chromium.launch({executablePath: browserPath, args: ['--no-sandbox']});
for (const file of files) {
  const [path, address = ''] = file.split('#');
  const name = `${basename(dirname(resolve(path)))}-${basename(path, '.html')}`;
  for (const width of sizes) {
    for (const colorScheme of schemes) {
      const page = await browser.newPage({viewport: {width, height: 900}, colorScheme});
      page.on('pageerror', error => console.log(`${name}: ${error.message}`));
      await page.goto(pathToFileURL(resolve(path)).href + (address && `#${address}`));
      await page.waitForTimeout(800);
      const [height, reach] = await page.evaluate(
          () => [document.documentElement.scrollHeight, document.documentElement.scrollWidth]);
      if (reach > width) console.log(`${name}: ${reach} pixels wide at ${width}`);
      for (let top = 0, part = 1; top < height; top += longest, ++part) {
        await page.screenshot({
          path: join(folder, `${name}-${width}-${colorScheme}-${part}.png`),
          fullPage: true,
          clip: {x: 0, y: top, width, height: Math.min(longest, height - top)}
        });
      }
      await page.close();
    }
  }
}
await browser.close();
