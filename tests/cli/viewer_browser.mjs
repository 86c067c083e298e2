// SPDX-License-Identifier: Apache-2.0
// The replay viewer in a browser; run by viewer_test.py, which writes the pages. NAME.json beside NAME.html is
// what `stiction replay --step --json` says of the same run.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {assertColourScheme, assertHeadings, assertRunsNoOtherScript, contrasts, openFile} from './page.mjs';

const {PAGES, PROGRAM} = process.env;
const names = [
  'loop', 'scene', 'policy', 'space', 'sliding', 'frictionless', 'lemke', 'complete', 'scene-in-space',
  'at-rest'
];
// All pages, or one in three, where not all is tested.
const some = process.env.STICTION_TESTS === 'all' ? names : names.filter((_, i) => i % 3 === 0);
const replayOf = name => JSON.parse(readFileSync(join(PAGES, `${name}.json`), 'utf8'));

// Runs again in a worker, which is a blob.
const opened = (name, use, options = {}) =>
    openFile(`${name}.html`, use, {mayAsk: url => url.startsWith('blob:'), ...options});

const heading = (page, run = 0) => page.textContent(`section.run-${run} h3`);
// A link or a finger moves the page in a later event of the browser.
const becomes = (page, text, run = 0) => page.waitForFunction(
    ([text, run]) => document.querySelector(`section.run-${run} h3`).textContent === text, [text, run],
    {timeout: 20000});
// page.url() hears of a new one later.
const hashOf = page => page.evaluate(() => location.hash);
const press = async (page, ...keys) => {
  for (const key of keys) await page.keyboard.press(key);
};

// The numbers of a column of the table of a run: what a program reads, and what a person sees.
const column = (page, run, style) =>
    page.$$eval(`section.run-${run} .values td.${style} data`, cells => cells.map(cell => {
      const sign = cell.querySelector('mo') === null ? '' : '-';
      const digits = [...cell.querySelectorAll('mn')].map(mn => mn.textContent).join('/');
      const exact = cell.querySelector('.exact')?.textContent ?? null;
      if (exact !== cell.title && (exact ?? '') !== cell.title) throw new Error(`${exact}, ${cell.title}`);
      return {
        value: cell.value,
        seen: (digits === '' ? cell.firstChild.textContent : sign + digits).replaceAll('−', '-'),
        exact: exact?.replaceAll('−', '-') ?? null,
      };
    }));

// Exact numbers beyond the range of doubles' digits are near enough as quotients.
const near = text => text.split('/').map(Number).reduce((p, q) => p / q);

async function assertShows(page, run, style, expected) {
  const found = await column(page, run, style);
  assert.deepEqual(found.map(x => x.value), expected.map(String));
  for (const [i, x] of expected.entries()) {
    if (found[i].exact === null && typeof x === 'string') {
      assert.equal(found[i].seen, x);
      continue;
    }
    const value = near(String(x));
    assert.ok(Math.abs(Number(found[i].seen) - value) <= 5e-4 * Math.abs(value), `${found[i].seen}, expected ${x}`);
    if (found[i].exact !== null) assert.equal(found[i].exact, String(x));
  }
}

test('every page opens from disk, and draws', async () => {
  for (const name of names) {
    await opened(name, async page => {
      await press(page, 'End');
      const shapes = await page.$$eval(
          '#cones svg polygon, #cones svg circle, #picture svg polygon, #picture svg line',
          all =>
              all.map(shape => shape.getBoundingClientRect()).filter(box => box.width + box.height > 2).length);
      assert.ok(shapes >= 2, `${name}: ${shapes} shapes`);
      assert.equal(await page.isVisible('#picture'), name.startsWith('scene'));
      assert.doesNotMatch(await page.innerHTML('main'), /NaN|undefined|Infinity/);
    });
  }
});

