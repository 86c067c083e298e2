# SPDX-License-Identifier: Apache-2.0
"""Figures of speed against accuracy: certified outcomes, rungs on generators and along dials, silent wrong answers."""

import collections
import csv

from markdown import count, prose, rate, table


def certified(program):
    return "\n\n".join((*program.study("ratios"), prose("Medians")))


def large_certificates(program):
    return "\n\n".join((*program.study("large-certificates"), prose("Processor time, one thread")))


def quartile(values):
    return f"{values[1]:.1f}" if values else ""


def ladder(program, *options):
    """Summed over families: rows of method and arithmetic."""
    lines = program.bench(*options)
    sums = collections.defaultdict(lambda: collections.Counter())
    medians, worst = collections.defaultdict(list), collections.defaultdict(float)
    double = {}
    for line in lines:
        if line["arithmetic"] == "double" and line["microseconds"]:
            double[line["family"], line["setting"], line["method"]] = line["microseconds"][1]
    for line in lines:
        key = line["method"], line["arithmetic"]
        for name in ("problems", "solved", "undecided", "other", "refused", "wrong", "silent"):
            sums[key][name] += line[name]
        unit = double.get((line["family"], line["setting"], line["method"]))
        if unit and line["microseconds"]:
            medians[key].append(line["microseconds"][1] / unit)
        if line["worst_residual"] is not None:
            worst[key] = max(worst[key], line["worst_residual"])
    rows = []
    for (method, arithmetic), s in sums.items():
        ratios = sorted(medians[method, arithmetic])
        ratio = f"{ratios[len(ratios) // 2]:.2f} ({ratios[0]:.2f} - {ratios[-1]:.2f})" if ratios else ""
        rows.append((f"`{method}`", arithmetic, ratio, count(s["solved"]), count(s["undecided"]), count(s["other"]),
                     count(s["wrong"]), count(s["silent"]), count(s["refused"]), f"{worst[method, arithmetic]:.0e}"))
    problems = max(s["problems"] for s in sums.values())
    return table(["method", "arithmetic", "time, times double", "solved", "undecided", "another end", "wrong end",
                  "silently wrong", "out of range", "worst residual"], rows) + "\n\n" + prose(
        f"{count(problems)} problems; times: median (least - most) of the medians of families")


def trade(program):
    return ladder(program, "trade")


def extremes(program):
    return ladder(program, "extremes")


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
