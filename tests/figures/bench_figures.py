# SPDX-License-Identifier: Apache-2.0
"""Figures of the benchmark: the methods side by side, readings in space, sliding contacts, timings."""

import collections
import json
import subprocess

from markdown import count, prose, rate, share, spread, table, three
from program import ROOT

PAPER = ("baraff", "paper", "exact")
EXACT = ("complete", "", "exact")
ONES, UNITS = ("lemke", "ones", "exact"), ("lemke", "units", "exact")


def methods(program, *options):
    return program.bench("methods", *options)


def runs_of(result):
    """contacts -> (method, reading, arithmetic) -> row."""
    by_contacts = collections.defaultdict(dict)
    for row in result["runs"]:
        by_contacts[row["contacts"]][row["method"], row["reading"], row["arithmetic"]] = row
    return by_contacts


def mean_most(row):
    return f"{three(row['mean'])} ({row['most']})"


def unsolved(row):
    return ", ".join(f"{number} {outcome}" for outcome, number in row["not solved"].items()) or "0"


def solved_by_all(result):
    """What each method solved, in words."""
    sums = collections.defaultdict(lambda: [0, 0, 0])
    for row in result["runs"]:
        key = f"`{row['method']}` {row['arithmetic']}" + (f" ({row['reading']})" if row["reading"] else "")
        sums[key] = [a + b for a, b in zip(sums[key], (row["solved"], row["problems"], row["wrong"]))]
    parts = [f"{key} {count(solved)} of {count(problems)}" for key, (solved, problems, _) in sums.items()]
    wrong = sum(wrong for _, _, wrong in sums.values())
    return prose(f"Solved: {'; '.join(parts)}. Wrong answers: {wrong}. Methods that contradict each other: "
                 f"{len(result['mismatches'])}.")


def work_table(result, bound, head):
    rows = []
    for contacts, row in sorted(runs_of(result).items()):
        paper = row[PAPER]
        loops = paper["not solved"].get("cycle", 0)
        rows.append((contacts, mean_most(row[EXACT]), count(bound(contacts)), mean_most(paper), unsolved(paper),
                     share(loops, paper["problems"]), mean_most(row[ONES]), mean_most(row[UNITS])))
    return table(["contacts", "pieces of `complete`", head, "steps of `baraff`, `paper`", "not solved",
                  "of these cycles, 95 %", "pivots of `lemke`, ones", "units"], rows) + "\n\n" + solved_by_all(result)


def work(program):
    result = methods(program, "--problems", program.size(1200))
    return work_table(result, lambda n: 4 ** n - 1, "bound 4^n - 1")


def near_worst_case(program):
    result = methods(program, "--generator", "exponential", "--contacts", 2, 4, 6, "--problems", program.size(400))
    return work_table(result, lambda n: 2 ** n - 1, "2^n - 1")


def folds(program):
    """Where complete driving folds and descends; folds against give-ups."""
    result = methods(program, "--problems", program.size(1200))

    def part(rows, key, head):
        return table([head, "problems", "folds, 95 %", "descents, 95 %"],
                     [(row[key], count(row["problems"]), share(row["folds"], row["problems"]),
                       share(row["descents"], row["problems"])) for row in rows])

    return "\n\n".join((part(result["folds"], "contacts", "contacts"), part(result["friction"], "mu", "mu"),
                         give_ups(result["give-ups"])))


def give_ups(policies):
    """Folds of complete driving against give-ups of the published algorithm."""
    ends = ("both", "folds only", "give-ups only", "neither")
    rows = [(f"`{row['policy']}`", *(count(row[key]) for key in ends),
             f"{count(row['as many steps'])} of {count(row['no folds, mu > 0'])}", three(row["pieces if folds"]),
             three(row["steps if folds"])) for row in policies]
    return table(["policy", *ends, "no folds, mu > 0: as many steps",
                  "mean steps where both solve a problem with folds: `complete`", "`baraff`"], rows)


