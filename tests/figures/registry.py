# SPDX-License-Identifier: Apache-2.0
"""All blocks: where each stands, what makes it, what it costs, and what its numbers depend on.

cost: `cheap` is made again by every test; `minutes` and `long` (more than five, of one core) by hand. sources: see
figures.py; those of cheap blocks are not asked for."""

from collections.abc import Callable
from dataclasses import dataclass

import bench_figures as bench
import corpus_figures as corpus
import rung_figures as rungs
import scene_figures as scene
import search_figures as search
from program import ROOT


@dataclass(frozen=True)
class Figure:
    name: str
    file: str
    cost: str
    make: Callable
    sources: tuple = ()


SEARCH = ("algorithm",)
METHODS = ("algorithm", "bench/methods.cpp", "bench/family.cpp", "bench/family.h")
WORK = ("algorithm", "bench/studies/work.py")
PEERS = ("algorithm", "bench/peers/measure_rows.cpp", "bench/peers/rows.cpp", "bench/peers/problems.cpp",
         "bench/peers/random.cpp")
JUDGED = ("solver/problem/errors.h", "solver/problem/units.h")
ANSWERS = ("algorithm", "bench/rungs.cpp", "bench/dials.cpp", "certify/exact/filtered.cpp", *JUDGED)
RUNGS = (*ANSWERS, "bench/ladder.cpp")
SPEED = ("algorithm", "bench/search_rate.cpp", "bench/peers/lemke.cpp", "bench/peak.cpp")
STRUCTURE = ("algorithm", "bench/peers/measure_rows.cpp", "bench/peers/rows.cpp", "bench/peers/families.cpp",
             "bench/structure.cpp")

