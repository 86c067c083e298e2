# SPDX-License-Identifier: Apache-2.0
"""Figures of the problems of the corpus, of their certificates and of single runs."""

import collections
import decimal
import json
import re
import subprocess
import sys
from fractions import Fraction

from markdown import count, front_matter, prose, table, three
from program import ROOT

sys.path.insert(0, str(ROOT / "tests/setup"))
from into_space import loop_by_the_plane  # noqa: E402


HEADLINE = "corpus/cycle-every-policy-mu-1.json"


def policies(program, file, shown=True):
    return program.json("replay", file, "--all-policies", codes=(0, 1), shown=shown)["policies"]


def ends(runs):
    """How many policies end how: "1320 cycle, 216 solved"."""
    return ", ".join(f"{number} {outcome}" for outcome, number
                     in collections.Counter(run["outcome"] for run in runs.values()).most_common())


def recurrences(runs):
    """(start, period) -> policies, the most frequent first."""
    loops = [run for run in runs.values() if run["outcome"] == "cycle"]
    counted = collections.Counter((run["start"], run["period"]) for run in loops)
    return sorted(counted.items(), key=lambda item: (-item[1], item[0]))


def headline_loop(program):
    runs = policies(program, HEADLINE)
    paper = (runs["paper"]["start"], runs["paper"]["period"])
    rows = [(*loop, number, "yes" if loop == paper else "") for loop, number in recurrences(runs)]
    return prose(f"Of {len(runs)} policies: {ends(runs)}. The state after so many drives recurs so many drives "
                 "later:") + "\n\n" + table(["drives before", "drives of a period", "policies", "`paper`"], rows)


def readings(program):
    """How the policies of two-contact-cycle.json end, by the two switches that decide it."""
    runs = policies(program, "corpus/two-contact-cycle.json")
    counted = collections.Counter()
    for name, run in runs.items():
        switches = name.split(",")
        counted["file=yes" in switches, "drop=variable" in switches, run["outcome"]] += 1
    rows = []
    for file, drop in ((False, False), (False, True), (True, False), (True, True)):
        cycle, solved = (counted[file, drop, outcome] for outcome in ("cycle", "solved"))
        rows.append(("yes" if file else "no", "variable" if drop else "contact", cycle + solved, cycle, solved))
    return (prose(f"`corpus/two-contact-cycle.json` under {len(runs)} policies: {ends(runs)}.") + "\n\n"
            + table(["`file`", "`drop`", "policies", "cycle", "solved"], rows))


def endless(program):
    """Policies that have neither ended nor repeated a state, by the switches that say where a scan begins."""
    file = "corpus/endless/without-repetition.json"
    runs = program.json("replay", file, "--all-policies", "--max-drives", 300, codes=(0, 1))["policies"]
    counted = collections.Counter()
    for name, run in runs.items():
        switches = name.split(",")
        scan = next((x for x in switches if x.startswith("scan=")), "scan=lowest")
        counted[scan, "resume=round" in switches, run["outcome"]] += 1
    rows = []
    for scan, resume in sorted({key[:2] for key in counted}):
        ends_of = [counted[scan, resume, outcome] for outcome in ("solved", "cycle", "limit")]
        rows.append((f"`{scan}`", "`resume=round`" if resume else "`resume=restart`", *ends_of))
    return prose(f"Of {len(runs)} policies: {ends(runs)}.") + "\n\n" + table(
        ["scan", "it begins", "solved", "cycle", "neither, 300 drives"], rows)


ROBUST = (("block-in-a-valley", "corpus/scenes/block-in-a-valley.json"),
          ("weight-on-two-pegs", "corpus/scenes/weight-on-two-pegs.json"),
          ("friction-gravity-3-contacts", "corpus/records/friction-gravity-3-contacts.json"),
          ("friction-gravity-4-contacts", "corpus/records/friction-gravity-4-contacts.json"))


def at_least(value):
    """A decimal number of two digits, not above the value."""
    down = decimal.Context(prec=2, rounding=decimal.ROUND_DOWN)
    return f"{down.divide(value.numerator, value.denominator):.1e}"


