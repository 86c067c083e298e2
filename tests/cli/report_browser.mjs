// SPDX-License-Identifier: Apache-2.0
// The pages of a report in a browser; run by report_page_test.py, which writes the reports: `small`, `since`
// (the same beside an earlier one) and `large` (ten thousand findings).
import assert from 'node:assert/strict';
import {existsSync, readFileSync, statSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {assertColourScheme, assertHeadings, assertRunsNoOtherScript, contrasts, openFile} from './page.mjs';

const {PAGES} = process.env;

// Opens a page of a report, once all is drawn; only findings have nothing to draw.
const opened = (name, use, {file = 'index', ...options} = {}) => openFile(
    join(name, `${file}.html`), use,
    {ready: options.javaScriptEnabled === false || file === 'findings' ? null : 'html[data-drawn]', ...options});
const inResults = (name, use, options = {}) => opened(name, use, {file: 'results', ...options});
const inFindings = (name, use, options = {}) => opened(name, use, {file: 'findings', ...options});
const pages = ['index', 'results', 'findings'];

// The rows of a table of the report, by the names of its columns; no cell of these has a line end in it.
function csv(report, file) {
  const cells = line => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(
      match => match[1].replace(/^"|"$/g, '').replaceAll('""', '"'));
  const [head, ...rows] = readFileSync(join(PAGES, report, file), 'utf8').trimEnd().split('\r\n').map(cells);
  return rows.map(row => Object.fromEntries(head.map((name, i) => [name, row[i]])));
}

const count = text => Number(text).toLocaleString('en');
const titles = (page, figure) =>
    page.$$eval(`figure[data-figure="${figure}"] svg title`, all => all.map(node => node.textContent));

const drawn = {
  index: ['often', 'cost', 'doubles'],
  results: [
    'rates.contacts', 'rates.friction', 'rates.rank', 'doubles', 'trust', 'steps', 'pivoting', 'loop-steps', 'methods',
    'driving', 'frontiers'
  ]
};

test('every figure is drawn, has a name, and its numbers beside it', async () => {
  for (const file of ['index', 'results']) await opened('small', async page => {
    const figures = await page.$$eval(
        'figure[data-figure]',
        all => all.map(node => ({
                         name: node.dataset.figure,
                         data: node.querySelector('.source a').getAttribute('href'),
                         command: node.querySelector('.source').textContent,
                         caption: node.querySelector('figcaption').textContent,
                         plots: [...node.querySelectorAll('svg')].map(
                             svg => ({
                               role: svg.getAttribute('role'),
                               label: svg.getAttribute('aria-label') ?? '',
                               marks: [...svg.querySelectorAll('circle, path, rect, line')]
                                          .map(mark => mark.getBoundingClientRect())
                                          .filter(box => box.width + box.height > 2)
                                          .length
                             }))
                       })));
    assert.deepEqual(figures.map(figure => figure.name), drawn[file]);
    for (const figure of figures) {
      assert.ok(figure.plots.length > 0, figure.name);
      assert.ok(figure.caption.length > 20, figure.name);
      assert.ok(existsSync(join(PAGES, 'small', figure.data)), figure.data);
      assert.match(figure.command, /stiction (report|records)/);
      for (const plot of figure.plots) {
        assert.equal(plot.role, 'img');
        assert.ok(plot.label.length > 20, `${figure.name}: ${plot.label}`);
        assert.ok(plot.marks > 2, `${figure.name}: ${plot.marks} marks`);
      }
    }
    assert.doesNotMatch(await page.innerHTML('main'), /NaN|undefined|Infinity/);
  }, {file});
});

test('axes have names, and no tick runs out of its figure', async () => {
  for (const file of ['index', 'results']) {
    for (const width of [390, 820, 1400]) await opened('small', async page => {
      const wrong = await page.$$eval('figure.plot', all => all.flatMap(figure => {
        const room = figure.getBoundingClientRect();
        return [...figure.querySelectorAll('.plot-svg')].flatMap(svg => {
          const said = [...svg.querySelectorAll('[aria-label$="axis label"] text')].map(node => node.textContent);
          const out = [...svg.querySelectorAll('text')].filter(node => {
            const box = node.getBoundingClientRect();
            return box.left < room.left - 1 || box.right > room.right + 1;
          });
          return [
            ...said.length === 2 ? [] : [`${figure.dataset.figure}: axes ${said.join(', ')}`],
            ...out.map(node => `${figure.dataset.figure}: ${node.textContent}`)
          ];
        });
      }));
      assert.deepEqual(wrong, []);
    }, {file, viewport: {width, height: 900}});
  }
});

test('panels fill their rows, and legends stand beside them', async () => {
  await inResults('small', async page => {
    const rows = await page.$$eval('figure.plot .smalls', all => all.map(smalls => {
      const room = smalls.getBoundingClientRect(), ends = new Map();
      for (const small of smalls.children) {
        const box = small.getBoundingClientRect();
        ends.set(box.top, Math.max(ends.get(box.top) ?? 0, box.right));
      }
      return Math.max(...[...ends.values()].map(end => room.right - end));
    }));
    assert.ok(rows.length > 5);
    assert.ok(rows.every(left => left < 6), rows.join(' '));
    for (const [plot, legend] of await page.$$eval('.with-legend', all => all.map(
             node => [...node.children].map(child => child.getBoundingClientRect().toJSON()))))
      assert.ok(legend.left >= plot.right - 1);
  });
});

test('what is drawn are the numbers of the tables', async () => {
  await opened('small', async page => {
    const often = csv('small', 'figures/often.csv').filter(row => row.policy === 'paper'),
          told = await titles(page, 'often');
    assert.equal(told.length, often.length);
    for (const row of often) {
      const text = `μ = ${row.friction}, ${row.contacts} contacts: `;
      assert.ok(told.some(title => title.startsWith(text) && title.includes(` of ${count(row.runs)} runs`)), text);
    }
    const cost = csv('small', 'figures/cost.csv').filter(row => row.policy === 'paper'), steps = await titles(page, 'cost');
    for (const row of cost)
      assert.ok(steps.includes(`${row.contacts} contacts, half of the runs: at most ${row.median} steps; ${
          count(row.runs)} runs`));
  });
  await inResults('small', async page => {
    const rates = csv('small', 'figures/rates.csv')
                      .filter(row => row.policy === 'paper' && row.outcome === 'loop' && row.count !== '0');
    for (const by of ['contacts', 'friction', 'rank']) {
      const drawn = await titles(page, `rates.${by}`), rows = rates.filter(row => row.by === by);
      assert.equal(drawn.length, rows.length, by);
      for (const row of rows) {
        const told = drawn.filter(
            text => text.startsWith(`${row.generator}, ${row.contacts} contact`) &&
                text.includes(` ${row.value}: ${count(row.count)} of ${count(row.runs)} runs, `));
        assert.equal(told.length, 1, `${by}: ${JSON.stringify(row)}`);
      }
    }
    const steps = csv('small', 'figures/steps.csv').filter(row => row.policy === 'paper'),
          told = await titles(page, 'steps');
    assert.equal(told.length, steps.length);
    for (const row of steps)
      assert.ok(told.some(
          text => text.startsWith(
              `${row.steps}${row.or_more === 'yes' ? ' or more' : ''} steps: ${count(row.runs)} runs`)));
    const doubles = csv('small', 'figures/doubles.csv').filter(row => row.policy === 'paper');
    assert.equal((await titles(page, 'doubles')).length, doubles.length);
    for (const text of await titles(page, 'doubles'))
      assert.ok(doubles.some(row => text.endsWith(`exactly ${row.exact}: ${count(row.runs)} runs`)), text);
    const loops = csv('small', 'figures/loop-steps.csv');
    assert.deepEqual(
        (await titles(page, 'loop-steps')).map(text => text.match(/: ([\d,]+) of/)[1]).sort(),
        loops.map(row => count(row.loops)).sort());
  });
});

test('records are drawn beside random problems, each once where nothing was reached', async () => {
  for (const [report, file] of [['small', 'results'], ['measured', 'index']]) {
    await opened(report, async page => {
      const rows = csv(report, 'figures/frontiers.csv'), told = await titles(page, 'frontiers');
      const reached = rows.filter(row => row.random !== '');
      assert.ok(reached.length > 10 && reached.length < rows.length);
      assert.equal(told.length, rows.length + reached.length);
      for (const row of rows) {
        const mine = told.filter(text => text.startsWith(`${row.what}: `));
        assert.equal(mine.length, row.random === '' ? 1 : 2, row.frontier);
        assert.ok(mine[0].endsWith(`of ${count(row.evaluations)}`), mine[0]);
      }
    }, {file});
  }
});

test('a report of benchmarks alone says and draws what was measured', async () => {
  await opened('measured', async page => {
    assert.deepEqual(
        await page.$$eval('figure[data-figure]', all => all.map(node => node.dataset.figure)), ['frontiers', 'rungs']);
    assert.equal((await titles(page, 'rungs')).length, 2);
    assert.doesNotMatch(await page.innerText('body'), /NaN|undefined|random friction problems for inputs|STORE/);
    await assertHeadings(page);
  });
});

test('where a dot stands is its rate', async () => {
  await inResults('small', async page => {
    const rows = csv('small', 'figures/pivoting.csv')
                     .filter(row => row.policy === 'paper' && row.what === 'a step of length zero');
    const generator = rows[0].generator, mine = rows.filter(row => row.generator === generator);
    const heights = await page.$$eval(
        'figure[data-figure=pivoting] .small:first-child svg :is(circle, path)',
        all => all.filter(node => node.querySelector('title')?.textContent.includes('zero')).map(node => {
          const box = node.getBoundingClientRect();
          return (box.top + box.bottom) / 2;
        }));
    assert.equal(heights.length, mine.length);
    const shares = mine.map(row => Number(row.share)), low = shares.indexOf(Math.min(...shares)),
          high = shares.indexOf(Math.max(...shares));
    const scale = (heights[low] - heights[high]) / (shares[high] - shares[low]);
    assert.ok(scale > 0);
    for (const [i, share] of shares.entries())
      assert.ok(
          Math.abs(heights[low] - scale * (share - shares[low]) - heights[i]) < 1.5,
          `${share} at ${heights[i]}`);
  });
});

test('a figure shows another policy when one is chosen, by the keyboard', async () => {
  await inResults('small', async page => {
    const select = page.locator('figure[data-figure=steps] select');
    await select.focus();
    await page.keyboard.press('ArrowDown');
    const chosen = await select.inputValue();
    assert.notEqual(chosen, 'paper');
    const rows = csv('small', 'figures/steps.csv').filter(row => row.policy === chosen);
    assert.equal((await titles(page, 'steps')).length, rows.length);
  });
});

// ---- Findings ----

const ready = page => page.waitForSelector('#findings > .scroll > table:not([aria-busy])');
const signatures = async page => {
  await ready(page);
  return page.$$eval('#findings tr.finding th code', all => all.map(node => node.textContent));
};
const said = async page => {
  await ready(page);
  return page.textContent('#findings .said');
};

test('findings stand in the order of interest, and sort by every column with the keyboard', async () => {
  await inFindings('small', async page => {
    const first = await signatures(page),
          rows = new Map(csv('small', 'findings.csv').map(row => [row.signature, row]));
    assert.ok(first.length > 3);
    const heads = await page.$$('#findings > .scroll > table > thead th');
    assert.equal(heads.length, 10);
    for (const [i, head] of heads.entries()) {
      const button = await head.$('button');
      await button.focus();
      await page.keyboard.press('Enter');
      const up = await head.getAttribute('aria-sort'), one = await signatures(page);
      await page.keyboard.press('Enter');
      assert.notEqual(await head.getAttribute('aria-sort'), up);
      assert.equal(await page.$$eval('#findings [aria-sort]', all => all.length), 1);
      assert.deepEqual([...one].sort(), [...first].sort(), `column ${i} keeps all`);
    }
    await (await heads[5].$('button')).click();
    const met = (await signatures(page)).map(signature => Number(rows.get(signature).count));
    assert.deepEqual(met, [...met].sort((a, b) => b - a));
    await (await heads[0].$('button')).click();
    assert.deepEqual(await signatures(page), [...first].sort());
    await page.click('#findings .order');
    assert.deepEqual(await signatures(page), first);
  });
});

test('findings are filtered by kind, and searched', async () => {
  await inFindings('small', async page => {
    const all = csv('small', 'findings.csv').filter(row => row.state !== 'counted');
    await page.selectOption('#gallery-kind', 'cycle');
    const cycles = all.filter(row => row.kind === 'cycle');
    assert.ok(cycles.length > 0 && cycles.length < all.length);
    assert.match(await said(page), new RegExp(`of ${cycles.length} findings?, of ${all.length} in all`));
    await page.selectOption('#gallery-kind', '');
    const wanted = cycles.at(-1).signature;
    await page.fill('#gallery-search', `CYCLE ${wanted.slice(-12)}`);
    const fitting =
        all.filter(row => row.signature.includes(wanted.slice(-12)) && row.signature.includes('cycle'));
    assert.deepEqual((await signatures(page)).sort(), fitting.map(row => row.signature).sort());
    await page.fill('#gallery-search', 'nothing of the kind');
    assert.match(await said(page), /^None of \d+ findings fits/);
    await page.fill('#gallery-search', '');
    assert.equal((await signatures(page)).length, Math.min(50, all.length));
  });
});

// A finding is filled in a later event of the browser than the one that opens it.
const matrixOf = async (page, signature) => {
  await page.waitForSelector('#findings tr.more details[open] .details', {timeout: 20000});
  return matrixShown(page, signature);
};
const matrixShown = (page, signature) => page.evaluate(signature => {
  const head = [...document.querySelectorAll('#findings tr.finding')].find(
      row => row.querySelector('code').textContent === signature);
  return [...head.nextElementSibling.querySelectorAll('.details tbody tr')].map(
      row => [...row.querySelectorAll('td')].map(cell => cell.textContent));
}, signature);

function assertIsProblem(shown, file) {
  const {A, b} = JSON.parse(readFileSync(file, 'utf8'));
  assert.equal(shown.length, A.length);
  for (const [i, row] of A.entries()) assert.deepEqual(shown[i].slice(0, -1), [...row, b[i]]);
}

test('a finding opens by the keyboard, and shows the problem of its file', async () => {
  await inFindings('small', async page => {
    const [signature] = await signatures(page);
    await page.focus('#findings tr.more summary');
    await page.keyboard.press('Enter');
    const row = csv('small', 'findings.csv').find(row => row.signature === signature);
    assertIsProblem(await matrixOf(page, signature), join(PAGES, 'small', row.problem_file));
    assert.match(
        await page.textContent('#findings tr.more .details pre'), /^stiction replay findings\/.* --step\n/);
    assert.match(await page.textContent('pre.setup'), /^cd '.*\/small'\n/);
  });
});

test('findings that were found with a scene show it', async () => {
  await inFindings('small', async page => {
    const pictures = await page.$$eval(
        'figure.scene svg',
        all => all.map(
            svg =>
                [svg.getAttribute('role'), svg.getAttribute('aria-label'),
                 svg.querySelectorAll('circle, polygon, path').length]));
    assert.ok(pictures.length > 0);
    for (const [role, label, shapes] of pictures) {
      assert.equal(role, 'img');
      assert.match(label, /^Scene of .*touching at \d+ points?$/);
      assert.ok(shapes > 1);
    }
  });
});

test('beside an earlier report, what is new can be told and filtered', async () => {
  await inFindings('since', async page => {
    const changed = csv('since', 'since.csv').filter(row => row.change !== 'gone');
    await page.selectOption('#gallery-change', 'new');
    const fresh = csv('since', 'findings.csv')
                      .filter(
                          row => row.state !== 'counted' &&
                              changed.some(line => line.signature === row.signature && line.change === 'new'));
    assert.ok(fresh.length > 0);
    assert.deepEqual((await signatures(page)).sort(), fresh.map(row => row.signature).sort().slice(0, 50));
    const badges =
        await page.$$eval('#findings tr.finding .badge.change', all => all.map(node => node.textContent));
    assert.deepEqual([...new Set(badges)], ['new']);
  });
});

test('the first page says what is new, and is as light with ten thousand findings', async () => {
  await opened('since', async page => assert.match(await page.textContent('#found'), /Since the earlier report: [\d,]+ new/));
  const size = name => statSync(join(PAGES, name, 'index.html')).size;
  assert.ok(size('large') < 600000 && Math.abs(size('large') - size('small')) < 20000, `${size('large')} bytes`);
  await opened('large', async page => assert.equal(await page.locator('.named li').count(), 6));
});

test('the simplest loop plays in the first page, by buttons and keys', async () => {
  await opened('small', async page => {
    const said = () => page.textContent('#play h4');
    assert.match(await page.textContent('#play .verdict'), /^loops: drives? \d+( to \d+)? recurs?$/);
    const [, last] = (await said()).match(/^Step (\d+) of \1$/);
    await page.click('#play button[aria-label="Forward"]');
    assert.match(await said(), /, round 2 of the loop$/);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await said(), `Step ${last} of ${last}`);
    await page.click('#play .timeline .state >> nth=0');
    assert.equal(await said(), 'Before the first step');
    await page.click('#play button[aria-label="Play"]');
    await page.waitForFunction(() => document.querySelector('#play h4').textContent.startsWith('Step 1 of '));
  });
});

