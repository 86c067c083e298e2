# SPDX-License-Identifier: Apache-2.0
"""Speed against accuracy: every method over every arithmetic on problems of the generators, and what the answers are worth.

A time is that of a call on numbers in memory, the least of three. Answers are judged over rationals, on the problem that
the arithmetic was given: rounded to float, to double for wider numbers, as it is for filtered and exact. Beside double
stand remedies that others use: `scaled` brings the diagonal of each contact near one, `regularized` adds a part in 10^10
of the largest diagonal entry of A.

    silently wrong  called solved within a residual that it does not have, or that no solution exists where one does
    wrong end       that, or the published algorithm ends otherwise than over rationals, and is not undecided
    out of range    a number of the problem is not one of the arithmetic's

The table is the sum over all families; --csv FILE has the lines of each at each setting, with intervals, for `stiction
report --bench`, --json the same. Exit 1 where an answer is silently wrong."""

import collections
import csv
import json
import subprocess
import sys

import numpy as np

import stiction
import study

METHODS = ("complete", "lemke", "fast", "baraff")
GIVEN = {"float": "float", "filtered": "exact", "exact": "exact"}  # all others: double
RUNGS = ("double", "double-double", "exact")
COUNTS = ("solved", "undecided", "other", "wrong", "silent", "refused")


def sources(o, *words):
    """Families at their settings, and problems of each (`stiction-bench --suite problems`)."""
    command = [study.PROGRAM + "-bench", "--suite", "problems", "--problems", o.problems, "--seed", o.seed, *words]
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE) as program:
        for text in program.stdout:
            source = json.loads(text)
            study.say(f"{source['family']} at {source['setting']}")
            yield source
    study.say()
    if program.returncode:
        sys.exit(program.returncode)


def rows():
    """Method, arithmetic, remedy."""
    built = {method["name"]: method["plane"] for method in stiction.methods()}
    for method in METHODS:
        for arithmetic in built[method]:
            for remedy in ("", "scaled", "regularized") if arithmetic == "double" else ("",):
                if arithmetic != "interval":
                    yield method, arithmetic, remedy


def rounded(problems, given):
    """Those whose numbers the arithmetic holds."""
    for problem in problems:
        try:
            yield problem if given == "exact" else problem.rounded(given)
        except ValueError:
            pass


def altered(problem, remedy):
    A, b = problem.A, problem.b
    if remedy == "":
        return problem
    if remedy == "regularized":
        A = A + 1e-10 * A.diagonal().max() * np.eye(len(b))
    else:  # a power of two for all rows of a contact, so that mu stays
        sizes = [2 if kind == "static" else 1 for kind in problem.kinds]
        most = np.maximum.reduceat(A.diagonal(), np.cumsum([0, *sizes[:-1]]))
        scale = np.repeat(np.where(most > 0, np.ldexp(1.0, -np.frexp(most)[1] // 2), 1), sizes)
        A, b = scale[:, None] * A * scale, scale * b
    return stiction.Problem(A, b, problem.mu, problem.kinds)


def line_of(source, row, given, published):
    """Of one row: its counts, times and residuals. published: how the algorithm ends over rationals on what is given."""
    method, arithmetic, remedy = row
    asked = [altered(problem, remedy) for problem in given]
    judge = given if remedy == "regularized" else asked  # errors are the same in the units of each contact
    run = study.solved(asked, method, arithmetic, judge=judge)
    outcome, residual, seconds = run["outcome"], run["residual"], run["seconds"]
    is_exact = (arithmetic == "exact") | (run.get("decided_on", "") == "exact")
    bound = np.where(is_exact, 0, 1e-5 if arithmetic == "float" else 1e-8)
    solved = outcome == "solved"
    if remedy:
        solved &= residual <= bound
    is_open = np.isin(outcome, ("undecided", "limit")) | (outcome == "solved") & ~solved
    silent = solved & ~(residual <= bound * (1 + 1e-9)) | (outcome == "no-solution") & source["has_solution"]
    wrong = silent | ((method == "baraff") & ~is_open & (outcome != published))
    counts = {name: int(of.sum()) for name, of in (("solved", solved), ("undecided", is_open),
                                                   ("other", ~solved & ~is_open), ("wrong", wrong), ("silent", silent))}
    problems = len(source["problems"])
    line = {"family": source["family"], "setting": source["setting"], "method": method,
            "arithmetic": f"{arithmetic} {remedy}".strip(), "problems": problems, **counts,
            "refused": problems - len(given), "microseconds": study.quartiles(seconds, 1e6),
            "residual": study.quartiles(residual[solved]), "worst_residual": max(residual[solved], default=None),
            "decided_on": [int((run.get("decided_on") == rung).sum()) if "decided_on" in run else 0 for rung in RUNGS]}
    for name in ("wrong", "silent"):
        line[f"{name}_share"] = stiction.interval(counts[name], len(given)) if given else (0, 1)
    return line


def measured(source, some=None):
    """A line for each row, of some or of all."""
    problems = [stiction._problem.parsed(json.dumps(problem), source["family"]) for problem in source["problems"]]
    given = {name: list(rounded(problems, name)) for name in ("float", "double", "exact")}
    published = {name: stiction.solve_all(of, "baraff", "exact")["outcome"] for name, of in given.items()}
    for row in some or rows():
        name = GIVEN.get(row[1], "double")
        yield line_of(source, row, given[name], published[name])


def flat(line):
    """As columns of a file: name_low, name_median, name_high."""
    for name, value in line.items():
        if name in ("microseconds", "residual"):
            yield from zip((f"{name}_{end}" for end in ("low", "median", "high")), value or [None] * 3)
        elif name.endswith("_share"):
            yield from zip((f"{name}_{end}" for end in ("low", "high")), value)
        elif name == "decided_on":
            yield from zip((f"{name}_{rung}" for rung in RUNGS), value)
        else:
            yield name, value


def sums(lines):
    """A row for each method and arithmetic; times by those of double in the same family."""
    double = {(line["family"], line["setting"], line["method"]): line["microseconds"] for line in lines
              if line["arithmetic"] == "double"}
    by = collections.defaultdict(list)
    for line in lines:
        by[line["method"], line["arithmetic"]].append(line)
    for (method, arithmetic), of in by.items():
        ratios = sorted(line["microseconds"][1] / unit[1] for line in of if line["microseconds"]
                        and (unit := double[line["family"], line["setting"], method]))
        yield (f"`{method}`", arithmetic, [ratios[0], ratios[len(ratios) // 2], ratios[-1]] if ratios else None,
               *(sum(line[name] for line in of) for name in COUNTS),
               f"{max((line['worst_residual'] or 0 for line in of), default=0):.0e}")


def tell(o, sources_of):
    lines = [line for source in sources_of for line in measured(source)]
    if o.csv:
        with open(o.csv, "w", encoding="utf-8", newline="") as file:
            table = csv.DictWriter(file, dict(flat(lines[0])), lineterminator="\n")
            table.writeheader()
            table.writerows(dict(flat(line)) for line in lines)
    silent = sum(line["silent"] for line in lines)
    if o.json:
        print(json.dumps(lines))
    else:
        study.show(["method", "arithmetic", "time, times double: median (least - most) of families", "solved", "undecided",
                    "another end", "wrong end", "silently wrong", "out of range", "worst residual"], sums(lines))
        print(f"Silently wrong: {silent}")
    sys.exit(silent > 0)


def main():
    o = study.options(__doc__, contacts=[2, 4, 8], problems=60, seed=1, csv="", json=False)
    tell(o, sources(o, "--contacts", *o.contacts))


if __name__ == "__main__":
    study.run(main)
