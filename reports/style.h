// SPDX-License-Identifier: Apache-2.0
// The style sheet of a report. No style stands in an attribute, so a content security policy may allow this
// one sheet alone.

#ifndef STICTION_REPORTS_STYLE_H_
#define STICTION_REPORTS_STYLE_H_

namespace stiction {

inline constexpr char kStyle[] = R"css(
:root {
  color-scheme: light dark;
  --paper: #fbfaf7; --card: #ffffff; --ink: #1d2327; --soft: #5d676e; --line: #dcdad3; --accent: #0b5c8a;
  --bar: #3b82ad; --loop: #a1361c; --loop-paper: #fbe9e3; --good: #23693d; --code: #f1efe9;
  --h1: #fdf3e3; --h2: #fbe3c4; --h3: #f8cda2; --h4: #f1ae7f; --h5: #e68a62; --heat-ink: #2a1a10;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #14181b; --card: #1b2125; --ink: #e4e6e6; --soft: #9aa5ac; --line: #343c42; --accent: #7cc0ea;
    --bar: #5b9fca; --loop: #f39a7c; --loop-paper: #3a231c; --good: #86c99c; --code: #232a2f;
    --h1: #2b2620; --h2: #40301f; --h3: #5a3c20; --h4: #7a4824; --h5: #9c552b; --heat-ink: #fbeee2;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0 auto; padding: 1.5rem clamp(0.9rem, 3vw, 2.5rem) 4rem; max-width: 84rem;
  background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", "Liberation Sans", Arial, sans-serif;
}
h1 { font-size: clamp(1.6rem, 4vw, 2.3rem); line-height: 1.15; margin: 0.5rem 0 0.8rem;
  letter-spacing: -0.01em; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 0 0 0.6rem; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 0.4rem; }
p { max-width: 50rem; margin: 0.5rem 0 0.9rem; }
a { color: var(--accent); }
header p { font-size: 1.08rem; }
nav { margin: 1rem 0 0; display: flex; flex-wrap: wrap; gap: 0.3rem 1.2rem; font-size: 0.95rem; }
section { margin-top: 2.2rem; padding-top: 1.6rem; border-top: 1px solid var(--line); }
.note, small, .soft { color: var(--soft); }
.note { font-size: 0.92rem; }
code, pre, .mono { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "Liberation Mono", monospace;
  font-size: 0.9em; }
code { overflow-wrap: anywhere; }
pre { background: var(--code); border-radius: 6px; padding: 0.7rem 0.9rem; overflow-x: auto; margin: 0.6rem 0; }
pre code { overflow-wrap: normal; font-size: 1em; }

.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: 0.8rem;
  margin: 1rem 0 1.4rem;
  padding: 0; list-style: none; }
.tiles li { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 0.8rem 1rem; }
.tiles strong { display: block; font-size: 1.65rem; line-height: 1.2; font-weight: 650;
  font-variant-numeric: tabular-nums; }
.tiles .loop strong { color: var(--loop); }
.tiles span { color: var(--soft); font-size: 0.92rem; }

.scroll { overflow-x: auto; max-width: 100%; margin: 0.7rem 0 1.2rem; }
table { border-collapse: collapse; font-size: 0.9rem; background: var(--card); border: 1px solid var(--line); }
caption { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%);
  white-space: nowrap; }
th, td { padding: 0.3rem 0.65rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
thead th { font-weight: 600; color: var(--soft); vertical-align: bottom; border-bottom: 2px solid var(--line);
  font-size: 0.85rem; }
thead th[title] { text-decoration: underline dotted; text-underline-offset: 3px; }
tbody th { font-weight: 500; white-space: nowrap; }
tbody th.signature { white-space: normal; }
.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td small, th small { display: block; font-size: 0.87em; }
.zero { color: var(--soft); opacity: 0.65; }
tr.total > * { font-weight: 650; border-top: 2px solid var(--line); }
tr.group > * { border-top: 2px solid var(--line); }
.h1 { background: var(--h1); } .h2 { background: var(--h2); } .h3 { background: var(--h3); }
.h4 { background: var(--h4); } .h5 { background: var(--h5); }
.h1, .h2, .h3, .h4, .h5, .h3 small, .h4 small, .h5 small { color: var(--heat-ink); }
.same { font-weight: 650; }

dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 0.25rem 1.2rem; margin: 0.6rem 0; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }

.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr)); gap: 1rem; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 8px;
  padding: 0.7rem 0.8rem 0.4rem; }
figcaption { font-size: 0.92rem; }
svg { display: block; width: 100%; height: auto; margin-top: 0.3rem; }
svg rect { fill: var(--bar); }
svg line { stroke: var(--line); stroke-width: 1; }
svg text { fill: var(--soft); font-size: 11px; font-family: inherit; }

.badge { display: inline-block; padding: 0 0.5rem; border-radius: 1rem; font-size: 0.82rem; white-space: nowrap;
  border: 1px solid var(--line); }
.badge.loop { background: var(--loop-paper); color: var(--loop); border-color: transparent; font-weight: 600; }
.badge.whole { color: var(--good); border-color: var(--good); }
.signature { min-width: 13rem; }
.findings { width: 100%; }
tr.finding > * { border-bottom: 0; padding-top: 0.6rem; }
tr.more > td { padding-top: 0; padding-bottom: 0.6rem; }
summary { cursor: pointer; color: var(--accent); font-size: 0.9rem; }
.featured { background: var(--card); border: 1px solid var(--line); border-left: 4px solid var(--loop);
  border-radius: 8px;
  padding: 0.9rem 1.1rem; margin: 1rem 0; }
.featured h3 { margin-top: 0; }
.details { max-width: 60rem; }
.details table { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "Liberation Mono", monospace; }
.details td.edge, .details th.edge { border-left: 2px solid var(--line); }

@media (max-width: 36rem) {
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: 0.5rem; }
  th, td { padding: 0.25rem 0.45rem; }
  .tiles { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  .tiles strong { font-size: 1.3rem; }
}
@media print {
  :root {
    --paper: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #bbb; --accent: #000; --loop: #8a2c14;
    --code: #f4f4f4;
    --h1: #fdf3e3; --h2: #fbe3c4; --h3: #f8cda2; --h4: #f1ae7f; --h5: #e68a62; --heat-ink: #000; --bar: #444;
  }
  html { font-size: 8.5pt; }
  body { max-width: none; padding: 0; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  nav { display: none; }
  th, td { padding: 0.15rem 0.5rem; }
  .scroll { overflow: visible; }
  figure, tr, .tiles li, .featured { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .signature { min-width: 0; }
  pre { white-space: pre-wrap; }
}
)css";

}  // namespace stiction

#endif  // STICTION_REPORTS_STYLE_H_