test('findings are named by what happens, and their links play them', async () => {
  const rows = csv('small', 'findings.csv'), seen = [];
  await inFindings('small', async page => {
    for (const [name, href, signature] of await page.$$eval('#findings tr.finding th', all => all.map(
             node => [node.firstChild.textContent, node.firstChild.getAttribute('href'), node.querySelector('code').textContent]))) {
      assert.match(name, /^(One|Two|Three) contacts?, (single digits|.* digits)(, |: )/);
      seen.push({name, href, signature, loops: rows.find(row => row.signature === signature).kind === 'cycle'});
    }
  });
  assert.ok(seen.every(({href}) => href.startsWith('replay.html#step-0;problem=')));
  for (const loops of [true, false]) {
    const {name, href, signature} = seen.filter(each => each.loops === loops).at(-1);
    await openFile(join('small', 'replay.html'), async page => {
      await page.waitForFunction(
          signature => document.getElementById('file').textContent === signature, signature, {timeout: 20000});
      assert.equal((await page.textContent('h1')).split(/[:,]/)[0], name.split(/[:,]/)[0]);
      assert.equal(await page.isVisible('#edited'), false);
      assert.equal(/loops: drives?/.test(await page.textContent('#verdicts')), loops);
    }, {hash: href.replace('replay.html', ''), mayAsk: url => url.startsWith('blob:')});
  }
});

