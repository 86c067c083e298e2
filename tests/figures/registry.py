# SPDX-License-Identifier: Apache-2.0
"""All figures. Cheap ones are blocks in the texts, which every test makes again; what costs more is measured by hand, and
is a file of its own, reports/measured/NAME.md."""

from collections.abc import Callable
from dataclasses import dataclass

import bench_figures as bench
import corpus_figures as corpus
import rung_figures as rungs
import scene_figures as scene
import search_figures as search
from markdown import table
from program import ROOT


@dataclass(frozen=True)
class Block:
    name: str
    file: str  # whose text it stands in
    make: Callable


@dataclass(frozen=True)
class Measurement:
    name: str
    cost: str  # minutes, or long: more than five, of one core
    make: Callable
    what: str
    peers: tuple = ()  # packages of Debian whose versions are noted

    @property
    def file(self):
        return f"{MEASURED}/{self.name}.md"


MEASURED = "reports/measured"
SICONOS = ("libsiconos-numerics-dev",)
ENGINES = ("libbullet-dev", "libode-dev", "libbox2d-dev", "libmujoco-dev")
PEERS = ("libode-dev", "libdart-dev", "libbullet-dev", *SICONOS)


def measured_files():
    """Which measurements there are, and which there are not yet."""
    there = [one for one in MEASUREMENTS if (ROOT / one.file).exists()]
    missing = [one for one in MEASUREMENTS if one not in there]
    parts = [table(["measured", "what"], [(f"[{one.name}]({one.name}.md)", one.what) for one in there])]
    if missing:
        parts += ["Not measured for the code as it is; `tests/figures/figures.py refresh NAME` does it:",
                  table(["NAME", "what"], [(f"`{one.name}`", one.what) for one in missing])]
    return "\n\n".join(parts)


BLOCKS = [
    Block("measured", f"{MEASURED}/README.md", lambda program: measured_files()),
    Block("headline-loop", "certify/results.md", corpus.headline_loop),
    Block("readings", "solver/published/readings.md", corpus.readings),
    Block("certificates", "cli/tour.md", corpus.certificates),
    Block("records", "search/adversary/frontiers.md", corpus.records),
    Block("corpus", "corpus/cases.md", corpus.corpus),
    Block("questions", "search/questions.md", search.questions),
    Block("endless", "search/adversary/frontiers.md", corpus.endless),
    Block("scenes-in-space", "search/adversary/frontiers.md", corpus.scenes_in_space),
    Block("robust-scenes", "search/adversary/frontiers.md", corpus.robust_scenes),
    Block("longest-runs", "search/adversary/frontiers.md", corpus.longest_runs),
    Block("sliding-corpus", "corpus/cases.md", corpus.sliding_corpus),
    Block("wrong-in-doubles", "corpus/cases.md", corpus.wrong_in_doubles),
    Block("safe-by-condition", "certify/condition_number.md", corpus.safe_by_condition),
    Block("methods-built", "solver/README.md", corpus.methods_built),
    Block("worst-case", "solver/published/readings.md", corpus.worst_case),
    Block("simulation-tables", "corpus/formats/simulation_tables.md", scene.simulation_tables),
    Block("energy", "scene/simulation.md", scene.energy),
    Block("halved-steps", "scene/simulation.md", scene.halved_steps),
]