def robust_scenes(program):
    """How far everything may move at once, and the loop is proved to stay."""
    rows = []
    program.show("./run assemble SCENE --full -o P.json && ./run certify P.json --robust")
    for name, file in ROBUST:
        content = json.loads((ROOT / file).read_text())
        scene, problem = program.folder / "scene.json", program.folder / "P.json"
        scene.write_text(json.dumps(content.get("problem", content)))
        program.text("assemble", scene, "--full", "-o", problem, shown=False)
        row, = program.json("certify", problem, "--robust", codes=(0, 3), shown=False)
        radius = lambda key: "none proved" if row[key] is None else at_least(Fraction(row[key]))
        mu = max(Fraction(contact["mu"]) for contact in json.loads(problem.read_text())["contacts"])
        rows.append((f"`{name}`", mu, radius("radius"), radius("scene_radius")))
    return table(["scene", "mu", "A, b, mu", "all that the scene is built of"], rows)


def scenes_in_space(program):
    """Scenes of the plane in space: what loops there, and what proves it."""
    rows = []
    program.show("./run solve corpus/space/NAME.json --method baraff --policy slip=redirect")
    program.show("./run solve corpus/space/NAME.json --method baraff --policy slip=redirect --arithmetic double")
    program.show("tests/setup/into_space.py build/release/stiction SCENE -o corpus/space/NAME.json")
    for file in sorted((ROOT / "corpus/space").glob("cycle-of-a-scene-*.json")):
        content = json.loads(file.read_text())
        by_the_plane = loop_by_the_plane(program.path, content)
        ends_of = []
        for arithmetic in ("interval", "double"):
            for policy in ("paper", "slip=redirect"):
                run = program.json("solve", file, "--method", "baraff", "--policy", policy, "--arithmetic", arithmetic,
                                   codes=(0, 1, 3), shown=False)
                loop = run["outcome"] == "cycle"
                ends_of.append(f"{run['start']}, {run['period']}" if loop else run["outcome"])
        rows.append((f"`{file.stem}`", len(content["contacts"]), content["contacts"][0]["mu"],
                     "{}, {}".format(*by_the_plane) if by_the_plane else "-", *ends_of))
    return table(["file", "contacts", "mu", "proved by the plane, both readings", "over intervals, proved: literal", "redirect",
                  "over doubles, no proof: literal", "redirect"], rows)


def corpus_table(program, folder):
    """How every case of a folder ends under all policies."""
    rows, solved = [], 0
    program.show(f"./run replay {folder}/NAME.json --all-policies")
    for file in sorted((ROOT / folder).glob("*.json")):
        runs = policies(program, f"{folder}/{file.name}", shown=False)
        if {run["outcome"] for run in runs.values()} == {"solved"}:
            solved += 1
            continue
        loops = recurrences(runs)
        most = ", ".join(f"({start}, {period}) {number}" for (start, period), number in loops[:4])
        more = f", {len(loops) - 4} more" if len(loops) > 4 else ""
        rows.append((f"`{file.stem}`", ends(runs), most + more))
    rows.append((f"the other {solved}", "solved by every policy", ""))
    return table(["file", "policies, by outcome", "loops: (drives before, drives of a period) policies"], rows)


def corpus(program):
    return corpus_table(program, "corpus")


def sliding_corpus(program):
    return corpus_table(program, "corpus/sliding")


def wrong_in_doubles(program):
    rows = []
    program.show("./run solve corpus/NAME.json --method baraff --arithmetic double")
    for file in sorted((ROOT / "corpus").glob("wrong-in-doubles-*.json")):
        answer = program.json("solve", f"corpus/{file.name}", "--method", "baraff", "--arithmetic", "double",
                              shown=False)
        over_doubles = answer.get("suspected", answer)
        rows.append((f"`{file.stem}`", three(over_doubles["residual"]), over_doubles["outcome"],
                     f"{answer['outcome']}, {answer['arithmetic']}"))
    return table(["file", "error of the forces over doubles", "said of them", "the answer"], rows)


