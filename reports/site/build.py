#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The site: static pages that work from disk and from any server.

    ./run site -o DIR [--store STORE]     build.py PROGRAM -o DIR

The program draws, replays and reports; python3-markdown sets the texts of the repository. What a page says of a run
is read from the data that the program wrote. The report is that of STORE, or the example of this repository. A folder
that holds anything else than a site is left alone."""

import argparse
import hashlib
import html
import json
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import markdown

ROOT = Path(__file__).resolve().parents[2]
WEB = ROOT / "reports/web"
sys.path.insert(0, str(WEB))
import join  # noqa: E402

SHEETS = ("page.css", "scroll.css", "site.css")
MARK = ".stiction-site"  # in a folder that this program may write again
PAGES = {"index.html": "Story", "gallery.html": "Gallery", "paste.html": "Paste your matrix", "theorem.html": "Theorem",
         "report/index.html": "Report", "docs/index.html": "Documentation"}
# The texts that stand beside every page of the documentation: the page, its name.
TEXTS = {"docs/index.html": "First page", "docs/cli/tour.html": "A tour",
         "docs/corpus/formats/problems.html": "Problem files", "docs/words.html": "Words",
         "docs/python/index.html": "Python", "docs/solver/c/index.html": "C and engines",
         "docs/certify/results.html": "All results", "docs/certify/grounds.html": "What claims rest on",
         "docs/texts.html": "All texts"}
FOLDERS = ("bench", "certify", "cli", "corpus", "python", "reports", "scene", "search", "solver", "tests")
DATA = (".json", ".svg", ".html", ".csv")  # what a text may link to besides texts, and is copied
EXAMPLE = "reports/examples/search"

# File under corpus/, heading, a sentence, options of replay.
GALLERY = (
    ("scenes/block-in-a-valley", "A block in a groove",
     "One block lies on two slopes under gravity alone. The published algorithm never finds its forces.", ()),
    ("scenes/weight-on-two-pegs", "A weight on two pegs",
     "A loop that somebody could build: with every dimension off by a tenth, nearly all such scenes still loop.", ()),
    ("cycle-every-policy-mu-1", "Sixteen small integers",
     "Two contacts, integers of one digit, friction 1: it loops however the published text is read.", ()),
    ("space/cycle-under-both-slips", "A loop in space",
     "Two contacts in space. The forces are irrational; intervals prove that the run never ends.", ()),
    ("descent-of-complete-driving", "A repair that turns back",
     "Complete driving follows the path of forces through a fold, goes back a stage, and still arrives.", ()),
    ("scenes/scripted-wedge-jams", "A slider that jams",
     "A floor is pushed up under a slider on a rail. Friction is too strong to give way: no forces exist.", ()),
    ("scenes/rod-without-solution", "Painlevé's rod",
     "A rod slides with its tip on the floor. At this friction no force keeps the tip from sinking in.", ()),
    ("scenes/jammed-wedge", "A wedge that holds itself",
     "It may stay, clamped by forces that need only each other, or fall. Both obey the law.", ()),
    ("scenes/card-house", "A house of cards",
     "Six cards and a deck: many contacts at once, all held by friction.", ()),
    ("scenes/large/brick-wall", "A wall of 95 bricks",
     "Every brick stays where it is. Play the wall, and see the forces between its bricks.", None),
    ("wrong-in-doubles-3-contacts", "A solver that fails",
     "Nearly degenerate. In floating-point numbers the algorithm says solved, and its forces are wrong: the gate "
     "refuses them.",
     ("--arithmetic", "double")),
    ("exponential-pivots-5-frictionless", "The long way round",
     "Five contacts without friction, and 31 steps. Each further contact of this kind doubles them.", ()),
)
TO_GALLERY = ("../gallery.html", "Gallery")  # from a page under play/
COQ = ROOT / "certify/coq/existence"


class Site:
    def __init__(self, program, out):
        self.program, self.out = program, out

    def ask(self, *words, codes=(0,)):
        """What the program prints."""
        done = subprocess.run([self.program, *map(str, words)], cwd=ROOT, text=True, capture_output=True)
        if done.returncode not in codes:
            raise SystemExit(f"site: {' '.join(map(str, words))} ended with {done.returncode}: {done.stderr.strip()}")
        return done.stdout

    def write(self, name, text):
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def page(self, name, title, body, side=""):
        """`body` is HTML; links in it are as from the page itself."""
        root = "../" * name.count("/")
        sheets = "\n".join(f'<link rel="stylesheet" href="{root}{sheet}">' for sheet in SHEETS)
        self.write(name, f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{html.escape(title)} - stiction</title>
<link rel="icon" href="data:,">
{sheets}
</head>
<body>
{navigation(name)}
{side}<main id="main">
{body}
</main>
</body>
</html>
""")

    # ---- Pictures and runs ----

    def drawn(self, scene):
        """The SVG of a scene, to stand within a page."""
        return self.ask("draw", f"corpus/{scene}.json", "-o", "-")

    def replay(self, file, options):
        """Writes the page of a run; its data, as the program put it there."""
        name = f"play/{Path(file).name}.html"
        text = self.ask("replay", f"corpus/{file}.json", *options, "--html", "-", codes=(0, 1, 3))
        self.write(name, with_way_back(text, *TO_GALLERY))
        return name, json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])

    def simulated(self, file):
        name = f"play/{Path(file).name}.html"
        with tempfile.TemporaryDirectory() as folder:
            self.ask("simulate", f"corpus/{file}.json", "--seconds", "0.2", "-o", f"{folder}/out")
            self.write(name, with_way_back(Path(folder, "out/animation.html").read_text(), *TO_GALLERY))
        return name

    # ---- Pages ----

    def gallery(self):
        cards = []
        for file, heading, sentence, options in GALLERY:
            if options is None:
                name, ends, picture = self.simulated(file), "", self.drawn(file)
            else:
                name, data = self.replay(file, options)
                ends = "".join(f'<li class="run-{i}"><b>{run["title"].split(",")[0]}</b>: {ending(run)}</li>'
                               for i, run in enumerate(data["runs"]))
                picture = self.drawn(file) if data["picture"] else plot(data)
            cards.append(f"""<li class="card"><a href="{name}"><h2>{heading}</h2>
<div class="drawing">{own_ids(picture, len(cards))}</div></a>
<p>{sentence}</p>
<ul class="ends">{ends}</ul></li>""")
        self.page("gallery.html", "Gallery", f"""<h1>Twelve problems</h1>
<p>Each opens as a page of its own. You can step through the run there, change its numbers, and run it again. Where
there is no scene the picture shows the forces of the published algorithm, step by step; what repeats is shaded.</p>
<ul class="cards">{"".join(cards)}</ul>""")

    def story(self):
        runs = json.loads(self.ask("replay", "corpus/cycle-of-a-block-in-a-valley.json", "--json", codes=(0, 1)))
        policies = json.loads(self.ask("replay", "corpus/cycle-every-policy-mu-1.json", "--all-policies", "--json"))
        svg = (ROOT / "corpus/scenes/block-in-a-valley-loop.svg").read_text()
        self.page("index.html", "Forces that never settle", f"""<div class="story">
<h1>Forces that never settle</h1>
<figure class="drawing">{svg}
<figcaption>The forces of the published algorithm on the block, again and again.</figcaption></figure>
<div>
<p>A block lies on two slopes. A simulation must know the forces where they touch, at every instant.</p>
<p>In 1994 D. Baraff published an algorithm that finds them. It raises one force after another, and lets the others
follow, until every contact obeys Coulomb's law of friction. Does it always end?</p>
<p><strong>It does not.</strong> On this block the state after {runs["start"]} drives comes back {runs["period"]} drives
later, and so for ever. The picture plays it. No rounding is to blame: all its numbers are fractions. No reading of the
text helps either: another problem, of one-digit integers, loops under all {readings(policies):,} readings.</p>
<p><strong>Yet the forces exist.</strong> Where bodies rest, they always do, for every friction:
<a href="theorem.html">a theorem</a>, which a machine has checked.</p>
<p><strong>And the algorithm can be repaired.</strong> It gives a force up where the path of forces turns back. Complete
driving turns back with the path, and always ends.</p>
<p class="calls"><a class="call" href="play/block-in-a-valley.html">Step through the loop</a>
<a class="call" href="paste.html">Paste your matrix</a> <a class="call" href="gallery.html">See twelve problems</a></p>
</div>
</div>""")

    def theorem(self):
        statement, laws = (COQ / "Statement.v").read_text(), (COQ / "Law.v").read_text()
        theorems = (COQ / "Theorems.v").read_text()
        quoted = "\n\n".join([
            sentence(laws, "Definition normal_conditions"), sentence(statement, "Definition length"),
            sentence(statement, "Definition coulomb_law"), sentence(statement, "Definition solution"),
            sentence(statement, "Definition symmetric"), sentence(statement, "Definition semidefinite"),
            sentence(statement, "Definition coulomb_has_a_solution"),
            sentence(theorems, "Theorem coulomb_solution_exists")])
        self.page("theorem.html", "The theorem", f"""<h1>Contacts at rest always have forces</h1>
<div class="story">
<div>
<p>Given are n contacts, a matrix A, a vector b and friction coefficients mu. Wanted are contact forces f with
accelerations a = A f + b. At every contact the normal force pushes, nothing sinks in, and a contact that parts
carries no force. Friction is at most mu times the normal force. Where a contact begins to slide, friction is at
that bound, against the motion.</p>
<p class="claim"><strong>Theorem.</strong> If A is symmetric and semidefinite, and b lies in the range of A, then such
forces exist, for every mu &#8805; 0, in the plane and in space.</p>
<p>Bodies at rest under any loads give such A and b. The forces need not be unique. With
<a href="play/rod-without-solution.html">sliding contacts</a> or <a href="play/scripted-wedge-jams.html">scripted
bodies</a> there may be none.</p>
<p>There is a <a href="docs/certify/existence.html">proof on paper</a>. <code>./run prove</code> has Coq check another,
and <a href="docs/certify/coq/index.html">what a reader must trust</a> is short. We do not know
<a href="docs/certify/related_work.html">whether it is new</a> in space.</p>
</div>
<figure class="drawing">{own_ids(self.drawn("scenes/space/tripod"), "t")}
<figcaption>A tripod at rest: the theorem says that forces hold it, whatever its feet rub on.</figcaption></figure>
</div>
<h2>Its statement in Coq</h2>
<p>From <code>certify/coq/existence</code>, copied when this page was made. <code>fN</code>, <code>fX</code>,
<code>fY</code> are the normal force and the two components of friction; <code>aN</code>, <code>aX</code>,
<code>aY</code> the accelerations. <code>baraff_law</code> is the weaker law of the paper, which holds besides.</p>
<pre tabindex="0"><code>{html.escape(quoted)}</code></pre>""")

    def paste(self):
        text, _ = join.page("paste")
        self.write("paste.html", text.replace("{{navigation}}", navigation("paste.html")))

    def report(self, store):
        if store is None:
            shutil.copytree(ROOT / EXAMPLE, self.out / "report")
        else:
            self.ask("report", Path(store).resolve(), "-o", self.out / "report", codes=(0, 4))
        self.lead_back(self.out / "report", "../index.html", "stiction")

    def lead_back(self, folder, href, name):
        """The pages of a report have a way back, and their checksums fit."""
        sums = folder / "SHA256SUMS"
        lines = sums.read_text()
        for page in folder.glob("*.html"):
            page.write_text(with_way_back(page.read_text(), href, name))
            lines = re.sub(rf"^\w+(  {re.escape(page.name)})$",
                           rf"{hashlib.sha256(page.read_bytes()).hexdigest()}\1", lines, flags=re.M)
        sums.write_text(lines)

    # ---- Documentation ----

    def documentation(self):
        texts = {ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")}
        texts |= {path for folder in FOLDERS for path in (ROOT / folder).rglob("*.md")
                  if "node_modules" not in path.parts}
        self.texts = {path.relative_to(ROOT).as_posix() for path in texts}
        titles = {name: self.text(name) for name in sorted(self.texts)}
        words = "".join(f'<dt>{html.escape(row["word"])}</dt><dd>{html.escape(row["meaning"])}'
                        f'{section(row["source"])}</dd>'
                        for row in json.loads(self.ask("words", "--json")))
        self.doc("docs/words.html", "Words", f'<h1>Words</h1>\n<p>What the words of answers and replays mean, as '
                 f'<code>stiction words</code> says. Numbers are sections of the paper.</p>\n'
                 f'<dl class="words">{words}</dl>')
        rows = "".join(f'<li><a href="{posixpath.relpath(page_of(name), "docs")}">{html.escape(title)}</a> '
                       f'<code>{name}</code></li>' for name, title in titles.items())
        self.doc("docs/texts.html", "All texts", f'<h1>All texts of the repository</h1>\n<ul class="texts">{rows}</ul>')

    def text(self, name):
        """Sets one text of the repository; its title."""
        text = (ROOT / name).read_text()
        text = re.sub(r"\A---\n(.*?)\n---\n", r"```\n\1\n```\n", text, flags=re.S)  # how it was measured
        body = markdown.markdown(text, output_format="html", extensions=[
            "fenced_code", "tables", "sane_lists", "toc"], extension_configs={"toc": {"slugify": slug}})
        body = re.sub(r'<a href="([^"]+)">(.*?)</a>', lambda link: self.link(name, *link.groups()), body, flags=re.S)
        body = re.sub(r'<img alt="([^"]*)" src="([^"]+)"[^>]*>', lambda found: self.picture(name, *found.groups()),
                      body)
        body = re.sub(r"<table>.*?</table>", r'<div class="scroll" tabindex="0">\g<0></div>', body, flags=re.S)
        body = body.replace("<pre>", '<pre tabindex="0">')
        heading = re.search(r"<h1[^>]*>(.*?)</h1>", body, re.S)
        title = re.sub("<.*?>", "", heading[1]) if heading else f"Measured: {Path(name).stem}"
        body = body if heading else f"<h1>{title}</h1>\n{body}"
        self.doc(page_of(name), html.unescape(title), body)
        return html.unescape(title)

    def doc(self, name, title, body):
        here = posixpath.dirname(name)
        links = "".join(f'<li><a href="{posixpath.relpath(page, here)}"{current(page == name)}>{text}</a></li>'
                        for page, text in TEXTS.items())
        self.page(name, title, body, f'<nav class="side" aria-label="Documentation"><ul>{links}</ul></nav>\n')

    def link(self, name, href, text):
        """A link of a text as it stands on its page: what is no page and no data becomes its path."""
        if re.match(r"[a-z]+:|#", href):
            return f'<a href="{href}">{text}</a>'
        path, _, anchor = href.partition("#")
        target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path))
        if (ROOT / target).is_dir():
            target += "/README.md"
        if target == f"{EXAMPLE}/index.html":
            href = posixpath.relpath("report/index.html", posixpath.dirname(page_of(name)))
        elif target in self.texts:
            href = posixpath.relpath(page_of(target), posixpath.dirname(page_of(name))) + (anchor and f"#{anchor}")
        elif (ROOT / target).is_file() and target.endswith(DATA):
            href = self.copied(name, path)
        else:
            return f"{text} (<code>{html.escape(target.removesuffix('/README.md'))}</code>)"
        return f'<a href="{href}">{text}</a>'

    def picture(self, name, alt, path):
        """A picture of a text, within its page, so that it is dark where the page is."""
        svg = (ROOT / posixpath.dirname(name) / path).read_text()
        svg = svg.replace("<svg ", f'<svg role="img" aria-label="{alt}" ', 1)
        return f'<span class="drawing picture">{own_ids(svg, Path(path).stem)}</span>'

    def copied(self, name, path):
        """Copies a file that a text names; its address from the page of the text."""
        target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path))
        copy = self.out / "docs" / target
        copy.parent.mkdir(parents=True, exist_ok=True)
        back = posixpath.relpath("docs/index.html", posixpath.dirname(f"docs/{target}")), "Documentation"
        if (ROOT / target).with_name("SHA256SUMS").is_file():  # a report, of which it is a page
            shutil.copytree((ROOT / target).parent, copy.parent, dirs_exist_ok=True)
            self.lead_back(copy.parent, *back)
        elif target.endswith(".html"):
            copy.write_text(with_way_back((ROOT / target).read_text(), *back))
        else:
            shutil.copyfile(ROOT / target, copy)
        return posixpath.relpath(f"docs/{target}", posixpath.dirname(page_of(name)))