MEASUREMENTS = [
    Measurement("first-search", "minutes", search.first_search,
                "What the first search of the README prints, its beginning and its end."),
    Measurement("ten-billion", "long", search.ten_billion,
                "The largest campaign: what it found, and that everything audited was solved."),
    Measurement("search-rate", "minutes", bench.search_rate,
                "Problems a second of the campaign that names nothing, and the time that a unit has the store."),
    Measurement("search-speed", "minutes", bench.search_speed,
                "Problems a second of a search, by generator and contacts; what its time goes to; beside Siconos's "
                "Lemke.", SICONOS),
    Measurement("lanes", "minutes", bench.lanes,
                "Problems of two to four contacts in the lanes of vectors beside one after the other, and a roofline."),
    Measurement("peers-in-short", "long", bench.peers_in_short,
                "The fast method beside the packages of others, in short.", PEERS),
    Measurement("smallest", "minutes", bench.smallest, "The smallest integers with which two contacts loop."),
    Measurement("published-problems", "minutes", scene.published_problems,
                "Problems that others published: assumptions, outcomes and errors of each."),
    Measurement("scene-speed", "minutes", bench.scene_speed,
                "Frames a second of the scenes of the corpus, the first 600 at most, contacts, assembly and solving "
                "counted: the minimal and the full model by turns; rows and problems of a frame."),
    Measurement("scene-threads", "minutes", bench.scene_threads,
                "Frames a second of the scenes of the corpus, on one thread and on two."),
    Measurement("tolerance", "minutes", scene.tolerance,
                "How many scenes like `weight-on-two-pegs` still loop when every dimension is off."),
    Measurement("page-times", "minutes", search.page_times,
                "How fast the pages of a report open in Chromium, with few findings and with ten thousand."),
    Measurement("dearest", "minutes", corpus.dearest,
                "What the dearest certificates cost that the checkers take, each just below one limit (`dense N`: a "
                "matrix of N rows with all the bits that it may have)."),
    Measurement("linear-algebra", "minutes", bench.linear_algebra,
                "Ways to solve a linear system exactly, alone and inside the methods: `gauss` is elimination over "
                "rationals, `fmpq` and `fmpz` are FLINT with its matrices at hand (`fmpz`: integers, answers not "
                "reduced)."),
    Measurement("scenes-by-mu", "long", search.scenes_by_mu,
                "How often the policy `paper` loops, and ends because a force direction does not exist, on problems "
                "of the generator `scenes`, one friction coefficient for all contacts."),
    Measurement("at-rest", "long", search.at_rest,
                "How often the policy `paper` loops on convex bodies of uniform density at rest under gravity alone, by "
                "contacts and friction, and a law through it."),
    Measurement("engine-steps", "long", search.engine_steps,
                "How often the policy `paper` loops on what steps of an engine ask for (generator `steps`), by contacts "
                "and friction, and a law through it."),
    Measurement("adversary", "minutes", bench.adversary,
                "How many times worse for the solver than the best of random problems the best of each optimizer "
                "is, by seed, with as many evaluations: `inf` where random problems have no value, `-` where "
                "neither has, 0 where only random ones have; nothing was tuned on these seeds."),
    Measurement("adversary-solvers", "long", search.adversary_solvers,
                "Solvers of other packages, and ours, under test: how often each fails, as rates in a million problems, "
                "and the smallest problem of each failure.", PEERS),
    Measurement("generators-by-mu", "minutes", search.generators_by_mu,
                "How often the policy `paper` loops on generators of abstract matrices and of bodies that may overlap, by "
                "contacts and friction."),
    Measurement("missed-by-doubles", "long", search.missed_by_doubles,
                "Loops that doubles call solved, where every problem is run exactly."),
    Measurement("existence", "minutes", search.existence,
                "Whether every problem is solved, and whether all methods agree, where every problem is run exactly."),
    Measurement("night", "long", search.night,
                "How memory and store of a search grow, as it runs."),
    Measurement("scaling", "minutes", search.scaling, "Merging the shards of a campaign, at once and as a tree."),
    Measurement("plan", "minutes", search.plan, "What 10^13 problems would take."),
    Measurement("growth", "minutes", bench.growth,
                "How time and memory of the methods grow with the number of contacts."),
    Measurement("safe-loops", "minutes", search.safe_loops,
                "A search for a loop in a safe problem, under `paper` and `apex=suspended`."),
    Measurement("safe-ties", "minutes", search.safe_ties,
                "A search for a loop in a safe problem of two contacts, under policies for which nobody has proved that "
                "there is none."),
    Measurement("space", "long", bench.space, "The policies of section 5.6 side by side, in space."),
    Measurement("space-loops", "minutes", bench.space_loops,
                "Loops of the published algorithm in space on random problems: suspected by doubles, proved by sets that "
                "recur or by boxes, open; every proof accepted by the independent checker."),
    Measurement("space-solved", "minutes", bench.space_solved,
                "Whether every problem of space that has a solution is called solved over doubles, and how much larger its "
                "forces are than what acts (amplification): jams, integers, and problems near critical loads."),
    Measurement("patches", "long", bench.patches,
                "Failures in a million problems of ways to change what the published algorithm gives up, by "
                "generator and contacts; solver/published/mending.md explains the columns."),
    Measurement("sliding", "minutes", bench.sliding,
                "How the published algorithm ends where contacts slide: generator `integers`, policy `paper`, over "
                "doubles, cycles confirmed and the existence of solutions decided exactly."),
    Measurement("unsolved-in-scenes", "long", scene.unsolved_in_scenes,
                "How the methods end on the problems that simulations of the corpus' scenes meet."),
    Measurement("work", "long", bench.work,
                "Steps, pieces and pivots of the methods, and failures of the published algorithm."),
    Measurement("near-worst-case", "minutes", bench.near_worst_case,
                "Steps of the methods near the worst case without friction."),
    Measurement("folds", "long", bench.folds, "Folds and descents of complete driving, by contacts and friction."),
    Measurement("starts", "long", bench.starts, "Starts of Ipopt until an exact solution came out of its point."),
    Measurement("method-times", "minutes", bench.method_times, "Times of the methods on the same problems."),
    Measurement("frictionless", "minutes", bench.frictionless,
                "Section 4 of the paper beside elimination and quadratic programs, without friction."),
    Measurement("certified", "minutes", rungs.certified,
                "Times of certified runs and of runs over rationals, as multiples of those over doubles."),
    Measurement("large-certificates", "minutes", rungs.large_certificates,
                "Certificates of hundreds of planar contacts: what `certify` and both checkers need, and whether these "
                "refuse what is altered."),
    Measurement("same-tables", "long", rungs.same_tables,
                "Whether a search over filtered numbers leaves the tables of one over rationals."),
    Measurement("trade", "minutes", rungs.trade, "Time and answers of every method over every kind of number."),
    Measurement("extremes", "minutes", rungs.extremes,
                "Answers of every method over every kind of number, along dials of extreme problems."),
    Measurement("silent", "long", rungs.silent, "Answers called solved that are wrong, over many problems."),
    Measurement("gate", "long", bench.gate,
                "What is called solved over inexact numbers, judged over rationals: by dial, and by method and "
                "arithmetic; and what it costs to judge."),
    Measurement("peers-extremes", "minutes", rungs.peers_extremes,
                "Answers of the packages of others along dials of extreme problems, judged over rationals.", PEERS),
    Measurement("peers", "long", bench.peers, "The methods beside the packages of others on random matrices.", PEERS),
    Measurement("structure", "long", bench.structure,
                "The methods beside the packages of others on problems with structure.", PEERS),
    Measurement("engines", "minutes", bench.engines,
                "Scenes simulated beside Bullet, ODE, Box2D and MuJoCo: frames a second, what stands, drift, overlap.",
                ENGINES),
    Measurement("impacts", "long", bench.impacts, "Forces of random impacts, judged, and their worst frames."),
    Measurement("motion", "minutes", bench.motion, "Time of a frame by bodies: walls, hit, and piles."),
    Measurement("many", "minutes", bench.many, "What Python costs of many problems at once."),
    Measurement("nightly", "long", corpus.nightly,
                "The last `./run test --nightly`: its steps, how long each took and how it ended."),
    Measurement("mutants", "long", corpus.mutants,
                "Bugs of one line, by hand and drawn from covered lines, and whether a test notices them."),
    Measurement("structure-large", "long", bench.structure_large,
                "The methods beside the packages of others on the walls of `corpus/scenes/large`.", PEERS),
]

