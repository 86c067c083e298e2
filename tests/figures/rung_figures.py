# SPDX-License-Identifier: Apache-2.0
"""Figures of speed against accuracy: certified outcomes, rungs on generators and along dials, silent wrong answers."""

import collections
import csv

from markdown import count, prose, rate, table


def certified(program):
    return "\n\n".join((*program.study("ratios"), prose("Medians")))


def large_certificates(program):
    return "\n\n".join((*program.study("large-certificates"), prose("Processor time, one thread")))


def trade(program):
    return "\n\n".join(program.study("trade"))


def extremes(program):
    return "\n\n".join(program.study("extremes"))


def silent(program):
    cells = program.bench("silent", "--problems", program.size(10_000_000), "--seed", 6, "--threads", 2)["cells"]
    rows = []
    for cell in cells:
        other = cell["runs"] - cell["solved"] - cell["undecided"]
        rows.append((f"`{cell['method']} {cell['arithmetic']}`", count(cell["runs"]), count(cell["solved"]),
                     count(cell["undecided"]), count(other), count(cell["wrong"]), rate(cell["wrong"], cell["runs"])))
    return table(["method and arithmetic", "problems", "solved", "undecided", "another end", "silently wrong",
                  "in a million, 95 %"], rows)


def same_tables(program):
    """The tables of a search over filtered numbers, every problem audited, and of one over rationals."""
    problems, tables = program.size(1_000_000), {}
    for arithmetic in ("filtered", "exact"):
        store, report = program.folder / f"{arithmetic}.db", program.folder / arithmetic
        program.text("search", "--arithmetic", arithmetic, "--audit-every", 1, "--problems", problems,
                     "--finishing", 0, "--store", store)  # what is finished depends on time
        program.text("report", store, "-o", report)
        tables[arithmetic] = {file.name: [[cell.replace("filtered", "exact") for cell in row]
                                          for row in csv.reader(file.open())] for file in report.glob("*.csv")}
    assert tables["filtered"].keys() == tables["exact"].keys() and tables["exact"]
    same = [name for name in sorted(tables["exact"]) if tables["filtered"][name] == tables["exact"][name]]
    differ = sorted(set(tables["exact"]) - set(same))
    return prose(f"{count(problems)} problems each. The same to the last number, but for the name of the arithmetic: "
                 f"{', '.join(f'`{name}`' for name in same) or 'none'}; different: "
                 f"{', '.join(f'`{name}`' for name in differ) or 'none'}.")


def peers_extremes(program):
    result = program.bench("peers-extremes", "--problems", 40)
    parts = []
    for block in result["tables"]:
        sums = collections.defaultdict(collections.Counter)
        for line in block["lines"]:
            if not line["installed"]:
                continue
            for name in ("tried", "solved", "silent", "refused", "crashed"):
                sums[line["name"]][name] += line[name]
        rows = [(f"`{name}`", *(count(s[column]) for column in ("tried", "solved", "silent", "refused", "crashed")))
                for name, s in sums.items()]
        parts.append(table(["with friction" if block["name"] == "extremes" else "without friction", "problems", "solved",
                            "silently wrong", "called failures", "crashed, or no answer in time"], rows))
    return "\n\n".join(parts) + "\n\n" + prose("Judged over rationals, residual at most 1e-6")