test('ten thousand findings open, in a second where times are asked for, and all are found', async t => {
  const times = [];
  for (let k = 0; k < (process.env.STICTION_TIMES === undefined ? 1 : 3); ++k) {
    await inFindings('large', async page => {
      times.push(await page.evaluate(() => performance.getEntriesByType('navigation')[0].loadEventEnd));
      assert.match(await said(page), /^1 to 50 of 10,\d\d\d findings$/);
      const rows = csv('large', 'findings.csv'), last = rows.filter(row => row.state !== 'counted').at(-1);
      await page.fill('#gallery-search', last.signature);
      assert.ok((await signatures(page)).includes(last.signature));
      await page.click('#findings tr.more summary');
      assertIsProblem(
          await matrixOf(page, (await signatures(page))[0]), join(PAGES, 'large', last.problem_file));
      await page.fill('#gallery-search', '');
      await page.click('#findings .pager button:nth-child(2)');
      assert.match(await said(page), /^51 to 100 of 10,/);
    });
  }
  const taken = `opened in ${times.map(Math.round).join(', ')} ms`;
  t.diagnostic(taken);
  if (process.env.STICTION_TIMES !== undefined) assert.ok(times.sort((a, b) => a - b)[1] < 1000, taken);
});

// ---- For everybody ----