# Where every number that looks measured stands in a block, or in a file of its own.
DOCUMENTS = sorted({
    str(file.relative_to(ROOT)) for pattern in ("*.md", "*/*.md", "cli/*/*.md", "solver/**/*.md", "corpus/**/*.md",
                                                 "certify/**/*.md", "search/**/*.md", "reports/*/*.md", "tests/**/*.md")
    for file in ROOT.glob(pattern) if "build" not in file.parts and "node_modules" not in file.parts})

# Phrases with a number that is no figure: a definition, a theorem, a size that a test or a command names.
DEFINITIONS = {
    "README.md": ("1,536",),
    "certify/certificates.md": ("32 MB", "3,000", "40,000", "10,000", "9,001", "1,000,000", "2,000,000", "250,000", "4,096"),
    "cli/how-to/paper.md": ("at 95 %",),
    "certify/results.md": ("1,536",),
    "certify/where_loops_begin.md": ("1,280", "1,536", "360 policies"),
    "reports/README.md": ("at 95 %",),
    "reports/files.md": ("at 95 %",),
    "search/frequencies.md": ("at 95 %",),
    "search/under_test/README.md": ("at 95 %",),
    "search/SCALING.md": ("10^13 problems", "1,000 nodes", "10^10 problems", "1,024 units", "1,000 to 100,000"),
    "tests/fuzz/README.md": ("no hang (20 s)", "no flood (2.5 GB)"),
    "corpus/scenes/README.md": ("4 of 6 contacts",),
}