def starts(program):
    result = methods(program, "--problems", program.size(1200))
    columns = ("1", "2", "3", "4 to 20", "none")
    rows = [(row["contacts"], row["problems"], *(row[key] for key in columns)) for row in result["starts"]]
    problems, first, none = (sum(row[key] for row in result["starts"]) for key in ("problems", "1", "none"))
    return table(["contacts", "problems", *columns], rows) + "\n\n" + prose(
        f"The first start is enough for {share(first, problems)}, no start for {share(none, problems)} (95 %).")


TIMED = (("complete", "", "double"), ("baraff", "paper", "double"), ("lemke", "units", "double"),
         EXACT, PAPER, UNITS, ("enumerate", "", "exact"), ("ipopt", "(17), (18)", "exact"))


def method_times(program):
    result = methods(program)
    cells = {(row["contacts"], row["method"], row["reading"], row["arithmetic"]): row for row in result["times"]}
    sizes = sorted({row["contacts"] for row in result["times"]})
    rows = []
    for key in TIMED:
        found = [cells.get((n, *key)) for n in sizes]
        last = found[-1]
        rows.append((f"`{key[0]}`, {key[2]}", *(spread(row["us"]) if row else "" for row in found),
                     spread(last["ratio"]) if last else ""))
    head = ["microseconds a problem", *(f"{n} contacts" for n in sizes), f"times `complete`, double, at {sizes[-1]}"]
    return table(head, rows) + "\n\n" + prose("Median (quartiles)")


def frictionless(program):
    result = program.bench("frictionless")
    timed = ("gauss us", "baraff us", "baraff/gauss", "lemke/baraff", "fast/baraff", "ipopt us", "ipopt/baraff",
             "qp/baraff")
    rows = [(row["contacts"], row["problems"], *(spread(row[key]) for key in timed)) for row in result["frictionless"]]
    names = ("baraff", "lemke", "fast", "ipopt", "qp")
    solved = "; ".join(f"`{name}` {count(sum(row[name + ' solved'] for row in result['frictionless']))}"
                       for name in names)
    problems = count(sum(row["problems"] for row in result["frictionless"]))
    return table(["contacts", "problems", "plain Gauss, microseconds", "`baraff`, microseconds", "`baraff` / Gauss",
                  "Lemke / `baraff`", "`fast` / `baraff`", "Ipopt, microseconds", "Ipopt / `baraff`",
                  "CGAL, exact / `baraff`"], rows) + "\n\n" + prose(
        f"Solved of {problems}: {solved}. Processor time of one thread, BLAS pinned to one; median (quartiles)")


# ---- Space, and contacts that slide --------------------------------------------------------------------------

SLIPS = {"paper": "literal", "slip=redirect": "redirect", "slip=polygon": "polygon"}


def space_row(first, row):
    loops = row["recurs"] + row["approaches"]
    slip = SLIPS[row["policy"]]
    return (first, slip, count(row["solved"]), f"{row['recurs']} + {row['approaches']}",
            share(loops, row["problems"]), row["proved loop"], row["refuted"], row["ray"], row["proved ray"],
            count(row["breaks (21)"]) if slip == "literal" else "",
            count(row["redirects"]) if slip == "redirect" else "",
            f"{three(row['steps, mean'])} ({row['most']})", count(row["unsure"]),
            f"{count(row['on an edge'])} ({count(row['refined'])})" if slip == "polygon" else "")


def space(program):
    result = program.bench("space", "--problems", program.size(20_000))
    head = ["`slip`", "solved", "loops", "share, 95 %", "loops proved", "left again", "rays", "rays proved", "breaks", "redirects",
            "steps, mean (most)", "unsure", "edges (corners)"]
    sizes = [space_row(f"{row['family']}, {row['contacts']}", row) for row in result["sizes"]]
    friction = [space_row(f"mu = {row['mu']}", row) for row in result["friction"] if row["policy"] in SLIPS]
    rest = sum(row[key] for row in result["sizes"] for key in ("limit", "singular", "undecided", "differ", "wrong"))
    problems = result["problems"]
    return "\n\n".join((
        prose(f"{count(problems)} problems of each family and number of contacts, and by friction, all sizes together. "
              f"Ended otherwise, wrong, or otherwise over intervals: {rest}."),
        table(["family, contacts", *head], sizes), table(["friction", *head], friction)))


