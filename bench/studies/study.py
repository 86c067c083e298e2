# SPDX-License-Identifier: Apache-2.0
"""What the studies share: their options, problems, times, and tables in Markdown."""

import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")  # numpy reads them when it is loaded, Ipopt's process too

import numpy as np  # noqa: E402

import stiction  # noqa: E402

PROGRAM = os.path.join(os.path.dirname(stiction.__file__), "../../../stiction")
FRICTIONS = ("0", "1/5", "1/2", "1", "2", "5", "10", "mixed")


def options(text, **defaults):
    """The command line of a study: --name for every default, several values for a list, a flag for False."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in defaults.items():
        flag = f"--{name.replace('_', '-')}"
        if value is False:
            parser.add_argument(flag, action="store_true")
        elif isinstance(value, list):
            parser.add_argument(flag, nargs="+", default=value, type=type(value[0]),
                                help=f"default {' '.join(map(str, value))}")
        else:
            parser.add_argument(flag, default=value, type=type(value), help=f"default {value}")
    return parser.parse_args()


def run(main):
    """Exit code 2, and a line, where what is asked for cannot be had."""
    try:
        main()
    except ValueError as error:
        print(f"{sys.argv[0]}: {error}", file=sys.stderr)
        sys.exit(2)


def say(text=""):
    """How far it is, on a terminal."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def chunks(problems, size=1000):
    """(first, count) of parts of so many problems."""
    for first in range(0, problems, size):
        say(f"{first:,} of {problems:,}")
        yield first, min(size, problems - first)
    say()


# ---- Problems, and how methods end on them -------------------------------------------------------------------


def definite(rows, numbers, rows_per_contact=2):
    """A = J J' + I, J square, of integers up to 1000; b of integers up to 10^6, a normal's made <= 0 with probability 3/5."""
    J = np.array([[numbers.randint(-1000, 1000) for _ in range(rows)] for _ in range(rows)])
    b = [numbers.randint(-10 ** 6, 10 ** 6) for _ in range(rows)]
    b = [-abs(x) if row % rows_per_contact == 0 and numbers.random() < 0.6 else x for row, x in enumerate(b)]
    return J @ J.T + np.eye(rows, dtype=int), np.array(b)


def draw(generator, contacts, index, seed):
    """A problem of the generator, by default of `definite`, of which ties are improbable. mu is 0, 1/5, 1/2, 1, 2, 5 or
    10 at all contacts, or mixed, an eighth of the problems each."""
    friction = FRICTIONS[index % len(FRICTIONS)]
    if generator:
        mu = FRICTIONS[:-1] if friction == "mixed" else friction
        return stiction.draw(generator, contacts, 1, seed, mu=mu, first=index)[0]
    numbers = random.Random(f"{seed} {contacts} {index}")
    A, b = definite(2 * contacts, numbers)
    return stiction.Problem(A, b, [numbers.choice(FRICTIONS[:-1]) if friction == "mixed" else friction
                                   for _ in range(contacts)])


def solved(problems, method, arithmetic, policy="paper", judge=None, repeat=3):
    """The columns of `solve_all`, suspicions as they are and answers judged; `seconds` are the least of several calls, of
    Ipopt those of its process too."""
    judge = problems if judge is None else judge
    if method == "ipopt" or (method, arithmetic) == ("qp", "double"):
        return in_process(problems, method, arithmetic)
    run = stiction.solve_all(problems, method, arithmetic, policy, confirm=False, judge=judge)
    for _ in range(repeat - 1):  # the first problem of a call finds memory cold
        again = stiction.solve_all([*problems[:1], *problems], method, arithmetic, policy, confirm=False)
        run["seconds"] = np.minimum(run["seconds"], again["seconds"][-len(problems):])
    return run


def in_process(problems, method, arithmetic):
    runs = []
    for problem in problems:
        before = children_seconds()
        run = stiction.solve_all([problem], method, arithmetic, judge=[problem])
        run["seconds"] += children_seconds() - before
        runs.append(run)
    return {name: np.concatenate([run[name] for run in runs]) for name in ("outcome", "seconds", "residual")}