test('every state shows the numbers of --json, to the byte', async () => {
  for (const name of some) {
    const replay = replayOf(name), pivots = replay.pivots;
    await opened(name, async page => {
      await assertShows(page, 0, 'force', replay.initial.f);
      await assertShows(page, 0, 'acceleration', replay.initial.a);
      for (const pivot of pivots) {
        await press(page, 'ArrowRight');
        await assertShows(page, 0, 'force', pivot.f);
        await assertShows(page, 0, 'acceleration', pivot.a);
        if (pivot.df !== undefined) await assertShows(page, 0, 'df', pivot.df);
        assert.equal(await page.getAttribute('section.run-0 .event data', 'value'), String(pivot.step));
      }
      const last = pivots.length, end = await heading(page), stands = pivots.at(-1) ?? replay.initial;
      assert.match(
          end, last === 0 ? /^Before the first step$/ : new RegExp(`^(Step|Piece) ${last} of ${last}$`));
      const vector = style => page.$$eval(`#equation .${style} data`, cells => cells.map(cell => cell.value));
      assert.deepEqual(await vector('force'), stands.f.map(String));
      assert.deepEqual(await vector('acceleration'), stands.a.map(String));
    });
  }
});

test('a page is named by what happens, and a loop by its drives', async () => {
  const said = {
    'loop': ['Two contacts, single digits, under every policy', /: loops: drives 3 to 7 recur, for ever$/],
    'scene': [/^Two contacts, .*, as published$/, /: loops: drives \d+ to \d+ recur, for ever$/],
    'space': [/^\w+ contacts in space, /, /: cycle: /],
    'at-rest': [/: solved$/, /: solved/],
  };
  for (const [name, [title, verdict]] of Object.entries(said)) {
    await opened(name, async page => {
      assert.match(await page.textContent('h1'), title instanceof RegExp ? title : new RegExp(`^${title}$`));
      assert.match(await page.textContent('#verdicts .run-0'), verdict);
    });
  }
});

test('numbers have four digits, and all of them by a key', async () => {
  await opened('scene', async page => {
    await press(page, 'End');
    const seen = () => page.$eval('#equation data:has(.exact)', data => data.innerText.replaceAll('−', '-'));
    assert.ok((await seen()).replace(/[-.]/g, '').length <= 4 + 1, await seen());
    await press(page, 'e');
    assert.match(await seen(), /^-?\d+\/\d+$/);
    await press(page, 'e');
    assert.ok((await seen()).includes('.') || (await seen()).length <= 5);
  });
});

test('arrows and cones have newtons, and a scene its gravity', async () => {
  await opened('scene', async page => {
    const marks = await page.$$eval('#cones svg:first-child text', all => all.map(text => text.textContent));
    assert.ok(marks.includes('fN, N') && marks.includes('fF, N'));
    assert.ok(marks.filter(text => Number(text) > 0).length >= 2, marks.join(' '));
    const scale = await page.$$eval('#picture text.scale', all => all.map(text => text.textContent));
    assert.match(scale.join('|'), /^[\d.]+ N\|g$/);
    assert.equal(await page.locator('#picture text.contact').count(), 2);
  });
});

test('A of more than eight rows is folded', async () => {
  for (const [name, folded] of [['loop', 0], ['frictionless', 0], ['large', 1]])
    await opened(name, async page => {
      const rows = await page.evaluate(() => JSON.parse(document.getElementById('data').textContent).rows.length);
      assert.equal(rows > 8, folded === 1, `${name}: ${rows} rows`);
      assert.equal(await page.locator('#algebra > details:not([open])').count(), folded);
    });
});