def page_of(name):
    """The page of a text."""
    return "docs/" + re.sub(r"(^|/)README\.md$", r"\1index.md", name).removesuffix(".md") + ".html"


def with_way_back(page, href, name):
    return page.replace("<body>", f'<body>\n<p class="kicker"><a href="{href}">{name}</a></p>', 1)


def slug(text, _):
    """The name of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", html.unescape(text).strip().lower()).replace(" ", "-")


def current(is_here):
    return ' aria-current="page"' if is_here else ""


def navigation(name):
    root, part = "../" * name.count("/"), name.split("/")[0]
    links = "".join(f'<li><a href="{root}{page}"{current(page.split("/")[0] == part)}>{text}</a></li>'
                    for page, text in PAGES.items())
    return (f'<a class="skip" href="#main">To the text</a>\n'
            f'<nav class="site" aria-label="Site"><b>stiction</b><ul>{links}</ul></nav>')


def section(source):
    return f" ({html.escape(source)})" if source else ""


def sentence(text, head):
    """A sentence of Coq, from its head to the full stop that ends a line."""
    return re.search(rf"^{re.escape(head)}\b.*?\.$", re.sub(r"[ \t]+$", "", text, flags=re.M), re.M | re.S)[0]


def readings(policies):
    """How many policies loop: all of them, or the story is another."""
    outcomes = {policy["outcome"] for policy in policies["policies"].values()}
    if outcomes != {"cycle"}:
        raise SystemExit(f"site: expected loops alone under every policy, found {outcomes}")
    return len(policies["policies"])


def ending(run):
    """How a run ended, in plain words."""
    replay = run["replay"]
    rounded = replay.get("suspected", {})
    if rounded.get("outcome") == "undecided":
        return f"wrong by {rounded['residual']:.2g} over doubles, and refused; run again, exactly, it finds forces"
    return {"solved": "finds forces",
            "cycle": f"loops for ever, every {replay['period']} drives",
            "ray": "takes a step without limit: a force grows for ever",
            }.get(replay["outcome"], html.escape(run["end"].split(";")[0]))


def own_ids(svg, mark):
    """Ids of a picture, which stand on a page once."""
    for name in set(re.findall(r'\bid="([\w-]+)"', svg)):
        svg = re.sub(rf'(\bid="|url\(#|href="#){name}\b', rf"\g<1>{name}-{mark}", svg)
    return svg


def plot(data):
    """The forces of a run, step by step, as an SVG; a loop once more, shaded."""
    run = data["runs"][0]
    states = [run["replay"]["initial"]["f"]] + [pivot["f"] for pivot in run["replay"]["pivots"]]
    start = None
    if run["loop"]:
        start, end = run["loop"]["from"], run["loop"]["to"]
        states = states[:end + 1] + states[start + 1:end + 1]
    values = [[number(x) for x in column] for column in zip(*states)]
    low, high = min(min(v) for v in values), max(max(v) for v in values)
    width, height, edge = 400, 240, 16
    across = (width - 2 * edge) / max(1, len(states) - 1)
    down = (height - 2 * edge) / ((high - low) or 1)
    place = lambda i, y: f"{edge + across * i:.1f},{height - edge - down * (y - low):.1f}"
    parts = []
    if start is not None:
        x, y = edge + across * start, edge / 2
        parts.append(f'<rect class="again" x="{x:.1f}" y="{y}" width="{width - edge - x:.1f}" '
                     f'height="{height - edge}"/>')
    parts.append(f'<line class="axis" x1="{edge}" x2="{width - edge}" y1="{height - edge + down * low:.1f}" '
                 f'y2="{height - edge + down * low:.1f}"/>')
    for name, row in zip(data["rows"], values):
        points = " ".join(place(i, y) for i, y in enumerate(row))
        parts.append(f'<polyline class="{"normal" if name.startswith("N") else "friction"}" points="{points}">'
                     f"<title>force of {name}</title></polyline>")
    return (f'<svg xmlns="http://www.w3.org/2000/svg" class="plot" viewBox="0 0 {width} {height}" role="img" '
            f'aria-label="The forces, step by step">{"".join(parts)}</svg>')


def number(x):
    """Of the data: "-3/4", or a double."""
    if isinstance(x, str):
        above, _, below = x.partition("/")
        return int(above) / int(below or 1) if below or re.fullmatch(r"-?\d+", above) else float(x)
    return float(x)


def build(program, out, store):
    site = Site(program, out)
    for sheet in SHEETS:
        shutil.copy(WEB / "src" / sheet, out)
    site.story()
    site.gallery()
    site.theorem()
    site.paste()
    site.report(store)
    site.documentation()
    (out / MARK).write_text("Written by ./run site, which may write this folder again.\n")


def main():
    parser = argparse.ArgumentParser(prog="./run site",
                                     description="Static pages that work from disk and from any server.")
    parser.add_argument("program", help=argparse.SUPPRESS)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="the folder to write")
    parser.add_argument("--store", metavar="STORE",
                        help="whose report is on it; the example of the repository otherwise")
    given = parser.parse_args()
    out = given.output.absolute()
    if out.exists() and not (out / MARK).is_file() and (not out.is_dir() or any(out.iterdir())):
        sys.exit(f"site: {out}: found something that is no site, expected a new or empty folder, or a site to write "
                 "again")
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{out.name}-", dir=out.parent) as made:
        build(Path(given.program).resolve(), Path(made), given.store)
        if out.exists():
            shutil.rmtree(out)
        shutil.copytree(made, out)
    print(f"site: {out / 'index.html'}")


if __name__ == "__main__":
    main()
