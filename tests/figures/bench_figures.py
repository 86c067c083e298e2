# SPDX-License-Identifier: Apache-2.0
"""Figures of the benchmark: the methods side by side, studies, timings, other packages."""

import collections

from markdown import count, prose, rate, share, spread, table, three


def work_blocks(program):
    return program.study("work", "--problems", program.size(1200))


def work(program):
    blocks = work_blocks(program)
    return "\n\n".join((blocks[0], blocks[-1]))


def near_worst_case(program):
    blocks = program.study("work", "--generator", "exponential", "--contacts", 2, 4, 6, "--problems", program.size(400))
    return "\n\n".join((blocks[0], blocks[-1]))


def folds(program):
    return "\n\n".join(work_blocks(program)[1:3])


def starts(program):
    return work_blocks(program)[3]


# ---- Studies -------------------------------------------------------------------------------------------------


def study(name, *words):
    """A block that is what a study prints."""
    return lambda program: "\n\n".join(program.study(name, *words))


method_times = study("methods")
frictionless = study("frictionless")
smallest = study("smallest", "--entries", 3)
linear_algebra = study("linear-algebra")
impacts = study("impacts")
motion = study("motion")
many = study("many")


def space(program):
    return "\n\n".join(program.study("space", "--problems", program.size(20_000)))


def space_loops(program):
    """With seeds that nothing was tuned on."""
    return "\n\n".join(program.study("space-loops", "--seeds", 31, 32, 33, 34, "--problems", program.size(20_000)))


def space_solved(program):
    """With a seed that nothing was tuned on."""
    return "\n\n".join(program.study("space-solved", "--seeds", 11, "--problems", program.size(1000)))


def sliding(program):
    return "\n\n".join(program.study("sliding", "--generator", "integers", "--problems", program.size(300_000)))


def patches(program):
    return "\n\n".join(program.study("patches", "--problems", program.size(100_000)))


def adversary(program):
    """With seeds that nothing was tuned on."""
    return "\n\n".join(f"Seed {seed}:\n\n" + "\n\n".join(program.study("adversary", "--seed", seed))
                       for seed in (201, 202, 203))


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
                     spread(row["times as many"]), spread(row["whole search"])) for row in program.bench("lemke")["tables"][0]["rows"]
                    if "problems" in row])
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


def search_rate(program):
    """The default campaign, two threads, and what a unit takes of the store."""
    result = program.bench("search", "--contacts", 2, "--repeat", 1)
    store = result["store"][0]
    return mix_in_words(result) + "\n\n" + prose(
        f"A unit takes {three(store['a unit'])} ms of processor time, and of these it has the store to itself for "
        f"{three(store['with the store, mean'])} ms in the mean, {three(store['median'])} ms in the median, "
        f"{three(store['most, a block closed'])} ms where it closes a block: one store keeps "
        f"{store['cores that it keeps busy']:.0f} cores busy.")


def lanes(program):
    result = program.bench("search")
    sets = [name for name in result["lanes"][0] if name not in ("generator", "contacts")]
    rates = table(["problems a second", "contacts", "one by one", *(f"lanes of {name}" for name in sets[1:]),
                   "times as many"],
                  [(f"`{row['generator']}`", row["contacts"], *(spread(row[name]) for name in sets),
                    f"{row[sets[-1]][1] / row['none'][1]:.2f}") for row in result["lanes"]])
    roof = table(["of one problem of `integers`", "how many", "most a second", "allows problems a second",
                  "reached, problems a second", "of what it allows"],
                 [(row["what"], three(row["of a problem"]), three(row["most a second"]),
                   three(row["problems a second at most"]), three(row["problems a second"]),
                   f"{row['reached, %']:.0f} %") for row in result["roofline"]])
    return "\n\n".join((rates, roof, prose(f"{three(result['roofline'][0]['steps'])} steps a problem")))


def growth(program):
    parts, walls = [], []
    for group in program.bench("growth")["tables"]:
        if "walls" in group["name"]:
            walls += walls_rows(group)
            continue
        points = {(point["method"], point["contacts"]): point for point in group["points"]}
        sizes = sorted({point["contacts"] for point in group["points"]})
        rows = [growth_row(points, n) for n in sizes]
        power = "; ".join(f"`{method}` n^{exponent:.1f}" for method, exponent in group["exponents"].items()
                          if exponent)
        parts.append(table([group["name"].replace("growth-", "") + ", contacts n", "`published`: milliseconds",
                            "microseconds a step", "the same afresh", "drives a contact", "pivots a contact",
                            "megabytes", "`complete`: milliseconds", "`fast`: milliseconds", "megabytes"], rows)
                     + "\n\n" + prose(f"Time above 20 contacts like: {power}."))
    head = ["square walls in factors, `newton-bodies`, contacts", "velocities", "milliseconds", "megabytes",
            "factorizations", ""]
    return "\n\n".join(parts) + "\n\n" + table(head, walls) + "\n\n" + prose("One problem a size")