test('the first key leads past the header, and every control has a name and is reached', async () => {
  for (const file of pages) await opened('small', async page => {
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
    await page.keyboard.press('Enter');
    assert.equal(await page.evaluate(() => location.hash), file === 'findings' ? '#findings' : '#found');
    const unreachable = await page.$$eval(
        'main a[href], main button:not(.state), main select, main input, main summary, [tabindex]:not(.state)',
        all => all.filter(node => node.tabIndex < 0).map(node => node.outerHTML.slice(0, 80)));
    assert.deepEqual(unreachable, []);
    const bare = await page.$$eval(
        'button, input, select, svg[role=img], [role=region], nav',
        all => all.filter(
                      node =>
                          !(node.getAttribute('aria-label') ||
                            node.textContent.trim() && node.tagName === 'BUTTON' || node.labels?.length > 0))
                   .map(node => node.outerHTML.slice(0, 80)));
    assert.deepEqual(bare, []);
    await assertHeadings(page);
    assert.ok(await page.$$eval('main section', all => all.every(node => node.querySelector('h2') !== null)));
  }, {file});
});

test('the first page has at most six screens of a desktop', async () => {
  await opened('small', async page => {
    const height = await page.evaluate(() => document.documentElement.scrollHeight);
    assert.ok(height > 2 * 900 && height <= 6 * 900, `${height} pixels`);
  }, {viewport: {width: 1400, height: 900}});
});