def sliding(program):
    result = program.bench("sliding", "--generator", "integers", "--problems", program.size(1_000_000))
    rows = [(f"{row['contacts']}, {row['sliding']}", count(row["solved"]), count(row["ray"]), row["singular"],
             row["cycle"], rate(row["cycle"], result["problems"]), f"{row['with a solution']}, {row['without']}",
             row["every policy"]) for row in result["rows"]]
    return table(["contacts, sliding", "solved", "ray", "singular", "cycles", "in a million, 95 %",
                  "with a solution, without", "under every policy"], rows) + "\n\n" + prose(
        f"{count(result['problems'])} problems a row. Suspicions refuted exactly: "
        f"{sum(row['refuted'] for row in result['rows'])}. Cycles that doubles take for solutions are not counted.")


# ---- Timings -------------------------------------------------------------------------------------------------


def search_speed(program):
    result = program.bench("search")
    cells = {(row["generator"], row["contacts"]): row["problems a second"] for row in result["rates"]}
    sizes = sorted({row["contacts"] for row in result["rates"]})
    generators = sorted({row["generator"] for row in result["rates"]}, key=lambda name: -cells[name, sizes[0]][1])
    rates = table(["problems a second", *(f"{n} contacts" for n in sizes)],
                  [(f"`{name}`", *(spread(cells[name, n]) for n in sizes)) for name in generators])
    beside = table(["contacts", "beside", "wrong of it", "it solves a second", "`baraff` in a search solves a second",
                    "times as many", "whole search, problems a second"],
                   [(row["contacts"], row["peer"], f"{row['wrong of the peer']:,} of {row['problems']:,}",
                     spread(row["peer, problems a second"]), spread(row["solved a second"]),
                     spread(row["times as many"]), spread(row["whole search"])) for row in result["lemke"] if "problems" in row])
    return "\n\n".join((rates, mix_in_words(result), beside, prose(
        "Processor time of one thread, median (least - most) of 5 runs")))


def mix_in_words(result):
    """The default campaign, and two threads."""
    mix, threads = result["mix"][0], result["threads"]
    parts = ", ".join(f"{name} {three(100 * part)} %" for name, part in mix.items()
                      if part and name not in ("generators", "problems", "problems a second"))
    return prose(f"A campaign that names nothing: {three(mix['problems a second'])} problems a second of processor time "
                 f"({parts}). Two threads are {threads[1]['times one']:.2f} times as fast as one, with "
                 f"{threads[1]['processors busy']:.2f} processors at their disposal.")


def lanes(program):
    result = program.bench("search")
    sets = [name for name in result["lanes"][0] if name != "generator"]
    rates = table(["two contacts, problems a second", "one by one", *(f"lanes of {name}" for name in sets[1:]),
                   "times as many"],
                  [(f"`{row['generator']}`", *(spread(row[name]) for name in sets),
                    f"{row[sets[-1]][1] / row['none'][1]:.2f}") for row in result["lanes"]])
    roof = table(["of one problem of `integers`", "how many", "most a second", "allows problems a second",
                  "reached, problems a second", "of what it allows"],
                 [(row["what"], three(row["of a problem"]), three(row["most a second"]),
                   three(row["problems a second at most"]), three(row["problems a second"]),
                   f"{row['reached, %']:.0f} %") for row in result["roofline"]])
    return "\n\n".join((rates, roof, prose(f"{three(result['roofline'][0]['steps'])} steps a problem")))


