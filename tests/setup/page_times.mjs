// SPDX-License-Identifier: Apache-2.0
// How long pages take to open in a browser: node page_times.mjs REPEATS FILE.html... prints JSON, of each file and each
// repetition the milliseconds to the end of the load event, and those of the processor that the thread of the page took,
// of which other programs take nothing. The browser is chromium or that of BROWSER.
import {execFileSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const {chromium} = createRequire(join(root, 'reports/web/package.json'))('playwright-core');
const [repeats, ...files] = process.argv.slice(2);
const browserPath = process.env.BROWSER ?? execFileSync('which', ['chromium'], {encoding: 'utf8'}).trim();

const browser = await chromium.launch({executablePath: browserPath, args: ['--no-sandbox']});
const times = Object.fromEntries(files.map(file => [file, []]));
for (let k = 0; k < Number(repeats); ++k) {
  for (const file of files) {  // by turns
    const page = await browser.newPage({viewport: {width: 1400, height: 900}});
    const session = await page.context().newCDPSession(page);
    await session.send('Performance.enable', {timeDomain: 'threadTicks'});
    await page.goto(pathToFileURL(resolve(file)).href);
    const opened = await page.evaluate(() => performance.getEntriesByType('navigation')[0].loadEventEnd);
    const {metrics} = await session.send('Performance.getMetrics');
    times[file].push([opened, 1000 * metrics.find(({name}) => name === 'TaskDuration').value]);
    await page.close();
  }
}
await browser.close();
console.log(JSON.stringify(times));