test('at every width nothing is cut off, and what scrolls says so', async () => {
  for (const file of pages) {
    for (const width of [390, 820, 1400]) await opened('small', async page => {
      const wrong = await page.evaluate(() => {
        const shown = node => node.checkVisibility(), found = [];
        if (document.documentElement.scrollWidth > innerWidth) found.push(`${document.documentElement.scrollWidth} pixels wide`);
        for (const node of document.querySelectorAll('body *')) {
          if (!shown(node) || node.closest('svg, math, .away, caption, .skip, .scroll, select')) continue;
          const box = node.getBoundingClientRect();
          if (box.right > innerWidth + 1 || box.left < -1 || node.scrollWidth > node.clientWidth + 2 && node.clientWidth > 0)
            found.push(`${node.tagName} ${node.className} ${node.textContent.slice(0, 40)}`);
        }
        for (const box of document.querySelectorAll('.scroll')) {
          const says = box.previousElementSibling?.matches('.scrolls:not([hidden])') ?? false;
          if (shown(box) && says !== box.scrollWidth > box.clientWidth + 1) found.push(`scroll ${box.ariaLabel}`);
        }
        return found;
      });
      assert.deepEqual(wrong, [], `${file}, ${width}`);
    }, {file, viewport: {width, height: 900}});
  }
});