def growth(program):
    parts = []
    for group in program.bench("growth")["tables"]:
        points = {(point["method"], point["contacts"]): point for point in group["points"]}
        sizes = sorted({point["contacts"] for point in group["points"]})
        rows = [growth_row(points, n) for n in sizes]
        power = "; ".join(f"`{method}` n^{exponent:.1f}" for method, exponent in group["exponents"].items()
                          if exponent)
        parts.append(table([group["name"].replace("growth-", "") + ", contacts n", "`published`: milliseconds",
                            "microseconds a step", "the same afresh", "drives a contact", "pivots a contact",
                            "megabytes", "`complete`: milliseconds", "`fast`: milliseconds", "megabytes"], rows)
                     + "\n\n" + prose(f"Time above 20 contacts like: {power}."))
    return "\n\n".join(parts) + "\n\n" + prose("One problem a size")


def growth_row(points, n):
    def cell(method, value):
        point = points.get((method, n))
        return three(value(point)) if point else "-"

    def milliseconds(point):
        return 1e3 * point["seconds"]

    def step(point):
        return 1e6 * point["seconds"] / max(1, point["counts"]["steps"])

    def megabytes(point):
        return point["bytes"] / 1e6

    return (n, cell("published", milliseconds), cell("published", step), cell("published-afresh", step),
            cell("published", lambda point: point["counts"]["drives"] / n),
            cell("published", lambda point: point["counts"]["pivots"] / n), cell("published", megabytes),
            cell("complete", milliseconds), cell("fast", milliseconds), cell("fast", megabytes))


def linear_algebra(program):
    result = program.bench("linear-algebra", "--problems", 20)
    ways = list(dict.fromkeys(row["way"] for row in result))
    cells = collections.defaultdict(dict)
    for row in result:
        cells[row["items"], row["size"]][row["way"]] = row["median"]
    rows = collections.defaultdict(list)
    for (items, size), row in cells.items():
        kind = tuple(way for way in ways if way in row)
        rows[kind].append((items, size, *(three(row[way]) for way in kind)))
    parts = [table(["microseconds", "size", *kind], sorted(lines)) for kind, lines in rows.items()]
    return "\n\n".join(parts) + "\n\n" + prose("Processor time, median of 5 runs")


def median_of(values):
    """Between the least and the most."""
    return spread([values[key] for key in ("least", "median", "most")])


def scene_speed_rows(result, first, second):
    rows = []
    for row in result:
        one, other = row[first], row[second]
        if "failure" in one or "failure" in other:  # has no forces, as its description says
            continue
        ways = [(median_of(way["frames_a_second"]), f"{way['rows']:.1f}", f"{way['problems']:.2f}")
                for way in (one, other)]
        rows.append((f"`{row['scene']}`", *ways[0], *ways[1], median_of(row["ratio"])))
    return rows


def scene_speed(program):
    parts = []
    for folder in ("corpus/scenes", "corpus/scenes/space", "corpus/scenes/large"):
        repeat = 3 if folder.endswith("large") else 9
        result = program.bench("scenes", "--scenes", folder, "--repeat", repeat)
        head = [f"`{folder}`", "minimal", "rows", "problems", "`--full`", "rows", "problems", "ratio"]
        parts.append(table(head, scene_speed_rows(result, "minimal", "full")))
    return "\n\n".join(parts) + "\n\n" + prose("Frames a second of one thread, median (least - most)")


def scene_threads(program):
    result = program.bench("scenes", "--repeat", 7, "--threads", 2)
    head = ["scene", "2 threads", "rows", "problems", "1 thread", "rows", "problems", "ratio"]
    return table(head, scene_speed_rows(result, "2 threads", "1 thread")) + "\n\n" + prose(
        "Frames a second, median (least - most)")


# ---- Beside other packages -----------------------------------------------------------------------------------


RANDOM = ("random", "--repeat", 1, "--problems", 160)
STRUCTURE = ("structure", "--repeat", 1, "--problems", 100, "--families")
SMALL = ("stack-10", "stack-10-masses", "stack-30-masses", "wall-6x5", "wall-6x5-masses", "channel-20-masses",
         "nearly-dependent", "generator-scenes", "card-house", "arch-stands", "stack-10-masses-smooth",
         "stack-30-masses-smooth", "wall-6x5-masses-smooth", "space-stack-5", "space-stack-10-masses", "space/stack")
LARGE = ("large/brick-wall", "large/brick-wall-in-space")


