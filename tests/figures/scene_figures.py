# SPDX-License-Identifier: Apache-2.0
"""Figures of simulations, and of the problems that others published."""

import csv
import os
import re

from markdown import count, prose, share, table, three
from program import ROOT


def simulate(program, scene, *options):
    """The counters that a simulation prints, name -> number, its worst overlap and drift, and its folder."""
    folder = program.folder / "run"
    said = program.text("simulate", f"corpus/scenes/{scene}.json", *options, "-o", folder, "--no-svg", "--replace")
    counters = {name: int(number) for name, number in re.findall(r"^(\w+) +(\d+)  ", said, re.M)}
    drift, overlap = map(float, re.search(r"worst drift of joints (\S+), overlap (\S+) m", said).groups())
    return counters, drift, overlap, folder


def energies(folder):
    """Columns of energy.csv."""
    with open(folder / "energy.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return {key: [row[key] for row in rows] for key in rows[0]}


def energy(program):
    rows = []
    for scene, options in (("space/slider-crank", ()), ("double-pendulum", ()),
                           ("double-pendulum", ("--step", 0.0166667))):
        counters, drift, _, folder = simulate(program, scene, "--seconds", 100, *options)
        total, kinetic = energies(folder)["total_J"], energies(folder)["kinetic_J"]
        values = (total[0], min(total), max(total), total[-1], max(kinetic))
        rows.append((f"`{scene}`", counters["frames"], *(f"{value:.2f}" for value in values), f"{drift:.0e}"))
    return table(["scene, 100 s", "steps", "energy at first, J", "least", "most", "at last", "most kinetic",
                  "joints come apart by, m"], rows)


def simulation_tables(program):
    """The columns of the tables of a simulation, as the program describes them, of the plane and of space."""
    columns = {}  # (table, column) -> (unit, meaning, scenes)
    for kind, scene in (("the plane", "stack"), ("space", "space/stack")):
        _, _, _, folder = simulate(program, scene, "--seconds", 0.1)
        with open(folder / "columns.csv", newline="") as file:
            for row in csv.DictReader(file):
                kinds = columns.setdefault((row["table"], row["column"], row["unit"], row["meaning"]), [])
                kinds.append(kind)
    order = list(dict.fromkeys(name for name, *_ in columns))
    rows = [(f"`{name}`", f"`{column}`", unit, "" if len(kinds) == 2 else kinds[0], meaning)
            for (name, column, unit, meaning), kinds in sorted(columns.items(), key=lambda item: order.index(item[0][0]))]
    return table(["table", "column", "unit", "only in", "what"], rows)


def halved_steps(program):
    """Steps that left overlap and were done in halves; problems that are hard to solve."""
    rows = []
    for scene, options in (("space/falling-bodies", ("--step", 0.0166667)), ("space/falling-bodies", ()),
                           ("block-feeder", ()), ("double-action-jack", ())):
        counters, _, overlap, _ = simulate(program, scene, *options)
        rows.append((f"`{scene}`" + (f", `--step {options[1]}`" if options else ""), *(
            count(counters[key]) for key in ("frames", "halved", "deep", "problems", "sparse", "fallbacks", "loose")),
            f"{1000 * overlap:.2g}"))
    return table(["scene", "frames", "halved steps", "deep", "problems", "solved without A",
                  "by complete driving", "to 1e-5 only", "worst overlap, mm"], rows)


def unsolved_in_scenes(program):
    """What scene_statistics.py prints, without the seconds; scenes whose problems are all solved in one row."""
    said = program.script("tests/setup/scene_statistics.py")
    lines = [line for line in said.splitlines() if line.startswith("|")]
    rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in lines[2:]]
    total = [row for row in rows if row[0] == "all"]
    failing = [row for row in rows if row not in total and row[3] != "-"]
    smooth = [row for row in rows if row not in total and row[3] == "-"]
    solved = sum(int(row[1].replace(",", "")) for row in smooth)
    others = [f"the other {len(smooth)}", count(solved), "all solved", "-", "all solved"]
    return table(["scene", "problems", "`baraff`, doubles", "over rationals, those not solved",
                  "complete driving, or others behind it"], [*(row[:5] for row in failing), others, total[0][:5]])


# ---- Problems that others published --------------------------------------------------------------------------


def curvature(entry):
    """What is known of the smallest eigenvalue."""
    c = entry["curvature"]
    if c.get("psd") is True:
        return "yes"
    if c.get("psd") is False:
        ends = [f"{c[key]:.0e}" for key in ("least", "most") if c.get(key) is not None]
        return "no: " + " to ".join(dict.fromkeys(ends))
    return f">= {c['least']:.0e}" if c.get("least") is not None else "undecided"


def in_range(entry):
    r = entry["range"]
    if r.get("regular"):
        return "regular"
    return {True: "yes, A singular", False: "no"}.get(r.get("in-range"), "undecided")


def solvers(runs):
    """The runs that solved, but for the published algorithm: method, arithmetic, certificate or residual."""
    parts = []
    for run in runs:
        if run["outcome"] == "solved" and run["method"] != "baraff":
            proof = f"`{run['certificate']}`" if run.get("certificate") else f"{run['residual']:.0e}"
            parts.append(f"{run['method']}, {run['arithmetic']}: {proof}")
    return "; ".join(parts) or "none"


def published_problems(program):
    data = os.environ.get("STICTION_DATA")
    if not data:
        raise SystemExit("published-problems: STICTION_DATA names no folder")
    program.show("./run survey $STICTION_DATA")
    rows = []
    for entry in program.json("survey", data, shown=False, codes=(0, 1, 3)):
        name = os.path.basename(entry["file"])
        space = " in 3D" if entry["dimension"] == 3 else ""
        rough = entry["range"].get("rough distance")
        rows.append((f"`{name}`", f"{count(entry['contacts'])}{space}", f"{entry['asymmetry'].get('relative', 0):.0e}",
                     curvature(entry), in_range(entry), "" if rough is None else f"{rough:.0e}",
                     "yes" if entry["meets assumptions"] else
                     "(A + A')/2" if entry.get("symmetrized", {}).get("meets assumptions") else "no",
                     solvers(entry["runs"])))
    return table(["file", "contacts", "A - A'", "A psd", "b in range(A)", "rough", "the paper's assumptions",
                  "solved by"], sorted(rows))


def tolerance(program):
    """Scenes with every dimension a little off: how many of them still loop."""
    draws, rows = program.size(1000), []
    for percent in (1, 5, 10):
        said = program.script("tests/setup/tolerance.py", "corpus/scenes/weight-on-two-pegs.json", "--percent", percent,
                              "--draws", draws)
        loops = int(dict(end.split()[::-1] for end in said.strip().split(": ")[2].split(", ")).get("cycle", 0))
        rows.append((f"{percent} %", count(draws), count(loops), share(loops, draws)))
    return table(["off by up to", "scenes", "loop", "share, 95 %"], rows)
