# SPDX-License-Identifier: Apache-2.0
"""Figures of searches: how often the published algorithm loops, what doubles miss of it, and what always ends."""

import collections
import concurrent.futures
import csv
import fractions
import json
import math
import os
import re
import sqlite3
import statistics
import tempfile

import intervals
from program import ROOT
from markdown import count, prose, rate, share, table, three, with_ends

SEEDS = (1, 2, 3, 4)


class Cell:
    """Searches of one kind with several seeds, their counts added."""

    def __init__(self, program, *options, problems, seeds=SEEDS):
        self.sums = collections.Counter()
        self.failures = collections.Counter()
        for seed in seeds:
            self.add(program, options, problems // len(seeds), seed)

    def add(self, program, options, problems, seed):
        with tempfile.TemporaryDirectory(dir=program.folder) as folder:
            summary = program.json("search", *options, "--problems", problems, "--seed", seed, "--store", f"{folder}/s",
                                   shown=False)
        self.failures.update(summary["failures"])
        self.sums.update({key: value for key, value in summary.items() if isinstance(value, int)})

    def __getitem__(self, key):
        return self.sums[key]

    def loops(self):
        return self.failures["cycle"] + self.failures["stall"]


def first_search(program):
    """How the first minute of a search ends: what it says first, and last."""
    text = program.text("search", "--store", program.folder / "stiction.store", shown=False)
    program.show("./run search")
    text = text.replace(f"{program.folder}/", "").replace("    stiction ", "    ./run ")  # as ./run has it say
    head, rest = text.split("\n  The published algorithm", 1)
    lines = rest.splitlines()
    said = next(i for i, line in enumerate(lines) if line.endswith("never ends."))
    simplest = lines.index("Simplest, proved and minimized:")
    shown = [" ".join(head.split()), "  The published algorithm" + lines[0], *lines[1:said + 1], "  ...",
             *lines[simplest:simplest + 4], "  ...", *lines[-4:]]
    return "\n".join("    " + line for line in shown)


def together(function, cells):
    """The function of every cell, in their order; some cells at the same time."""
    with concurrent.futures.ThreadPoolExecutor(2 * (os.cpu_count() or 1)) as pool:
        return list(pool.map(lambda cell: function(*cell), cells))


def lower_bounds(cells, note=""):
    """What stands below every table of frequencies."""
    audited, misjudged = (sum(cell[key] for cell in cells) for key in ("audited", "misjudged"))
    problems = sum(cell["runs"] for cell in cells)
    return prose(f"{note}In brackets: exact intervals at 95 %, of counts Garwood's, of shares that of Clopper and "
                 "Pearson. Loops are looked for over doubles and confirmed exactly; those that doubles take for "
                 f"solutions are not among them: lower bounds. Of {count(problems)} runs {count(audited)} were audited without a suspicion; "
                 f"misjudged were {misjudged}, {share(misjudged, audited)}.")


# ---- Scenes --------------------------------------------------------------------------------------------------

FRICTION = ("1", "1/2", "1/3", "1/5", "1/10")


def scene_problems(contacts, mu, rare):
    """Of a cell: most where loops are rarest; few where each seed's loops take long to certify and minimize."""
    if contacts >= 4 and mu in ("1/5", "1/10"):
        return rare
    return min(rare, 200_000 if contacts >= 4 and mu == "1" else 1_000_000)


def scenes_by_mu(program):
    """Ten million problems of four and five contacts at the least friction, unless --problems says otherwise."""
    rare = program.size(10_000_000)
    kinds = [(contacts, mu) for contacts in (2, 3, 4, 5) for mu in FRICTION]

    def cell_of(contacts, mu):
        return Cell(program, "--generator", "scenes", "--contacts", contacts, "--mu", mu,
                    problems=scene_problems(contacts, mu, rare))

    cells, rows = together(cell_of, kinds), []
    for (contacts, mu), cell in zip(kinds, cells):
        of, loops, singular = cell["runs"], cell.loops(), cell.failures["singular"]
        rows.append((contacts, mu, count(of), loops, rate(loops, of), singular, rate(singular, of)))
    program.show("./run search --generator scenes --contacts CONTACTS --mu MU --problems N --seed SEED --store S")
    head = ["contacts", "mu", "problems", "loops", "in a million", "no direction", "in a million"]
    note = f"Seeds {SEEDS[0]} to {SEEDS[-1]}, pooled. "
    return table(head, rows) + "\n\n" + lower_bounds(cells, note)


def generators_by_mu(program):
    """Loops in a million problems of other generators."""
    problems = program.size(200_000)
    kinds = [(generator, contacts, mu) for generator in ("bodies", "integers", "psd", "small") for contacts in (3, 4)
             for mu in FRICTION[:4]]

    def cell_of(generator, contacts, mu):
        return Cell(program, "--generator", generator, "--contacts", contacts, "--mu", mu, problems=problems,
                    seeds=(1,))

    cells, rows = together(cell_of, kinds), {}
    for (generator, contacts, _), cell in zip(kinds, cells):
        row = rows.setdefault((generator, contacts), [f"`{generator}`", contacts])
        row.append(rate(cell.loops(), cell["runs"]))
    program.show(f"./run search --generator GENERATOR --contacts CONTACTS --mu MU --problems {problems} --store S")
    head = ["loops in a million", "contacts", *(f"mu = {mu}" if mu == "1" else mu for mu in FRICTION[:4])]
    return table(head, rows.values()) + "\n\n" + lower_bounds(cells)


REST_FRICTION = ("1/10", "1/5", "1/3", "1/2", "7/10", "1")
REST_CONTACTS = (3, 4, 5, 6)


def loops_by_law(program, campaign, problems):
    """Loops of a campaign by contacts, its friction coefficients one by one, and the power law through them."""
    kinds = [(contacts, mu) for contacts in REST_CONTACTS for mu in REST_FRICTION]
    cells = [Cell(program, f"search/campaigns/{campaign}.json", "--contacts", contacts, "--mu", mu, "--finishing", 0,
                  "--threads", 1, problems=program.size(problems), seeds=(1,)) for contacts, mu in kinds]
    rows = [(contacts, mu, count(cell["runs"]), cell.loops(), rate(cell.loops(), cell["runs"]), cell.failures["singular"],
             rate(cell.failures["singular"], cell["runs"])) for (contacts, mu), cell in zip(kinds, cells)]
    program.show(f"./run search search/campaigns/{campaign}.json --contacts CONTACTS --mu MU --problems {program.size(problems)} "
                 "--finishing 0 --store S")
    head = ["contacts", "mu", "problems", "loops", "in a million", "no direction", "in a million"]
    law = intervals.power_law([(cell.loops(), cell["runs"], float(fractions.Fraction(mu)), contacts)
                               for (contacts, mu), cell in zip(kinds, cells)])
    powers = [with_ends(*law[name]) for name in ("p", "q")]
    said = (f"Fitted to all cells by likelihood: {three(1e6 * law['C'])} mu^p n^q loops in a million, n contacts, with p = "
            f"{powers[0]} and q = {powers[1]}; deviance {three(law['deviance'])} at {law['freedom']} degrees of freedom. "
            "Where the deviance is above its degrees the law misses by more than chance, and the intervals of p and q are "
            "wider by the root of that.")
    return table(head, rows) + "\n\n" + prose(said) + "\n\n" + lower_bounds(cells)


def at_rest(program):
    return loops_by_law(program, "at-rest", 1_000_000)


def engine_steps(program):
    return loops_by_law(program, "engine-steps", 300_000)


# ---- What doubles miss ---------------------------------------------------------------------------------------

GENERATORS = ("integers", "psd", "small", "near-degenerate", "duplicates", "conditioned", "bodies", "exponential",
              "scenes")


def report_rows(program, store, name):
    """The rows of a CSV file of the report on a store."""
    folder = f"{store}.report"
    program.text("report", store, "-o", folder, shown=False)
    with open(f"{folder}/{name}", newline="") as file:
        return list(csv.DictReader(file))


def found_loops(program, store, kinds=("cycle", "stall", "safe-cycle")):
    """Of a store, with those that audits found."""
    return sum(int(row["count"]) for row in report_rows(program, store, "findings.csv") if row["kind"] in kinds)


def audited_loops(program, generator, contacts, problems):
    """All problems run exactly: loops, and of these those that doubles ended otherwise without being suspected."""
    with tempfile.TemporaryDirectory(dir=program.folder) as folder:
        summary = program.json("search", "--generator", generator, "--contacts", contacts, "--audit-every", 1,
                               "--enumerate-every", 1_000_000, "--problems", problems, "--store", f"{folder}/s",
                               shown=False)
        loops = found_loops(program, f"{folder}/s")
    seen = summary["failures"].get("cycle", 0) + summary["failures"].get("stall", 0)
    return summary["runs"], loops, loops - seen


def missed_by_doubles(program):
    problems = program.size(20_000)
    kinds = [(generator, contacts) for generator in GENERATORS for contacts in (2, 3, 4, 5)]
    cells = together(lambda *kind: audited_loops(program, *kind, problems), kinds)
    rows = [(f"`{generator}`", contacts, count(runs), loops, missed, share(missed, loops))
            for (generator, contacts), (runs, loops, missed) in zip(kinds, cells) if loops]
    total = [sum(cell[i] for cell in cells) for i in range(3)]
    rows.append(("all, with those without a loop", "2 to 5", count(total[0]), *total[1:], share(total[2], total[1])))
    program.show(f"./run search --generator GENERATOR --contacts CONTACTS --audit-every 1 --enumerate-every 1000000 "
                 f"--problems {problems} --store S")
    head = ["generator", "contacts", "problems, all run exactly", "loops", "missed by doubles", "share, 95 %"]
    return table(head, rows)


# ---- Existence -----------------------------------------------------------------------------------------------


def existence(program):
    """Every problem run exactly, every method held against the others, a sample of certificates checked apart."""
    store = program.folder / "audit.store"
    # The largest first, so that a small audit has them.
    said = program.script("tests/setup/audit.py", "--problems", program.size(270_000), "--contacts", 6, 5, 4, 3, 2, 1,
                          "--sample", 200, "--store", store)
    rows = []
    for row in report_rows(program, store, "agreement.csv"):
        counts = [count(int(row[key])) for key in ("problems", "solved", "compared", "enumerated", "disagreements")]
        shares = [share(int(row[key]), int(row["problems"])) for key in ("with_ties", "with_folds", "with_descents")]
        rows.append([row["contacts"], *counts, *shares])
    head = ["contacts", "run exactly", "solved by complete driving", "by Lemke's method too", "all modes tried",
            "disagreements", "with ties", "folds", "descents"]
    return table(head, rows) + "\n\n" + prose(said.strip().splitlines()[-1] + ".")


def in_campaign(program, name, *words):
    """The summary of a long search, whose store is kept: another call goes on where it stopped."""
    os.makedirs(ROOT / "build/campaigns", exist_ok=True)
    return program.json("search", *words, "--finishing", 0, "--store", f"build/campaigns/{name}.store")


def ten_billion(program):
    """10^10 problems over doubles, and 10^7 that are run exactly by every method."""
    doubles = in_campaign(program, "ten-billion", "search/campaigns/ten-billion.json",
                          "--problems", program.size(10_000_000_000))
    exact = in_campaign(program, "exact", "search/campaigns/audit.json", "--contacts", 1, 2, 3, "--seed", 1994,
                        "--problems", program.size(10_000_000))
    rows = [(label, row(doubles), row(exact)) for label, row in CAMPAIGN_ROWS]
    return table(["", "doubles, suspicions decided exactly", "everything exactly, by all methods"], rows) + "\n\n" + prose(
        "In brackets: exact intervals at 95 %. Loops and give-ups of the first column are lower bounds: those that "
        "doubles take for solutions are not among them.")


def per_million(kind):
    def cell(summary):
        number = summary["failures"].get(kind, 0)
        return f"{count(number)}: {rate(number, summary['runs'])} in a million"
    return cell


CAMPAIGN_ROWS = (
    ("problems", lambda summary: count(summary["problems"])),
    ("the published algorithm, policy `paper`, loops", per_million("cycle")),
    ("it finds no direction", per_million("singular")),
    ("given to complete driving; not solved by it, verified exactly",
     lambda summary: f"{count(summary['existence_checked'])}; " +
     misses(summary["existence_checked"] - summary["existence_solved"], summary["existence_checked"])),
    ("given to Lemke's method too; methods disagree",
     lambda summary: f"{count(summary['compared'])}; {misses(summary['disagreements_of_methods'], summary['compared'])}"),
    ("of these, all modes tried", lambda summary: count(summary["enumerated"])),
    ("run exactly without a suspicion of doubles; misjudged by them",
     lambda summary: f"{count(summary['audited'])}; {misses(summary['misjudged'], summary['audited'])}"),
    ("loops without a step of length zero", lambda summary: count(summary["loops_without_zero_steps"])),
    ("builds that worked on it", lambda summary: len(summary["builds"])),
    ("hours of one core", lambda summary: three(sum(summary["processor_seconds"].values()) / 3600)),
)


def misses(number, of):
    return f"{number}: {share(number, of)}"


def loops_of_safe_problems(program, problems, *words):
    """A search for a loop in a safe problem."""
    store = program.folder / "safe.store"
    summary = program.json("search", *words, "--problems", program.size(problems), "--store", store)
    decided, safe = summary["safety_decided"], summary["safe"]
    loops, grave = found_loops(program, store), found_loops(program, store, ("safe-cycle",))
    low_high = share(safe, decided)
    return table(["a search for a loop in a safe problem", ""],
                 [("problems, each under every policy asked for", count(summary["problems"])),
                  ("loops, confirmed exactly", count(loops)),
                  ("of these in safe problems", count(grave)),
                  ("audited runs, and those of safe problems", f"{count(decided)}, {count(safe)}: {low_high}")])


def safe_loops(program):
    return loops_of_safe_problems(program, 13_000_000, "--generator", "small", "duplicates", "near-degenerate",
                                  "integers", "--contacts", 2, 3, "--mu", "1/16", "1/8", "1/4",
                                  "--policy", "paper", "apex=suspended")


def safe_ties(program):
    return loops_of_safe_problems(program, 20_000_000, "search/campaigns/safe-ties.json")


# ---- Nights --------------------------------------------------------------------------------------------------


def night(program):
    """How the memory and the store of a search grow."""
    measured = json.loads(program.script("tests/setup/memory.py", "--minutes", 1, 5, 10, 20, 40, 90, "--json"))
    rows = [night_row(str(round(sample["minutes"])), sample) for sample in measured["samples"]]
    head = ["minutes", "million problems", "groups", "memory, MB", "at most", "store, MB"]
    return table(head, rows)


def night_row(minutes, sample):
    return (minutes, three(sample["problems"] / 1e6), count(round(sample["groups"])),
            *(three(sample[key] / 1e6) for key in ("resident", "most", "store")))


def page_times(program):
    """How fast the pages of a report open in Chromium."""
    measured = json.loads(program.script("tests/setup/page_times.py", "--json"))
    rows = [(f"`{one['page']}`", count(one["findings"]), three(one["bytes"] / 1e3),
             *(round(statistics.median(one[key])) for key in ("milliseconds", "processor"))) for one in measured]
    return table(["page", "findings", "kB", "opened after, ms", "of them of the processor, ms"], rows)


# ---- Many machines -------------------------------------------------------------------------------------------

PLAN = {"problems": 10**13, "nodes": 1000, "shards": 1000}


def scaling(program):
    """Merges of so many shards, at once and as a tree."""
    measured = json.loads(program.script("tests/setup/scaling.py", "--shards", 1, 10, 100, 1000, "--json"))
    rows = [(count(merge["shards"]), count(merge["units"]), three(merge["seconds"]), three(merge["memory"] / 1e6),
             three(merge["store"] / 1e6), three(merge["tree_seconds"]), three(merge["tree_path"]))
            for merge in measured["merges"]]
    head = ["shards", "units", "one merge, s", "memory, MB", "store, MB", f"tree of {measured['fan']}, s in all", "one path, s"]
    return table(head, rows)


def plan(program):
    """What 10^13 problems come to: groups and bytes of statistics by the power of two sizes, the rest in proportion."""
    small, large = (of_a_search(program, problems) for problems in (program.size(4_000_000) // 4, program.size(4_000_000)))
    power = math.log(large["groups"] / small["groups"]) / math.log(large["problems"] / small["problems"])

    def groups(problems):
        return large["groups"] * (problems / large["problems"]) ** power

    shard = PLAN["problems"] / PLAN["shards"]
    statistics = PLAN["shards"] * (large["frame"] + large["a signature"] * groups(shard))
    rows = [("problems a processor second, `night.json`", three(large["rate"])),
            ("all problems on one core of each node, hours", three(PLAN["problems"] / large["rate"] / PLAN["nodes"] / 3600)),
            ("groups, as a power of the problems", three(power)),
            ("groups in a shard; in all", f"{three(groups(shard))}; {three(groups(PLAN['problems']))}"),
            ("statistics, MB", three(statistics / 1e6)),
            ("a group's finding in the store, kB", three(large["a group"] / 1e3)),
            ("findings, MB", three(groups(PLAN["problems"]) * large["a group"] / 1e6)),
            ("finishing a group, s, of those finished first", three(large["finishing"])),
            ("finishing all of them on one core of each node, minutes",
             three(groups(PLAN["problems"]) * large["finishing"] / PLAN["nodes"] / 60))]
    return table([f"10^{round(math.log10(PLAN['problems']))} problems, {count(PLAN['nodes'])} nodes, {count(PLAN['shards'])} shards", ""], rows)


def of_a_search(program, problems):
    """What a search leaves: rates, and bytes of its rows."""
    store = program.folder / f"{problems}.store"
    summary = program.json("search", "search/campaigns/night.json", "--problems", problems, "--store", store)
    times, db = summary["processor_seconds"], sqlite3.connect(store)
    records = [json.loads(row[0]) for row in db.execute("SELECT record FROM units UNION ALL SELECT record FROM blocks")]
    largest = max(records, key=lambda record: len(json.dumps(record)))
    signatures = len(json.dumps(largest["signatures"]))
    size = sum(len(value) for row in db.execute("SELECT * FROM findings") for value in row if isinstance(value, str))
    db.close()
    groups, finished = sum(summary["groups"].values()), summary["finished"]
    return {"problems": summary["problems"], "groups": groups, "a group": size / groups,
            "rate": summary["problems"] / (sum(times.values()) - times["finishing"]),
            "finishing": times["finishing"] / max(1, finished), "frame": len(json.dumps(largest)) - signatures,
            "a signature": signatures / max(1, len(largest["signatures"]))}


# ---- Questions -----------------------------------------------------------------------------------------------


def measured_rows(name):
    """The cells of the tables of a measured file, without their heads and rules."""
    lines = (ROOT / f"reports/measured/{name}.md").read_text().splitlines()
    rules = {i for i, line in enumerate(lines) if line.startswith("| ---")}
    return [[cell.strip() for cell in line.strip("|").split("|")] for i, line in enumerate(lines)
            if line.startswith("| ") and i not in rules and i + 1 not in rules]


def number(cell):
    """The first number of a cell."""
    return int(re.match(r"[\d,]+", cell)[0].replace(",", ""))


def column(name, at):
    return [number(row[at]) for row in measured_rows(name)]


def tried_in_records(program):
    """Random problems beside the records, and how low the least of them are."""
    records = {row["frontier"]: row for row in program.json("records", shown=False)}
    for question, objective in (("steps", "steps"), ("periods", "period"), ("zero-runs", "zero-run"),
                                ("give-ups", "give-ups"), ("pieces", "pieces"), ("descents", "descents")):
        found = [records[name] for name in (f"{objective}-{n}-contacts" for n in range(2, 9)) if name in records]
        yield (question, "records by contacts", count(sum(row["random_evaluations"] for row in found)),
               "[frontiers](adversary/frontiers.md), 9")
    for question, names in (("low-friction", ("friction-gravity-3-contacts", "friction-gravity-4-contacts")),
                            ("one-body", ("friction-one-body-2-contacts",)),
                            ("condition", ("condition-mu-1-2-contacts",)),
                            ("condition-ties", ("condition-mu-1-3-contacts",))):
        found = [records[name] for name in names]
        values = (fractions.Fraction(row["value"]) for row in found)
        lowest = (str(value) if value.denominator < 1000 else f"{float(value):.6g}" for value in values)
        yield (question, f"the lowest: {', '.join(lowest)}", count(sum(row["random_evaluations"] for row in found)),
               "[records](../corpus/records)")


def questions(program):
    """What was tried of the questions that a search can answer, with counts of the measured files and the records."""
    def link(name):
        return f"[{name}](../reports/measured/{name}.md)"

    billion = {row[0]: row[1:] for row in measured_rows("ten-billion")}
    complete = billion["given to complete driving; not solved by it, verified exactly"]
    loops = billion["the published algorithm, policy `paper`, loops"]
    audited = column("existence", 1)
    drawn = sum(sum(column("sliding", at)) for at in (1, 2, 3, 4))
    with_solution = sum(column("sliding", 6))
    unsolved = sum(audited) - sum(column("existence", 2))
    rows = [("existence", f"not solved: {unsolved}", count(sum(audited)), link("existence")),
            ("complete-ends", f"not solved: {', '.join(count(number(cell.split('; ')[1])) for cell in complete)}",
             " and ".join(count(number(cell)) for cell in complete), link("ten-billion")),
            ("published-ends", f"loops: {count(number(loops[0]))}", billion["problems"][0], link("ten-billion")),
            ("scenes", f"loops: {sum(column('scenes-by-mu', 3))}", count(sum(column("scenes-by-mu", 2))), link("scenes-by-mu")),
            *((name, f"loops: {sum(column(name, 3))}", count(sum(column(name, 2))), link(name))
              for name in ("at-rest", "engine-steps")),
            ("space-solved", f"not solved: {sum(column('space-solved', 2)) - sum(column('space-solved', 3))}",
             count(sum(column("space-solved", 2))), link("space-solved")),
            ("sliding", f"loops past a solution: {with_solution}", count(drawn), link("sliding"))]
    for question, name in (("safe-ends", "safe-loops"), ("safe-two-end", "safe-ties")):
        cells = dict(measured_rows(name))
        rows.append((question, f"loops of safe problems: {cells['of these in safe problems']}",
                     next(value for what, value in cells.items() if what.startswith("problems")), link(name)))
    order = re.findall(r"(?m)^\| `([\w-]+)` \|.*\(campaigns/", (ROOT / "search/questions.md").read_text())
    rows = sorted([*rows, *tried_in_records(program)], key=lambda row: order.index(row[0]))
    return table(["id", "what came of it", "problems", "where"], [(f"`{name}`", *cells) for name, *cells in rows])


# ---- Solvers of others -------------------------------------------------------------------------------------------

FAILURES = ("crash", "hang", "leak", "not-finite", "silent-wrong", "refused-solvable")
PLANE, SPACE = ("-c", "2", "3"), ("-g", "space", "-c", "1", "2", "3")
# Libraries of bench/peers, and what they are given.
TESTED = (("ode", PLANE), ("ode-frictionless", PLANE), ("bullet-dantzig", PLANE), ("bullet-dantzig-frictionless", PLANE),
          ("bullet-lemke", PLANE), ("dart", PLANE), ("dart-frictionless", PLANE), ("siconos-lemke", PLANE),
          ("siconos-nsgs", PLANE), ("siconos-nsn-ac", SPACE), ("stiction", PLANE), ("stiction", SPACE))


def numbers_of(problem):
    """A, b and mu of a small problem; of larger numbers how many digits they have."""
    A = problem["A"]
    if not isinstance(A, list):
        A = [[x for *_, x in A["entries"]]]
    numbers = [x for row in [*A, problem["b"]] for x in row]
    digits = max(len(x.strip("-")) for x in numbers)
    if digits > 6 or len(numbers) > 42:
        return f"{len(problem['b'])} rows, numbers of up to {digits} digits"
    mu = ", ".join(contact["mu"] for contact in problem["contacts"] if "mu" in contact)
    written = "; ".join(" ".join(row) for row in A)
    return f"`A = {written}`, `b = {' '.join(problem['b'])}`" + (f", `mu = {mu}`" if mu else "")


def smallest_of(program, store, solver, told):
    """Of each kind the group with the smallest problem."""
    rows, kinds = [], set()
    for group in told["groups"]:
        facts, kind = group["facts"], group["kind"]
        if kind in kinds or "minimized" not in facts:
            continue
        kinds.add(kind)
        problem = json.loads(program.text("problem", store, group["signature"], "-o", "-", shown=False))
        scenes = [of["facts"]["scene"]["contacts"] for of in told["groups"] if of["kind"] == kind and "scene" in of["facts"]]
        what = facts["minimized"]["what"]
        rows.append((f"`{solver}`", f"`{kind}`" + (f", {what}" if what else ""), facts["minimized"]["contacts"],
                     numbers_of(problem), min(scenes) if scenes else "-"))
    return rows


def adversary_solvers(program):
    """The same problems for every solver that bench/peers makes a library of, and its findings, minimized."""
    rates, smallest = [], []
    os.makedirs(ROOT / "build/campaigns", exist_ok=True)
    for name, problems in TESTED:
        place = " in space" if problems is SPACE else ""
        store = f"build/campaigns/solver-{name}{place.replace(' ', '-')}.store"
        told = program.json("search", "--solver", f"build/release/peers/{name}.so", *problems, "--seed", 1994, "--problems",
                            program.size(1_000_000), "--finishing", 100, "--threads", 1, "--store", store)
        solver, counts = told["solver"], told["counts"]
        of = counts["problems"]
        failed = [counts[kind.replace("-", "_")] for kind in FAILURES]
        rates.append((f"`{name}`{place}", solver["version"], solver["law"], count(of), f"{100 * counts['passed'] / of:.2f}",
                      *(rate(number, of) if number else "0" for number in failed), count(counts["refused"]),
                      count(counts["unjudged"]), count(counts["misses_coulomb"]), count(counts["neither"])))
        smallest += smallest_of(program, store, name + place, told)
    head = ["solver", "version", "law", "problems", "passed, %", *(kind.replace("-", " ") for kind in FAILURES), "refused",
            "unjudged", "not Coulomb's", "neither"]
    return table(head, rates) + "\n\n" + prose(
        "Failures in a million problems, in brackets exact intervals at 95 %; the last four columns are counts: given up "
        "where no solution of the law is known, called solved where its bounds are not unique, right by its law but not "
        "by Coulomb's, and passed by the largest units but not solved by the strict ones. Problems are those of all ordinary generators, the same for every solver of the plane; of others 1e-6 "
        "is asked, of `stiction` 1e-8, which it states.") + "\n\n" + table(
        ["solver", "failure", "contacts", "the smallest problem of it", "contacts of the smallest scene"], smallest)