def peer_cell(cell, residuals):
    if not cell["installed"] or cell["capped"]:
        return "-"
    text = three(cell["ratio"]) + (f" @{cell['setting']}" if cell["setting"] else "")
    if residuals and cell.get("residual") is not None:
        text += f"; {cell['residual']:.0e}"
    if cell.get("wrong"):
        text += f"; {cell['wrong']}/{cell['silent']}/{cell['tried']}"
    return text


def installed(row):
    return any(cell["installed"] for cell in row["cells"])


def percent(part):
    return f"{100 * part:.0f} %"


def how_measured(result):
    """What a ratio is to, and on how many threads."""
    clocks, missing = result["clocks"], result["missing"]
    threads = " ".join(f"{key}={value}" for key, value in result["one_thread"]["variables"].items())
    left_out = f"; not installed: {', '.join(missing)}" if missing else ""
    return prose(
        f"Times / that of Eigen's LU of A, compiled for {result['lu']['instructions']}; the row `native` is the same "
        f"LU for {result['lu']['native']}. One thread ({threads}): processor time of all threads "
        f"{clocks['all_threads']:.0f} s, of the one that calls {clocks['one_thread']:.0f} s, wall-clock time "
        f"{clocks['wall']:.0f} s on a machine that others use{left_out}")


def ahead_text(peer):
    text = f"{peer['peer']} {three(peer['ratio'])} against {three(peer['our_ratio'])}"
    if peer["share"] != peer["our_share"]:
        text += f", solving {percent(peer['share'])} against {percent(peer['our_share'])}"
    return text


def ahead_of(group, ours, key):
    """Of the peers that are ahead of one of our rows, by column, the fastest."""
    best = {}
    for peer in group:
        if peer["ours"] == ours and (peer[key] not in best or peer["ratio"] < best[peer[key]]["ratio"]):
            best[peer[key]] = peer
    return [f"{column}: {ahead_text(peer)}" for column, peer in best.items()]


def peers(program):
    """Every row and size of the random problems."""
    parts = []
    result = program.bench(*RANDOM)
    for group in result["tables"]:
        residuals = "space" in group["title"] or "bodies" in group["title"]
        sizes = [cell["contacts"] for cell in group["rows"][0]["cells"]]
        lu = [three(1e6 * cell["seconds"][1]) for cell in group["rows"][0]["cells"]]
        rows = [("LU, microseconds", *lu)]
        rows += [(row["name"], *(peer_cell(cell, residuals) for cell in row["cells"])) for row in group["rows"][1:]
                 if installed(row)]
        title = group["title"][0].upper() + group["title"][1:]
        ahead = "; ".join(ahead_of(group["ahead"], "fast", "contacts"))
        parts.append(f"**{title}**\n\n" + table(["contacts", *sizes], rows) + "\n\n" + prose(
            f"Ahead of `fast`, by contacts, the fastest: {ahead}." if ahead else "No peer is ahead of `fast`."))
    return "\n\n".join(parts) + "\n\n" + how_measured(result)


def structure_cell(cell):
    """Ratio, residual, and what is solved where that is not all."""
    if cell["capped"]:
        return "-"
    text = three(cell["ratio"]) + (f" @{cell['setting']}" if cell["setting"] else "")
    if "share" in cell and not cell["name"].startswith("polygons"):
        text += f"; {cell['residual']:.0e}" if cell["residual"] is not None else "; no number"
        if cell["share"] < 1:
            text += f"; {percent(cell['share'])} of {cell['tried']}"
    return text


def structure_table(families):
    """Families of the same rows: a row each, a column for each method."""
    names = [cell["name"] for cell in families[0]["methods"] if cell["installed"] and cell["name"] != "Eigen LU"]
    rows = []
    for family in families:
        cells = {cell["name"]: cell for cell in family["methods"]}
        lu = three(1e6 * cells["Eigen LU"]["processor_seconds"][1])
        rows.append((family["title"], f"{family['rows']} of rank {family['rank']}", family["problems"], lu,
                     *(structure_cell(cells[name]) for name in names)))
    turned = list(zip(*rows))
    heads = ["rows", "problems", "LU, microseconds", *names]
    return table(["", *turned[0]], [(head, *line) for head, line in zip(heads, turned[1:])])


