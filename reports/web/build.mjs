// SPDX-License-Identifier: Apache-2.0
// Bundles the pages: `node build.mjs [FOLDER]` writes FOLDER/viewer.html (dist/ by default).
//
// A page is one file: its script and its style sheet inside, allowed by their hashes and nothing else, formulas
// set as MathML. Of a page's source  {{script}}, {{style}}, {{policy}}, {{notices}} and {{solver}} are filled
// in here, as is \( TeX \);
// the other marks, {{title}}, {{data}} and such, are left to the program (reports/html/template.h). The same sources
// give the same bytes.
import {build} from 'esbuild';
import katex from 'katex';
import {createHash} from 'node:crypto';
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const pages = ['animation', 'viewer', 'report', 'findings', 'comparison', 'paste'];

async function bundle(file, define = {}) {
  const result = await build({
    entryPoints: [join(here, 'src', file)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    charset: 'utf8',
    format: 'iife',
    target: ['es2020', 'chrome109', 'firefox102', 'safari16'],
    legalComments: 'none',
    define,
    write: false,
    metafile: true,
  });
  return {text: result.outputFiles[0].text.trim(), inputs: Object.keys(result.metafile.inputs)};
}

// Name, version and licence of each package of which the bundle has a part.
export function notices(inputs) {
  const folders =
      new Set(inputs.map(path => path.match(/^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//)?.[1]).filter(Boolean));
  return [...folders].sort().map(folder => {
    const facts = JSON.parse(readFileSync(join(here, folder, 'package.json'), 'utf8'));
    const licence = readdirSync(join(here, folder)).find(name => /^licen[cs]e/i.test(name));
    if (licence === undefined) throw new Error(`${folder}: found no licence, expected a file LICENSE`);
    return `${facts.name} ${facts.version}\n\n${readFileSync(join(here, folder, licence), 'utf8').trim()}`;
  });
}

const solver = join(here, 'solver');

function notice(inputs, hasSolver) {
  const parts = notices(inputs);
  if (hasSolver) parts.push(readFileSync(join(solver, 'LICENSES.txt'), 'utf8').trim());
  const text = parts.length === 0 ? 'It holds no code but stiction\'s own.' :
                                    `It holds parts of:\n\n${parts.join('\n\n')}`;
  return text.replaceAll('--', '- -');  // no end of a comment
}

const hash = text => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const formula = (_, tex) => katex.renderToString(tex, {output: 'mathml', throwOnError: true, strict: 'error'})
                                .replace(/^<span class="katex">/, '')
                                .replace(/<\/span>$/, '');

async function page(name) {
  const source = readFileSync(join(here, 'src', `${name}.html`), 'utf8'),
        hasSolver = source.includes('{{solver}}');
  const worker = hasSolver ? await bundle('worker.js') : {text: '', inputs: []};
  const script = await bundle(`${name}.js`, {WORKER_SOURCE: JSON.stringify(worker.text)});
  const style = await bundle(`${name}.css`);
  if (/<\/script|<!--/i.test(script.text)) throw new Error(`${name}.js: found an end of a script or a comment in it`);
  // README.md has why.
  const [compiles, threads] = hasSolver ? [` 'wasm-unsafe-eval'`, ' worker-src blob:;'] : ['', ''];
  const policy = `default-src 'none'; script-src ${hash(script.text)}${compiles};${threads} style-src ${
                     hash(style.text)}; base-uri 'none'; ` +
      `form-action 'none'`;
  const parts = {
    policy,
    script: script.text,
    style: style.text,
    notices: notice([...script.inputs, ...worker.inputs, ...style.inputs], hasSolver),
    solver: hasSolver ? readFileSync(join(solver, 'solver.wasm.gz')).toString('base64') : '',
  };
  return source.replace(/\\\((.+?)\\\)/g, formula)
      .replace(/\{\{(policy|script|style|notices|solver)\}\}/g, (_, part) => parts[part]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const out = process.argv[2] ?? join(here, 'dist');
  mkdirSync(out, {recursive: true});
  for (const name of pages) writeFileSync(join(out, `${name}.html`), await page(name));
}