const texts = [
  'h1',        'h2',        'h3',         'p',           '.kicker',       '.note',
  '.source',   '.source a', 'figcaption', '.claim',
  '.verdict',  '.event',    '.named a',   '.places a',     '.scrolls',     '.group', '.cones span',
  'th button', 'td.zero',   'td small',   '.badge.loop', '.badge.whole',  '.said',
  'dt',        'dd',        'summary',    '.legend li',  '.title',        'td.h1',
  'td.h2',     'td.h3',     'td.h4',      'td.h5',       '.choice',       'pre code'
];

test('light and dark have contrast: texts, and what is drawn', async () => {
  const least = {index: 20, results: 15, findings: 8};
  for (const [colorScheme, file] of ['light', 'dark'].flatMap(scheme => pages.map(each => [scheme, each]))) {
    await opened('small', async page => {
      await assertColourScheme(page, colorScheme);
      const read = await contrasts(
          page,
          [
            ...texts.map(selector => ({selector: `${selector}:not(.empty)`})),
            {selector: '.plot-svg text', paint: 'fill', on: 'figure'}
          ]);
      const drawn = await contrasts(page, [{
                                      selector: '.plot-svg circle, .plot-svg [aria-label=dot] path',
                                      paint: 'fill',
                                      on: 'figure',
                                      byPaint: true
                                    }]);
      assert.ok(read.length > least[file] && (drawn.length > 2 || file === 'findings'), `${read.length}, ${drawn.length}`);
      for (const [text, contrast] of read)
        assert.ok(contrast >= 4.5, `${colorScheme}: ${text} has a contrast of ${contrast}`);
      for (const [mark, contrast] of drawn)
        assert.ok(contrast >= 3, `${colorScheme}: ${mark} has a contrast of ${contrast}`);
    }, {colorScheme, file});
  }
});