def spread_table(families):
    """Of `fast` and `auto`: quartiles and the 90 % quantile of the ratio, and processor time."""
    rows = []
    for family in families:
        cells = {cell["name"]: cell for cell in family["methods"]}
        for name in ("fast", "auto"):
            cell = cells[name]
            if not cell["capped"]:
                rows.append((family["title"], f"`{name}`", spread(cell["ratios"]), three(cell["ratio_90"]),
                             three(1e6 * cell["processor_seconds"][1]), f"{percent(cell['share'])} of {cell['tried']}"))
    return table(["problems", "", "time / LU", "90 %", "processor time, microseconds", "solved"], rows)


def families_text(program, names):
    result = program.bench(*STRUCTURE, *names)
    families = result["tables"][0]["families"]
    parts = []
    for title, dimension, friction in (("In the plane, with friction", 2, True), ("Without friction", 2, False),
                                       ("In space, Coulomb's law", 3, True)):
        chosen = [family for family in families if (family["dimension"], family["friction"]) == (dimension, friction)]
        if not chosen:
            continue
        ahead = [{**peer, "family": family["title"]} for family in chosen for peer in family["ahead"]]
        named = "; ".join(ahead_of(ahead, "auto", "family"))
        parts.append(f"**{title}**\n\n" + structure_table(chosen) + "\n\n" + prose(
            f"Ahead of `auto`, the fastest: {named}." if named else "No peer is ahead of `auto`."))
    return "\n\n".join(parts) + "\n\n" + spread_table(families) + "\n\n" + how_measured(result)


def structure(program):
    return families_text(program, SMALL)


def structure_large(program):
    return families_text(program, LARGE)


def peers_in_short(program):
    """`fast` and the packages, from the fewest to the most contacts."""
    rows = []
    for group in program.bench(*RANDOM)["tables"]:
        for row in group["rows"][1:]:
            cells = [cell for cell in row["cells"] if cell["installed"] and not cell["capped"]]
            if cells and (row["package"] or row["name"] == "fast"):
                ratios = [cell["ratio"] for cell in cells]
                wrong, tried = (sum(cell.get(key, 0) for cell in cells) for key in ("wrong", "tried"))
                rows.append((group["title"], f"{cells[0]['contacts']} to {cells[-1]['contacts']}", row["name"],
                             f"{three(ratios[0])} to {three(ratios[-1])}", three(max(ratios)),
                             f"{wrong} of {count(tried)}: {share(wrong, tried)}"))
    return table(["problems", "contacts", "", "time / LU, from fewest to most", "the most", "wrong, 95 %"], rows)


PATCHED = (("psd", 6_200_000), ("integers", 6_200_000), ("bodies", 6_200_000), ("scenes", 6_200_000),
           ("conditioned", 200_000))  # 10^8 of four sizes; runs over rationals take their time with the last


def patches(program):
    """Failures in a million problems of each way to change the published algorithm, by generator and size."""
    ways = ("first", "previous", "second", "fold", "lemke", "complete")
    rows = []
    for generator, problems in PATCHED:
        result = program.bench("patches", "--generator", generator, "--problems", program.size(problems))
        rows += [(f"`{row['generator']}`", row["contacts"], count(row["problems"]), row["gives up"],
                  *(row[way] for way in ways)) for row in result["rows"]]
    return table(["generator", "contacts", "problems", "give up", "`give-up=first`", "`previous`", "`second`",
                  "fold", "Lemke at a give-up", "`complete`"], rows)


def smallest(program):
    result = program.bench("smallest", "--entries", 3, "--exact")
    return table(["entries at most", "matrices", "problems", "loops of `paper`", "no force direction", "none of these, nor solved", "the smallest loop", "the smallest under every policy"],
                 [(row["K"], count(row["matrices"]), count(row["problems"]), count(row["loops of paper"]), count(row["singular"]), count(row["neither"]), row["smallest"],
                   row["under every policy"]) for row in result["rows"]])