def methods_built(program):
    """Where each method is built."""
    methods = program.json("methods")
    names = ("float", "double", "quad", "interval", "filtered", "exact")
    rows = [[f"`{m['name']}`", *(", ".join(where for where in ("plane", "space") if name in m[where]) or "-"
                                for name in names)] for m in methods]
    refused = 2 * len(names) * len(methods) - sum(len(m["plane"]) + len(m["space"]) for m in methods)
    return table(["method", *names], rows) + f"\n\n{refused} of {2 * len(names) * len(methods)} combinations are refused."


def safe_by_condition(program):
    """Two bounds on mu for the A of two-contact-cycle.json, below which it is safe."""
    answer = program.json("certify", "corpus/safe-by-condition.json", "--safe")
    condition, threshold = answer["condition"]["mu"], answer["threshold"]
    if threshold["low"] != threshold["high"]:
        raise ValueError("a threshold that is no single number")
    numerator, denominator = map(int, condition.split("/"))
    rows = [("the condition number of a scaled A alone", f"{condition} = {numerator / denominator:.4f}"),
            ("its determinants", threshold["high"])]
    return table(["says that A of `safe-by-condition.json` is safe", "for mu up to"], rows)


# ---- The worst case ------------------------------------------------------------------------------------------

SIZES = (1, 2, 4, 8, 12)
RUNS = (  # head, scaled, options
    ("`paper`", False, ("--method", "baraff")),
    ("scaled, `most-violated`", True, ("--method", "baraff", "--policy", "scan=most-violated")),
    ("`most-violated`", False, ("--method", "baraff", "--policy", "scan=most-violated")),
    ("`highest`", False, ("--method", "baraff", "--policy", "scan=highest")),
    ("`complete`", False, ("--method", "complete")),
    ("`lemke`", False, ("--method", "lemke")),
)


def worst_case(program):
    """Pivots, or pieces, without friction."""
    program.show("./run problem --exponential N -o problem.json")
    program.show("./run problem --exponential N --scaled -o problem.json")
    program.show("./run solve problem.json --method METHOD --policy POLICY")
    rows = []
    for n in SIZES:
        row = [n]
        for _, scaled, options in RUNS:
            file = program.folder / "problem.json"
            program.text("problem", "--exponential", n, *["--scaled"] * scaled, "-o", file, shown=False)
            statistics = program.json("solve", file, *options, shown=False)["statistics"]
            row.append(count(statistics["pieces" if "pieces" in statistics else "pivots"]))
        rows.append(row)
    return table(["n", *(head for head, _, _ in RUNS)], rows)


# ---- Certificates of a small search --------------------------------------------------------------------------


def replays_as_certified(program, certificate, problem):
    run = certificate["witness"]["runs"][0]
    replay = program.json("replay", problem, "--policy", run["policies"][0], codes=(0, 1), shown=False)
    stated = (certificate["claim"], run["start"], run["period"])
    return (replay["outcome"], replay["start"], replay["period"]) == stated


def accepted_by_both(program, files):
    """How many certificates the program accepts, and how many the independent checker."""
    program.show("./run check report/findings/*.certificate.json")
    program.show("python3 certify/check_certificate.py report/findings/*.certificate.json")
    ours = sum(entry["accepted"] for entry in program.json("check", *files, codes=(0, 1), shown=False))
    checker = [sys.executable, ROOT / "certify/check_certificate.py"]
    theirs = sum(subprocess.run([*checker, file], capture_output=True).returncode == 0 for file in files)
    return ours, theirs