def walls_rows(group):
    where = " in space" if group["name"].endswith("space") else ""
    return [(f"{point['contacts']:,}{where}", f"{point['velocities']:,}", three(1e3 * point["seconds"]),
             three(point["bytes"] / 1e6), point["counts"]["factorizations"], "" if point["solved"] else "not solved")
            for point in group["points"]]


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
                             three(1e6 * cell["processor_seconds"][1]), f"{percent(cell['share'])} of {cell['tried']}",
                             ", ".join(f"{count} `{method}`" for method, count in cell.get("answered by", {}).items())))
    return table(["problems", "", "time / LU", "90 %", "processor time, microseconds", "solved", "answered by"], rows)


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


def engine_cell(row):
    """Frames a second, unless it falls, and how far a body moved that should rest."""
    if row is None:
        return ""
    moved = f"; {row['end']}, {row['moved']:.1g} m" if row["moved"] is not None and row["end"] != "falls" else ""
    return "falls" if row["end"] == "falls" else three(row["frames a second"]) + moved


def worst_cell(row):
    return "" if row is None or row["end"] == "falls" else three(row["worst frame"])


def drift_cell(row):
    if row is None or row["end"] == "falls":
        return ""
    drift = "" if row["drift"] is None else f"{row['drift']:.1g} m/s; "
    return f"{drift}{row['overlap']:.1g} m"


def engines(program):
    """Frames a second of each engine on each scene, and who stands; then drift and overlap."""
    result = program.bench("engines")
    scenes = result["tables"][0]["scenes"]
    versions = {row["engine"]: row["version"] for scene in scenes for row in scene["rows"]}
    found = {(scene["scene"], row["engine"]): row for scene in scenes for row in scene["rows"]}
    parts = [table([head, *versions], [(f"`{scene['scene']}`, {scene['bodies']}",
                                        *(cell(found.get((scene["scene"], engine))) for engine in versions))
                                       for scene in scenes])
             for head, cell in (("frames a second, of boxes", engine_cell), ("worst frame, ms", worst_cell),
                                ("drift; overlap", drift_cell))]
    told = ", ".join(f"{engine.split(',')[0]} {version}" for engine, version in versions.items() if version != "this")
    clocks = result["clocks"]
    return "\n\n".join((*parts, prose(
        f"As the packages name themselves: {', '.join(dict.fromkeys(told.split(', ')))}. Processor time of steps, one thread, "
        f"a run each; all threads {clocks['all_threads']:.0f} s, the one that calls {clocks['one_thread']:.0f} s. At 240 "
        "steps a second; 1 s of each scene, 10 s of the block on a slope of 99 % of mu, or what 20 s of processor time "
        "allow. Falls: a body moved by more than half of its least edge; what falls is not ranked. Moves: by more than 1 mm. "
        "Drift: how fast that grows in the second half. Overlap: the deepest at ten times")))


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


def gate_table(cells, keys):
    sums = collections.defaultdict(collections.Counter)
    for cell in cells:
        sums[tuple(cell[key] for key in keys)].update({name: cell[name] for name in ("runs", "solved", "wrong", "undecided")})
    rows = [(*(f"`{name}`" for name in key), count(s["runs"]), f"{100 * s['solved'] / max(s['runs'], 1):.1f}",
             count(s["wrong"]), f"{100 * s['undecided'] / max(s['runs'], 1):.1f}") for key, s in sums.items()]
    return table([*keys, "runs", "solved, %", "wrong", "undecided, %"], rows)


def gate(program):
    """What is called solved over inexact numbers, by dial and by method and arithmetic, plane and space apart."""
    cells = program.bench("gate", "--problems", program.size(60), "--seed", 6)["cells"]
    parts = [gate_table(cells, ["dial"])]
    for dimension, where in ((2, "plane"), (3, "space")):
        chosen = [cell for cell in cells if cell["dimension"] == dimension]
        parts.append(f"**In {'the ' if dimension == 2 else ''}{where}**\n\n" + gate_table(chosen, ["method", "arithmetic"]))
    solved, wrong = (sum(cell[key] for cell in cells) for key in ("solved", "wrong"))
    cost = program.bench("gate-cost")["gate-cost"]
    parts.append("**Microseconds a problem of the plane: LU of A, and judging the forces**\n\n" + table(
        ["contacts", "LU", "gate", "gate / LU", "at 90 %"],
        [(row["contacts"], f"{row['lu us']:.3g}", f"{row['gate us']:.3g}", f"{row['gate/lu']:.2g}",
          f"{row['gate/lu at 90 %']:.2g}") for row in cost]))
    return "\n\n".join(parts) + "\n\n" + prose(
        f"Of {count(solved)} answers called solved {wrong} are wrong; a million have, 95 %: {rate(wrong, solved)}.")