OPTIMIZERS = ("evolution", "nlopt", "continuation")
SEEDS = (201, 202, 203)


def gain(cell):
    return float("inf") if cell == "inf" else 0 if cell == "-" else cell


def gain_text(cell):
    return cell if isinstance(cell, str) else f"{cell:.3g}"


def adversary(program):
    """The optimizers beside random problems, with seeds that nothing was tuned on."""
    results = [{row["objective"]: row for row in program.bench("adversary", "--seed", seed)} for seed in SEEDS]
    rows = [(name, row["problems"], count(row["evaluations"]),
             *(", ".join(gain_text(result[name][f"{optimizer} gain"]) for result in results) for optimizer in OPTIMIZERS))
            for name, row in results[0].items()]

    def doubled(optimizers):
        return ", ".join(str(sum(max(gain(row[f"{one} gain"]) for one in optimizers) >= 2 for row in result.values()))
                         for result in results)

    return "\n\n".join((
        table(["objective", "problems", "evaluations", *(f"gain of {optimizer}" for optimizer in OPTIMIZERS)], rows),
        prose(f"Of {len(rows)} objectives, by seed, at least twice as bad as random problems: {doubled(OPTIMIZERS[:1])} by "
              f"evolution, {doubled(OPTIMIZERS[1:2])} by NLopt, {doubled(OPTIMIZERS[2:])} by continuation, "
              f"{doubled(OPTIMIZERS[:2])} by evolution or NLopt, {doubled(OPTIMIZERS)} by any.")))


def gate_sums(cells, keys):
    sums = collections.defaultdict(collections.Counter)
    for cell in cells:
        sums[tuple(cell[key] for key in keys)].update({name: cell[name] for name in (
            "runs", "solved", "wrong", "undecided")})
    return sums


def gate_table(cells, before, keys):
    """Today's runs, and what they were called, each after what cceb0e3 called the same."""
    then, now = gate_sums(before, keys), gate_sums(cells, keys)
    rows = []
    for key, s in now.items():
        pairs = []
        for name in ("solved", "wrong", "undecided"):
            shares = [f"{100 * sums[key][name] / sums[key]['runs']:.1f}" if sums[key]["runs"] else "-"
                      for sums in (then, now)]
            pairs += [count(then[key]["wrong"]), count(s["wrong"])] if name == "wrong" else shares
        rows.append((*(f"`{name}`" for name in key), count(s["runs"]), *pairs))
    columns = ["runs", "solved then, %", "now, %", "wrong then", "now", "undecided then, %", "now, %"]
    return table([*keys, *columns], rows)


def gate(program):
    """What is called solved over inexact numbers, by dial and by method and arithmetic, plane and space apart; before
    there was one gate, and now."""
    words = ("--problems", program.size(60), "--seed", 6)
    cells = program.bench("gate", *words)["cells"]
    script = "bench/gate_before.sh"
    program.show(f"{script} build/gate-before {' '.join(map(str, words))}")
    done = subprocess.run([ROOT / script, ROOT / "build/gate-before", *map(str, words), "--json"], text=True,
                          stdout=subprocess.PIPE)
    before = json.loads(done.stdout)["cells"]  # exit 1: some are wrong
    parts = [gate_table(cells, before, ["dial"])]
    for dimension, where in ((2, "plane"), (3, "space")):
        chosen, then = ([cell for cell in some if cell["dimension"] == dimension] for some in (cells, before))
        parts.append(f"**In {'the ' if dimension == 2 else ''}{where}**\n\n"
                     + gate_table(chosen, then, ["method", "arithmetic"]))
    solved, wrong = (sum(cell[key] for cell in cells) for key in ("solved", "wrong"))
    return "\n\n".join(parts) + "\n\n" + prose(
        f"Of {count(solved)} answers called solved now {wrong} are wrong; a million have, 95 %: {rate(wrong, solved)}.")