test('the link is copied', async () => {
  await opened('loop', async page => {
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await page.click('a.link');
    await page.waitForFunction(() => document.querySelector('a.link').textContent !== 'Copy link');
    assert.equal(await page.textContent('a.link'), 'Copied');
    assert.match(await page.evaluate(() => navigator.clipboard.readText()), /loop\.html#step-5$/);
    assert.equal(await heading(page), 'Step 5 of 16');
  }, {hash: '#step-5'});
});

test('the keys alone go round the loop, and back', async () => {
  const replay = replayOf('loop'), last = replay.pivots.length;
  await opened('loop', async page => {
    assert.equal(await heading(page), 'Before the first step');
    await press(page, 'ArrowLeft');
    assert.equal(await heading(page), 'Before the first step');
    await press(page, 'End');
    assert.equal(await heading(page), `Step ${last} of ${last}`);
    assert.match(await page.textContent('section.run-0 p.recurs'), /recurs, \d+ steps later/);
    await press(page, 'ArrowRight');
    assert.equal(await heading(page), `Step 3 of ${last}, round 2 of the loop`);
    await assertShows(page, 0, 'force', replay.pivots[2].f);
    for (let k = 0; k < last - 3 + 1; ++k) await press(page, 'ArrowRight');
    assert.equal(await heading(page), `Step 3 of ${last}, round 3 of the loop`);
    for (let k = 0; k < 2 * (last - 2) + 1; ++k) await press(page, 'ArrowLeft');
    assert.equal(await heading(page), `Step 2 of ${last}`);
    assert.match(await page.textContent('section.run-0 p.recurs'), /This state recurs after step 16/);
    await press(page, 'Home');
    assert.equal(await heading(page), 'Before the first step');
    await press(page, 'Tab');  // to what may not go back: First and Back are switched off
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Play');
    await press(page, 'Tab', 'Enter');
    assert.equal(await heading(page), `Step 1 of ${last}`);
  });
});

test('space plays and pauses', async () => {
  await opened('loop', async page => {
    await press(page, ' ');
    await page.waitForFunction(
        () => /^Step ([2-9]|1\d)/.test(document.querySelector('section.run-0 h3').textContent), null,
        {timeout: 20000});
    await press(page, ' ');
    const stands = await heading(page);
    await page.waitForTimeout(1500);
    assert.equal(await heading(page), stands);
  });
});

test('a step has an address', async () => {
  await opened('loop', async page => {
    assert.equal(await heading(page), 'Step 5 of 16');
    assert.equal(await page.getAttribute('a.link', 'href'), '#step-5');
    await press(page, 'ArrowRight');
    assert.equal(await hashOf(page), '#step-6');
    await page.click('section.run-0 .timeline button[aria-label^="step 16"]');
    assert.equal(await hashOf(page), '#step-16');
    await page.click('section.run-0 p.recurs a');
    await becomes(page, 'Step 2 of 16');
    assert.equal(await hashOf(page), '#step-2');
    await page.evaluate(() => {
      location.hash = '#step-7,1';
    });
    await becomes(page, 'Piece 1 of 5', 1);
    assert.equal(await heading(page), 'Step 7 of 16');
  }, {hash: '#step-5'});
  for (const hash of ['#step-', '#step-1,2,3', '#<script>', '#step--1'])
    await opened('loop', async page => assert.equal(await heading(page), 'Before the first step'), {hash});
  await opened(
      'complete', async page => assert.equal(await heading(page), 'Piece 5 of 5'), {hash: '#step-999'});
});

test('complete driving turns back where the published algorithm gives up', async () => {
  await opened('loop', async page => {
    assert.equal(await page.locator('section.run-0 .event.given-up').count(), 1);
    assert.equal(await page.locator('section.run-1 .event.fold').count(), 1);
    assert.deepEqual(await column(page, 0, 'force'), await column(page, 1, 'force'));
    await page.click('section.run-1 button[aria-label$="forward"]');
    assert.equal(await heading(page, 1), 'Piece 5 of 5');
    assert.equal(await heading(page), 'Step 5 of 16');
    assert.equal(await hashOf(page), '#step-5,5');
  }, {hash: '#step-5'});
});

test('what recurs is marked where it first stands and where it returns', async () => {
  await opened('loop', async page => {
    const marked = await page.$$eval(
        'section.run-0 .timeline .recurs', all => all.map(button => button.getAttribute('aria-label')));
    assert.equal(marked.length, 2);
    assert.match(marked[0], /^step 2, .*the state that recurs$/);
    assert.match(marked[1], /^step 16, .*the state of step 2 again$/);
  });
});

test('where the policy decides, the page says so', async () => {
  await opened('loop', async page => {
    const text = await page.textContent('section.run-0 .readings');
    assert.match(text, /give-up: when a variable that wants back/);
    assert.match(text, /The paper: 5\.5/);
    assert.match(text, /first.*\(here\)/);
    for (const given of await page.$$('section.run-0 .timeline .given-up')) {
      await given.click();
      assert.match(
          await page.textContent('section.run-0 .reading'), /^Reading give-up=first \(.*: if the present step/);
    }
  }, {hash: '#step-5'});
});

test('a narrow window does not scroll sideways, and a finger steps', async () => {
  const phone = {viewport: {width: 360, height: 740}, isMobile: true, hasTouch: true};
  for (const name of some) {
    await opened(name, async page => {
      for (const key of ['Home', 'ArrowRight', 'End']) {
        await press(page, key);
        assert.ok(
            await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name}, ${key}`);
      }
      assert.ok(await page.isVisible('#player'));
    }, phone);
  }
  await opened('loop', async page => {
    const touch = await page.context().newCDPSession(page);
    const finger = (type, x) =>
        touch.send('Input.dispatchTouchEvent', {type, touchPoints: x === null ? [] : [{x, y: 20}]});
    await page.locator('section.run-0 h3').scrollIntoViewIfNeeded();
    await page.evaluate(() => document.querySelector('section.run-0 h3').scrollIntoView());
    await page.evaluate(() => scrollBy(0, -5));
    await finger('touchStart', 250);
    await finger('touchMove', 150);
    await finger('touchEnd', null);
    await becomes(page, 'Step 1 of 16');
  }, phone);
});

const texts = [
  'h1',
  'h2',
  'h3',
  '.note',
  '.event',
  '.why',
  '.end',
  '.values th',
  '.values .n:not(.nothing)',
  '.group',
  '.place',
  'figcaption',
  '.readings p',
  '.readings em',
  '.key',
  'dd',
  'a',
  '.matrix td',
  '.matrix.force td',
  '#edit summary',
  '#edit legend',
  '#edit th',
  '#edit input',
  '#edit [type=submit]',
  '#edited'
];

test('light and dark have contrast', async () => {
  for (const colorScheme of ['light', 'dark']) {
    await opened('loop', async page => {
      await assertColourScheme(page, colorScheme);
      const read = await contrasts(page, texts.map(selector => ({selector})));
      assert.deepEqual(read.map(([text]) => text), texts);
      for (const [text, contrast] of read)
        assert.ok(contrast >= 4.5, `${colorScheme}: ${text} has a contrast of ${contrast}`);
    }, {hash: '#step-5', colorScheme});
  }
});

test('printed, it is a few pages without buttons', async () => {
  for (const name of ['loop', 'scene']) {
    await opened(name, async page => {
      const pdf = (await page.pdf({
                    format: 'A4',
                    printBackground: true,
                    margin: {top: '12mm', bottom: '12mm', left: '12mm', right: '12mm'}
                  })).toString('latin1');
      const pages = pdf.match(/\/Type\s*\/Page\b(?!s)/g).length;
      assert.ok(pages >= 1 && pages <= 3, `${name}: ${pages} pages`);
      await page.emulateMedia({media: 'print'});
      assert.ok(!await page.isVisible('#player'));
      assert.ok(await page.isVisible('section.run-0 .values'));
    }, {hash: '#step-5'});
  }
});

test('everything that can be pressed or seen has a name', async () => {
  for (const name of ['loop', 'scene', 'space']) {
    await opened(name, async page => {
      const bare = await page.$$eval(
          'button, input, svg[role=img], [role=group], nav, section.run',
          all => all.filter(node => !node.getAttribute('aria-label')).map(node => node.outerHTML.slice(0, 80)));
      assert.deepEqual(bare, []);
      await assertHeadings(page);
      await press(page, 'ArrowRight');
      assert.match(await page.textContent('#said'), /^Step 1: ./);
    });
  }
});

// ---- Editing, and running again -----------------------------------------------------------------

const field = key => `#edit [data-key="${key}"]`;
const openEditor = async page => {
  await page.click('#edit summary');
  await page.waitForSelector('#edit .policy select');
};
const runAgain = async page => {
  await page.click('#edit button[type=submit]');
  await page.waitForFunction(
      () => !document.querySelector('#edit button[type=submit]').disabled, null, {timeout: 60000});
};
const told = page => page.textContent('#edit .told');

async function downloaded(page) {
  const [download] = await Promise.all(
      [page.waitForEvent('download'), page.click('#edit button[aria-label="Download the problem"]')]);
  return {name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8')};
}

// What the program says of a problem, under the budgets of a page.
function replay(problem, ...words) {
  const budgets = ['--max-drives', '300', '--max-pivots', '1000', '--max-bits', '2000'];
  try {
    return JSON.parse(execFileSync(
        PROGRAM, ['replay', '-', '--step', '--json', ...budgets, ...words],
        {input: problem, encoding: 'utf8'}));
  } catch (error) {
    return JSON.parse(error.stdout);  // exit 1: it is not solved
  }
}

// Every state of both runs, as `replay --step --json` has them.
async function assertRunsLikeTheProgram(page, policy) {
  const {text} = await downloaded(page);
  const runs = [replay(text, '--policy', policy), replay(text, '--method', 'complete')];
  for (const [i, {initial, pivots, outcome}] of runs.entries()) {
    const said = await page.textContent(`#verdicts .run-${i}`);
    assert.ok(said.includes(`: ${outcome}`) || outcome === 'cycle' && /: loops: drives? .* recurs?, for ever$/.test(said), said);
    for (let state = 0; state <= pivots.length; ++state) {
      const stands = state === 0 ? initial : pivots[state - 1];
      if (i === 0)
        await press(page, state === 0 ? 'Home' : 'ArrowRight');
      else
        await page.click(`section.run-1 .timeline li .state >> nth=${state}`);
      await assertShows(page, i, 'force', stands.f);
      await assertShows(page, i, 'acceleration', stands.a);
      if (state > 0) await assertShows(page, i, 'df', stands.df);
    }
  }
  return runs;
}
const leaveFields = page => page.evaluate(() => document.activeElement.blur());

// Fills fields, chooses the readings of a policy, and runs.
async function runEdited(page, changes, policy) {
  for (const [key, text] of changes) await page.fill(field(key), text);
  for (const word of policy === 'paper' ? [] : policy.split(',')) {
    const [name, value] = word.split('=');
    await page.selectOption(field(`policy ${name}`), value);
  }
  await runAgain(page);
  await leaveFields(page);
  assert.equal(await page.isVisible('#edited'), true);
}

test('an edited problem runs in the page as in the program, to the byte', async () => {
  const edits = [
    {changes: [], policy: 'paper', outcome: 'cycle'},
    {changes: [['A 0 1', '-7/2']], policy: 'paper', outcome: 'solved'},
    {changes: [['b 0', '-1.25'], ['mu 1', '0.9'], ['A 3 2', ' \u22126 ']], policy: 'paper'},
    {changes: [['b 3', '-2e0']], policy: 'scan=highest,ties=contacts', outcome: 'cycle'},
  ];
  for (const {changes, policy, outcome} of edits) {
    await opened('loop', async page => {
      await openEditor(page);
      await runEdited(page, changes, policy);
      const [first] = await assertRunsLikeTheProgram(page, policy);
      if (outcome !== undefined) assert.equal(first.outcome, outcome);
      assert.equal(await page.textContent('section.run-0 h2'), `The published algorithm, policy ${policy}`);
    });
  }
});

test('kinds of contacts are edited, and contacts come and go', async () => {
  await opened('loop', async page => {
    await openEditor(page);
    await page.selectOption(field('kind 1'), 'frictionless');
    assert.equal(await page.locator('#edit .entries tbody tr').count(), 3);
    await page.click('#edit button[aria-label="Add a contact"]');
    assert.equal(await page.locator('#edit .entries tbody tr').count(), 5);
    await page.fill(field('b 3'), '-1/3');
    await page.fill(field('A 4 0'), '1/7');
    assert.equal(await page.inputValue(field('A 0 4')), '1/7');
    await page.selectOption(field('kind 2'), 'sliding');
    await page.selectOption(field('slip 2'), '-1');
    await runAgain(page);
    await leaveFields(page);
    await assertRunsLikeTheProgram(page, 'paper');
    await page.click('#edit [aria-label="Remove contact 1"]');
    await page.selectOption(field('kind 0'), 'bilateral');
    await runAgain(page);
    await leaveFields(page);
    await assertRunsLikeTheProgram(page, 'paper');
  });
});

test('what is wrong is said of its field, and the page stays as it is', async () => {
  const wrong = [
    ['A 1 2', 'x', /^A, row F1, column N2: found "x", expected a number/],
    ['b 3', '', /^b, row F2: found "", expected a number/],
    ['b 0', '1/0', /^b, row N1: found "1\/0", expected .*denominator not zero/],
    ['mu 1', '-1', /^contact 2, mu: found "-1", expected mu >= 0/],
    ['mu 0', '1e99999', /^contact 1, mu: found "1e99999", expected .*exponent within 10000/],
  ];
  await opened('loop', async page => {
    await openEditor(page);
    const verdicts = await page.textContent('#verdicts');
    for (const [key, text, says] of wrong) {
      const before = await page.inputValue(field(key));
      await page.fill(field(key), text);
      await runAgain(page);
      assert.match(await told(page), says);
      assert.equal(await page.evaluate(() => document.activeElement.dataset.key), key);
      assert.equal(await page.getAttribute(field(key), 'aria-invalid'), 'true');
      await page.fill(field(key), before);
    }
    assert.equal(await page.textContent('#verdicts'), verdicts);
    await runAgain(page);
    assert.equal(await page.locator('[aria-invalid]').count(), 0);
    assert.match(await told(page), /^The published algorithm, policy paper: cycle: /);
  });
});

test('an edited problem has an address, a file, and a way back', async () => {
  let hash = '';
  await opened('loop', async page => {
    await openEditor(page);
    await page.fill(field('A 0 1'), '-3.9');
    await runAgain(page);
    await leaveFields(page);
    await press(page, 'ArrowRight');
    hash = await hashOf(page);
    assert.match(hash, /^#step-1;problem=[\w-]+$/);
    const {name, text} = await downloaded(page);
    assert.equal(name, 'cycle-every-policy-mu-1-edited.json');
    assert.equal(JSON.parse(text).A[1][0], '-3.9');
    await page.click('#edit button[aria-label="Back to the original"]');
    assert.equal(await page.textContent('#file'), 'cycle-every-policy-mu-1');
    assert.equal(await page.isVisible('#edited'), false);
    assert.equal(await page.inputValue(field('A 0 1')), '-4');
    assert.equal(await hashOf(page), '#step-0');
    await assertShows(page, 0, 'force', replayOf('loop').initial.f);
  });
  await opened('loop', async page => {
    await page.waitForFunction(
        () => document.querySelector('#file').textContent === 'cycle-every-policy-mu-1-edited', null,
        {timeout: 20000});
    await becomes(page, `Step 1 of ${replay(JSON.stringify(edited())).pivots.length}`);
    assert.equal(await page.inputValue(field('A 1 0')), '-3.9');
    await page.evaluate(() => {
      location.hash = '#step-5';
    });
    await becomes(page, 'Step 5 of 16');
    assert.equal(await page.textContent('#file'), 'cycle-every-policy-mu-1');
  }, {hash});
  const letters = value => Buffer.from(JSON.stringify(value)).toString('base64url');
  const {contacts, A, b} = edited();
  for (const bad
           of ['x', letters({contacts, A, b}), letters({contacts, A: [A[0]], b, policy: 'paper'}),
               letters(null)])
    await opened(
        'loop', async page => assert.equal(await heading(page), 'Step 2 of 16'),
        {hash: `#step-2;problem=${bad}`});
  await opened('loop', async page => {
    await page.waitForFunction(
        () => document.querySelector('#edit .told').textContent.startsWith('contact 1, kind: found'));
    assert.equal(await heading(page), 'Step 2 of 16');
  }, {hash: `#step-2;problem=${letters({contacts: [{kind: '<b>'}], A: [['1']], b: ['1'], policy: 'paper'})}`});
});

// The problem of the loop, with one entry changed.
function edited() {
  const problem =
      JSON.parse(/id="data">(.*?)<\/script>/s.exec(readFileSync(join(PAGES, 'loop.html'), 'utf8'))[1]).problem;
  problem.A[0][1] = problem.A[1][0] = '-3.9';
  return {...problem, name: 'edited'};
}

test('the scene is drawn while the problem is its own', async () => {
  await opened('scene', async page => {
    await openEditor(page);
    await page.selectOption(field('policy scan'), 'highest');
    await runAgain(page);
    assert.equal(await page.isVisible('#picture svg'), true);
    await page.fill(field('b 0'), '-3');
    await runAgain(page);
    assert.equal(await page.isVisible('#picture'), false);
  });
});

test('the keyboard alone edits and runs, and moves no step meanwhile', async () => {
  await opened('loop', async page => {
    await page.focus('#edit summary');
    await press(page, 'Enter');
    await page.waitForSelector('#edit .policy select');
    await page.focus(field('b 0'));
    await press(page, 'End', 'ArrowLeft', 'Delete', '2', ' ', 'Tab');
    assert.equal(await page.inputValue(field('b 0')), '-2 ');
    assert.equal(await heading(page), 'Step 5 of 16');
    await press(page, 'Enter');
    await page.waitForSelector('#edited', {state: 'visible'});
    assert.equal(JSON.parse((await downloaded(page)).text).b[0], '-2');
  }, {hash: '#step-5'});
});

test('the editor fits a narrow window, and all in it has a name', async () => {
  await opened('loop', async page => {
    await openEditor(page);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const bare = await page.$$eval(
        '#edit button, #edit input, #edit select, #edit [role=group]',
        all => all.filter(node => !node.getAttribute('aria-label')).map(node => node.outerHTML.slice(0, 80)));
    assert.deepEqual(bare, []);
    await page.tap('#edit button[type=submit]');
    await page.waitForSelector('#edited', {state: 'visible'});
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  }, {viewport: {width: 360, height: 740}, isMobile: true, hasTouch: true});
});

test('a run that does not end is ended, by the page or its reader', async () => {
  // In place of the solver, what answers one question and then never again.
  const silent = page => page.addInitScript(() => {
    window.asked = window.ended = 0;
    window.Worker = class {
      postMessage() {
        if (++window.asked === 2) setTimeout(() => this.onmessage({data: '{"switches": [], "limits": {}}'}), 0);
      }
      terminate() {
        ++window.ended;
      }
    };
  });
  await opened('loop', async page => {
    await page.clock.install();
    await page.click('#edit summary');
    await page.waitForFunction(() => window.asked === 2);
    await page.clock.runFor(10);
    await page.click('#edit button[type=submit]');
    await page.waitForFunction(() => window.asked === 3);
    await page.clock.runFor(19000);
    assert.match(await told(page), /^Running; it is stopped after 20 seconds/);
    await page.clock.runFor(2000);
    assert.equal(await told(page), 'no end within 20 seconds: the run was stopped');
    await page.click('#edit button[type=submit]');
    await page.waitForFunction(() => window.asked === 5);
    await page.click('#edit button[aria-label="Stop"]');
    await page.clock.runFor(10);
    assert.equal(await told(page), 'stopped');
    assert.equal(await page.evaluate(() => window.ended), 2);
    assert.equal(await heading(page), 'Step 3 of 16');
  }, {prepare: silent, hash: '#step-3'});
});

test('a problem in space is edited and takes the steps of the program, over doubles alone', async () => {
  const edits = [
    {changes: [], policy: 'paper', end: /cycle: after rounding.*; over doubles alone: stiction replay says what is proved$/},
    {changes: [['b 0', '-1.5'], ['A 1 0', '1/4']], policy: 'paper', end: /: /},
    {changes: [['mu 1', '2.5']], policy: 'give-up=second,slip=redirect', end: /: /},
  ];
  for (const {changes, policy, end} of edits) {
    await opened('space', async page => {
      await openEditor(page);
      assert.match(await page.textContent('#edit .note'), /runs over rounded numbers, as in the program/);
      assert.equal(await page.locator(field('policy file')).count(), 0);
      await runEdited(page, changes, policy);
      assert.match(await page.textContent('#verdicts .run-0'), end);
      await assertRunsLikeTheProgram(page, policy);
    });
  }
});

test('contacts in space have two rows of friction, and slip along a unit vector', async () => {
  const rows = page => page.$$eval('#edit .entries tbody th', cells => cells.map(cell => cell.textContent));
  let hash = '';
  await opened('space', async page => {
    await openEditor(page);
    assert.deepEqual(await rows(page), ['N1', 'F1x', 'F1y', 'N2', 'F2x', 'F2y']);
    await page.selectOption(field('kind 1'), 'frictionless');
    assert.deepEqual(await rows(page), ['N1', 'F1x', 'F1y', 'N2']);
    await page.click('#edit button[aria-label="Add a contact"]');
    assert.deepEqual(await rows(page), ['N1', 'F1x', 'F1y', 'N2', 'N3', 'F3x', 'F3y']);
    await page.selectOption(field('kind 2'), 'sliding');
    await page.fill(field('slip 2[1]'), '1');
    await page.click('#edit button[type=submit]');
    await page.waitForFunction(
        () => document.querySelector('#edit .told').textContent.startsWith('contact 3, slip: found'));
    await page.fill(field('slip 2'), '-3/5');
    await page.fill(field('slip 2[1]'), '4/5');
    await runAgain(page);
    hash = await hashOf(page);
    const {text} = await downloaded(page);
    assert.equal(JSON.parse(text).dimension, 3);
    assert.deepEqual(JSON.parse(text).contacts[2], {kind: 'sliding', mu: '1', slip: ['-3/5', '4/5']});
    await leaveFields(page);
    await assertRunsLikeTheProgram(page, 'paper');
  });
  await opened('space', async page => {
    await page.waitForSelector('#edited', {state: 'visible', timeout: 20000});
    assert.deepEqual(await rows(page), ['N1', 'F1x', 'F1y', 'N2', 'N3', 'F3x', 'F3y']);
    assert.equal(await page.inputValue(field('slip 2[1]')), '4/5');
  }, {hash});
  // Of another dimension than the page's.
  await opened('loop', async page => assert.equal(await page.isVisible('#edited'), false), {hash});
});

test('before the first step it is said what is to come', async () => {
  await opened('loop', async page => {
    const story = run => page.textContent(`section.run-${run} .story`);
    assert.match(await story(0), /First, drive 1 N1\./);
    assert.match(await story(0), /16 steps in 7 drives\. A variable is given up at step 5, 10, 15\./);
    assert.match(await story(0), /The loop begins after step 2 and closes at step 16\./);
    assert.match(await story(1), /5 pieces in 4 stages\. The path turns back at piece 4\./);
    assert.match(await story(1), /keeps step with the first run/);
    await page.click('section.run-0 .outlook a >> text="10"');
    await becomes(page, 'Step 10 of 16');
    assert.equal(await page.locator('.outlook').count(), 0);
  });
  await opened('at-rest', async page => {
    assert.match(await page.textContent('section.run-0 .story'), /No step is taken\./);
    assert.equal(await page.locator('.how').count(), 0);
  });
});

test('no script but its own runs', () => assertRunsNoOtherScript('loop.html'));