test('on a phone nothing is cut off, and plots are redrawn for its width', async () => {
  await inResults('small', async page => {
    const room = () => page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
    assert.deepEqual(await room(), [360, 360]);
    const wide = () => page.$$eval(
        'figure.plot',
        all => all.filter(
                      node => [...node.querySelectorAll('svg')].some(
                          svg => svg.getBoundingClientRect().right > node.getBoundingClientRect().right + 1))
                   .map(node => node.dataset.figure));
    assert.deepEqual(await wide(), []);
    const before = await page.$eval('figure[data-figure=steps] svg', svg => svg.getBoundingClientRect().width);
    await page.setViewportSize({width: 640, height: 900});
    await page.waitForFunction(
        before =>
            document.querySelector('figure[data-figure=steps] svg').getBoundingClientRect().width !== before,
        before, {timeout: 20000});
    assert.deepEqual(await room(), [640, 640]);
    assert.deepEqual(await wide(), []);
  }, {viewport: {width: 360, height: 740}, deviceScaleFactor: 2, isMobile: true, hasTouch: true});
});

test('A f + b = a of two contacts and numbers of two digits fits a phone', async () => {
  await opened('small', async page => {
    const over = [];
    let seen = 0;
    for (let k = 0; k < await page.locator('.timeline .state').count(); ++k) {
      await page.$$eval('.timeline .state', (states, k) => states[k].click(), k);
      const [wide, room, digits] = await page.$eval('.algebra', box => [
        box.scrollWidth, box.clientWidth,
        Math.max(...[...box.querySelectorAll('mn')].map(node => node.textContent.length))
      ]);
      if (digits > 2) continue;
      ++seen;
      if (wide > room) over.push([k, wide, room]);
    }
    assert.ok(seen > 0);
    assert.deepEqual(over, []);
  }, {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true});
});

test('printed, it is light, in pages, with its figures and without controls', async () => {
  await opened('small', async page => {
    const pdf = (await page.pdf({preferCSSPageSize: true, printBackground: true})).toString('latin1');
    const sheets = pdf.match(/\/Type\s*\/Page\b(?!s)/g).length;
    assert.ok(sheets >= 3 && sheets <= 8, `${sheets} pages`);
    await page.emulateMedia({media: 'print', colorScheme: 'dark'});
    assert.deepEqual(
        await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
    for (const text of ['nav', 'select', '#play button[aria-label=Play]'])
      assert.ok(!await page.isVisible(text), text);
    for (const text of ['.claim', 'figure[data-figure=often] svg', '#play .cones', '#table table', '.references'])
      assert.ok(await page.isVisible(text), text);
  }, {colorScheme: 'dark'});
});

test('without a script all texts and tables stand there', async () => {
  await opened('small', async page => {
    assert.ok(await page.isVisible('.claim'));
    assert.ok(await page.isVisible('noscript, noscript p'));
    assert.ok(await page.isVisible('#table table'));
    assert.ok(await page.isVisible('figure[data-figure=cost] .source a'));
  }, {javaScriptEnabled: false});
  await inFindings('small', async page => {
    const all = csv('small', 'findings.csv').filter(row => row.state !== 'counted');
    assert.equal(await page.locator('#findings tr.finding').count(), Math.min(50, all.length));
  }, {javaScriptEnabled: false});
});

test('indices stand below their letter, in what a link unfolds', async () => {
  await opened('small', async page => {
    await page.click('nav a[href="#method"]');
    await page.waitForSelector('#method details[open]');
    const [letter, index] = await page.$eval(
        '#method msub', node => [...node.children].map(child => child.getBoundingClientRect().bottom));
    assert.ok(index > letter + 1, `${index}, ${letter}`);
  });
});

test('no script but its own runs', () => assertRunsNoOtherScript(join('small', 'index.html')));