def children_seconds():
    """Processor time of processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def contradictions(runs):
    """Of how many problems one exact run says that it is solved and another that there is no solution, or calls solved
    what is not. runs: how many problems stand for one that it was given, and its columns."""
    most = max(every * len(run["outcome"]) for every, run in runs)
    is_solved, refuted, wrong = (np.zeros(most, bool) for _ in range(3))
    for every, run in runs:
        places = every * np.arange(len(run["outcome"]))
        is_solved[places] |= run["outcome"] == "solved"
        refuted[places] |= np.isin(run["outcome"], ("ray", "no-solution"))
        wrong[places] |= run.get("residual", np.zeros(len(places))) > 0
    return int((is_solved & refuted | wrong).sum())


# ---- Processes -----------------------------------------------------------------------------------------------


def started(*words, limit, stdout=subprocess.PIPE):
    """It is killed after so many processor seconds."""
    return subprocess.Popen([str(word) for word in words], stdout=stdout, stderr=subprocess.DEVNULL,
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))


def process(*words, limit=3600):
    """Exit code, processor seconds."""
    program = started(*words, limit=limit, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(program.pid, 0)
    program.returncode = os.waitstatus_to_exitcode(status)
    return program.returncode, usage.ru_utime + usage.ru_stime


# ---- Scenes, and their frames ---------------------------------------------------------------------------------


def block(x, up, y=0, edges=(31 / 32, 1 / 2, 1 / 2), speed=0, **more):
    """A box at (x, y, up), y aside; of edges along these; with a speed along x."""
    return {"mass": 1, "position": [x, y, up], "velocity": [speed, 0, 0], "shapes": [{"box": list(edges)}], **more}


def wall(courses, bricks, x=0):
    """In running bond; every second course has a brick less."""
    return [block(x + k + course % 2 / 2, 0.25 + course / 2)
            for course in range(courses) for k in range(bricks - course % 2)]


def scene(name, dimension, blocks, seconds, mu=0.5):
    """Of blocks on a floor, stepped 240 times a second; in the plane without y."""
    floor = {"fixed": True, "position": [0, 0, -1], "shapes": [{"box": [400, 400, 2]}]}
    bodies = [{"name": f"block-{k}", **one} for k, one in enumerate([floor, *blocks])]
    if dimension == 2:
        bodies = [one | {key: one[key][::2] for key in ("position", "velocity") if key in one}
                  | {"shapes": [{"box": one["shapes"][0]["box"][::2]}]} for one in bodies]
    return {"format": "stiction-scene", "version": 1, "name": name, "dimension": dimension, "mu": mu,
            "gravity": [0, 0, -10][-dimension:], "step": "1/240", "seconds": seconds, "bodies": bodies}


def frames(of, *levels, limit=600):
    """Lines of `stiction-bench --suite frames`: problems of these levels with their forces, and last the scene's; without
    it where the process ends otherwise or needs more processor seconds."""
    with tempfile.TemporaryDirectory(prefix="stiction-frames-") as folder:
        Path(folder, "scene.json").write_text(json.dumps(of))
        words = ["--families", *levels] if levels else []
        with started(PROGRAM + "-bench", "--suite", "frames", "--scenes", folder, *words, limit=limit) as program:
            for line in program.stdout:
                if line.endswith(b"\n"):
                    yield json.loads(line)


# ---- Numbers and tables --------------------------------------------------------------------------------------


def show(head, rows):
    """A table."""
    for line in (head, ["---"] * len(head), *rows):
        print("| " + " | ".join(number(cell) for cell in line) + " |")
    print(flush=True)


def quartiles(values, unit=1):
    """The values of rank n/4, n/2, 3n/4; None of none."""
    ranked = sorted(float(x) * unit for x in values)
    return [ranked[k * len(ranked) // 4] for k in (1, 2, 3)] if ranked else None


def number(x):
    """Text as it is, whole numbers in full, others in three digits; quartiles as the median and the others."""
    if x is None:
        return ""
    if isinstance(x, list):
        return f"{number(x[1])} ({number(x[0])} - {number(x[2])})"
    if isinstance(x, (float, np.floating)):
        return f"{x:,.0f}" if abs(x) >= 1000 else f"{x:.3g}"
    return f"{x:,}" if isinstance(x, (int, np.integer)) else str(x)


def within(value, ends, unit=""):
    return f"{number(float(value))}{unit} [{', '.join(number(float(end)) for end in ends)}]"


def share(count, of):
    """In percent, with its exact interval at 95 %."""
    return within(100 * count / of, (100 * end for end in stiction.interval(count, of)), " %") if of else "-"


def rate(count, of):
    """In a million, likewise."""
    return within(1e6 * count / of, (1e6 * end / of for end in stiction.interval(count)))


def times(values):
    """Median and 90 % quantile."""
    return f"{number(float(np.median(values)))} ({number(float(np.quantile(values, 0.9)))})" if len(values) else "-"