FIGURES = [
    Figure("first-search", "README.md", "minutes", search.first_search, SEARCH),
    Figure("headline-loop", "certify/results.md", "cheap", corpus.headline_loop),
    Figure("readings", "solver/published/readings.md", "cheap", corpus.readings),
    Figure("certificates", "cli/tour.md", "cheap", corpus.certificates),
    Figure("records", "search/adversary/frontiers.md", "cheap", corpus.records),
    Figure("ten-billion", "search/campaigns/README.md", "long", search.ten_billion, SEARCH),
    Figure("search-speed", "reports/speed.md", "minutes", bench.search_speed, SPEED),
    Figure("lanes", "search/README.md", "minutes", bench.lanes, SPEED),
    Figure("peers-in-short", "reports/speed.md", "long", bench.peers_in_short, PEERS),
    Figure("corpus", "corpus/README.md", "cheap", corpus.corpus),
    Figure("endless", "search/adversary/frontiers.md", "cheap", corpus.endless),
    Figure("smallest", "search/adversary/frontiers.md", "minutes", bench.smallest, ("algorithm", "bench/studies/smallest.py")),
    Figure("scenes-in-space", "search/adversary/frontiers.md", "cheap", corpus.scenes_in_space),
    Figure("robust-scenes", "search/adversary/frontiers.md", "cheap", corpus.robust_scenes),
    Figure("longest-runs", "search/adversary/frontiers.md", "cheap", corpus.longest_runs),
    Figure("sliding-corpus", "corpus/README.md", "cheap", corpus.sliding_corpus),
    Figure("wrong-in-doubles", "corpus/README.md", "cheap", corpus.wrong_in_doubles),
    Figure("published-problems", "corpus/formats/README.md", "minutes", scene.published_problems,
           ("algorithm", "cli/survey.cpp")),
    Figure("scene-speed", "corpus/scenes/README.md", "minutes", bench.scene_speed, ("algorithm", "bench/scenes.cpp")),
    Figure("scene-threads", "corpus/scenes/README.md", "minutes", bench.scene_threads,
           ("algorithm", "bench/scenes.cpp")),
    Figure("tolerance", "corpus/scenes/README.md", "minutes", scene.tolerance, ("algorithm", "tests/setup/tolerance.py")),
    Figure("safe-by-condition", "certify/condition_number.md", "cheap", corpus.safe_by_condition),
    Figure("dearest", "certify/README.md", "minutes", corpus.dearest, ("certify/claims/check_certificate.cpp", "certify/claims/witness.cpp",
           "certify/check_certificate.py", "certify/certificate_reader.py", "tests/certify/limits_test.py")),
    Figure("linear-algebra", "certify/README.md", "minutes", bench.linear_algebra,
           ("algorithm", "bench/studies/linear_algebra.py")),
    Figure("scenes-by-mu", "search/README.md", "long", search.scenes_by_mu, SEARCH),
    Figure("adversary", "search/README.md", "minutes", bench.adversary, ("algorithm", "bench/studies/adversary.py", "search/adversary")),
    Figure("generators-by-mu", "search/README.md", "minutes", search.generators_by_mu, SEARCH),
    Figure("missed-by-doubles", "search/README.md", "long", search.missed_by_doubles, SEARCH),
    Figure("existence", "search/README.md", "minutes", search.existence, SEARCH),
    Figure("night", "search/README.md", "long", search.night, ("algorithm", "tests/setup/memory.py")),
    Figure("scaling", "search/SCALING.md", "minutes", search.scaling,
           ("algorithm", "tests/setup/scaling.py", "corpus/store_merge.cpp")),
    Figure("plan", "search/SCALING.md", "minutes", search.plan, SEARCH),
    Figure("methods-built", "solver/README.md", "cheap", corpus.methods_built),
    Figure("growth", "solver/README.md", "minutes", bench.growth, ("algorithm", "bench/peers/growth.cpp")),
    Figure("safe-loops", "solver/published/readings.md", "minutes", search.safe_loops, SEARCH),
    Figure("space", "solver/published/readings.md", "long", bench.space, ("algorithm", "bench/studies/space.py")),
    Figure("patches", "solver/published/mending.md", "long", bench.patches, ("algorithm", "bench/studies/patches.py")),
    Figure("sliding", "solver/published/readings.md", "minutes", bench.sliding, ("algorithm", "bench/studies/sliding.py")),
    Figure("worst-case", "solver/published/readings.md", "cheap", corpus.worst_case),
    Figure("energy", "scene/README.md", "cheap", scene.energy),
    Figure("halved-steps", "scene/README.md", "cheap", scene.halved_steps),
    Figure("unsolved-in-scenes", "scene/README.md", "long", scene.unsolved_in_scenes,
           ("algorithm", "tests/setup/scene_statistics.py")),
    Figure("work", "reports/methods.md", "long", bench.work, WORK),
    Figure("near-worst-case", "reports/methods.md", "minutes", bench.near_worst_case, WORK),
    Figure("folds", "reports/methods.md", "long", bench.folds, WORK),
    Figure("starts", "reports/methods.md", "long", bench.starts, WORK),
    Figure("method-times", "reports/methods.md", "minutes", bench.method_times, METHODS),
    Figure("frictionless", "reports/methods.md", "minutes", bench.frictionless, METHODS),
    Figure("certified", "reports/arithmetic.md", "minutes", rungs.certified,
           ("algorithm", "bench/studies/ratios.py", "bench/ladder.cpp", "certify/exact/filtered.cpp")),
    Figure("same-tables", "reports/arithmetic.md", "long", rungs.same_tables, ("algorithm", "certify/exact/filtered.cpp")),
    Figure("trade", "reports/arithmetic.md", "minutes", rungs.trade, RUNGS),
    Figure("extremes", "reports/arithmetic.md", "minutes", rungs.extremes, RUNGS),
    Figure("silent", "reports/arithmetic.md", "long", rungs.silent, (*ANSWERS, "bench/gate.cpp")),
    Figure("gate", "reports/arithmetic.md", "long", bench.gate,
           ("algorithm", "bench/gate.cpp", "bench/dials.cpp", *JUDGED)),
    Figure("peers-extremes", "reports/peers.md", "minutes", rungs.peers_extremes,
           ("algorithm", "bench/peers/rows.cpp", "bench/peers/extremes.cpp", "bench/dials.cpp")),
    Figure("peers", "reports/peers.md", "long", bench.peers, PEERS),
    Figure("structure", "reports/peers.md", "long", bench.structure, STRUCTURE),
    Figure("structure-large", "reports/peers.md", "long", bench.structure_large, STRUCTURE),
]

# Where every measured number stands in a block.
DOCUMENTS = sorted({
    str(file.relative_to(ROOT)) for pattern in ("*.md", "*/*.md", "solver/**/*.md", "corpus/*/*.md", "certify/**/*.md",
                                                 "search/**/*.md", "tests/fuzz/*.md")
    for file in ROOT.glob(pattern) if "build" not in file.parts})

# Phrases with a number that is no figure: a definition, a theorem, a size that a test or a command names.
DEFINITIONS = {
    "certify/README.md": ("64 MB", "2,000 contacts", "20,000 characters", "16 MB", "1,000", "10,000,000", "9,001",
                          "2,000,000"),
    "certify/where_loops_begin.md": ("1,280", "1,536", "360 policies"),
    "reports/README.md": ("at 95 %",),
    "search/SCALING.md": ("10^13 problems", "1,000 nodes", "10^10 problems", "1,024 units", "1,000 to 100,000"),
    "tests/fuzz/README.md": ("no hang (20 s)", "no flood (2.5 GB)"),
    "corpus/scenes/README.md": ("4 of 6 contacts", "the first 600 frames"),
}