def certificates(program):
    """A search of fixed size in an empty folder: its certificates through both checkers, its loops replayed."""
    store, report = program.folder / "small.store", program.folder / "report"
    summary = program.json("search", "--generator", "integers", "psd", "--contacts", 2, "--seed", 7, "--problems", 100000,
                           "--store", store)
    program.text("report", store, "-o", report)
    files = sorted(report.glob("findings/*.certificate.json"))
    ours, theirs = accepted_by_both(program, files)
    grid = len(policies(program, HEADLINE, shown=False))
    replayed = whole_grid = 0
    for file in files:
        certificate = json.loads(file.read_text())
        if certificate["claim"] == "cycle":
            problem = file.with_name(file.name.replace(".certificate", ""))
            replayed += replays_as_certified(program, certificate, problem)
            whole_grid += sum(len(run["policies"]) for run in certificate["witness"]["runs"]) == grid
    rows = [("problems, of two contacts", count(summary["problems"])),
            ("loops, and groups of them", f"{summary['failures']['cycle']}, {summary['groups']['cycle']}"),
            ("certificates", len(files)),
            ("accepted by `check`, by `check_certificate.py`", f"{ours}, {theirs}"),
            ("minimized loops that replay to their certified period", replayed),
            ("among them loops under every policy", whole_grid)]
    return table(["a search of fixed size", ""], rows)


def dearest(program):
    """What the dearest certificates cost that the checkers take."""
    lines = program.script("tests/certify/limits_test.py", ".", "--dearest").splitlines()
    rows = []
    for line in lines:
        found = re.fullmatch(r"(.+?)  +(stiction check|check_\w+\.py) +accepted +([\d.]+) s +(\d+) MB", line)
        if found:
            name, checker, seconds, megabytes = found.groups()
            rows.append((name.strip(), f"`{checker}`", three(float(seconds)), megabytes))
    return table(["at its limit", "checker", "processor time, s", "memory, MB"], rows)


def nightly(program):
    """Steps of a night: what the command wrote."""
    program.show("./run test --nightly")
    subprocess.run([ROOT / "run", "test", "--nightly"])
    return front_matter((ROOT / "reports/measured/nightly.md").read_text())[1].split("\n\n", 1)[1].rstrip("\n")


def mutants(program):
    """By hand and drawn, and what survived."""
    head = subprocess.run(["git", "rev-parse", "--short=7", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    words = ["test", "--mutants", str(program.size(60)), "--seed", str(int(head, 16)), "--hand"]  # others for every commit
    program.show(f"./run {' '.join(words)}")
    lines = []
    with subprocess.Popen([ROOT / "run", *words], stdout=subprocess.PIPE, text=True) as run:
        for line in run.stdout:  # an hour, of which each bug says a line
            lines.append(line)
            print(line, end="", file=sys.stderr, flush=True)
    told = re.search(r"^\| \| bugs \|.*", "".join(lines), re.M | re.S)
    if not told:
        sys.exit(f"mutants: exit {run.returncode}")
    return told[0].strip()


def shown(value):
    """A fraction of few digits as it is, another as a decimal number."""
    number = Fraction(value)
    return value if max(abs(number.numerator), number.denominator) < 10 ** 4 else f"{float(number):.6g}"


def records(program):
    rows = [(record["what"], shown(record["value"]),
             f"{shown(record['random']) if record['random'] else 'no loop'}", count(record["random_evaluations"]))
            for record in program.json("records") if record["objective"] in ("condition", "friction")]
    return table(["the worst that is known", "value", "best of random problems", "of so many"], rows)


LONGEST = {"steps": "steps of a run that solves", "give-ups": "its give-ups", "zero-run": "steps of length zero in a row",
           "period": "drives of a period", "pieces": "pieces of `complete`", "descents": "its descents"}
CONTACTS = range(2, 9)


def longest_runs(program):
    """The records of runs that are long, by number of contacts."""
    by_name = {record["frontier"]: record for record in program.json("records")}

    def cell(objective, contacts):
        record = by_name.get(f"{objective}-{contacts}-contacts")
        if record is None:
            return ""
        apart = "*" if record["what"].endswith("not coupled") else ""
        return f"{shown(record['value'])}{apart} ({shown(record['random']) if record['random'] else '-'})"

    rows = [(what, *(cell(objective, n) for n in CONTACTS)) for objective, what in LONGEST.items()]
    rows += [("2^n - 1", *(count(2 ** n - 1) for n in CONTACTS)), ("4^n - 1", *(count(4 ** n - 1) for n in CONTACTS))]
    return table(["contacts", *CONTACTS], rows).replace("* (", "\\* (")
