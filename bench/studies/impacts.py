# SPDX-License-Identifier: Apache-2.0
"""What the forces of impacts miss: random scenes that a thrown block hits, and their problems judged.

A wall, stacks, a pile or two walls, of bricks of 1 kg, hit by a block of 10 g to 1 t at 3 to 40 m/s after a twentieth of
a second, two walls from both sides; mu from .1 to 1; two thirds in the plane. The simulation's problems in factors (40 rows
or more, in space 10) with its forces are judged by the law of certify/residuals.py, which shares no code with it, on
accelerations from J, M and b in long doubles:

    strict       the error that residuals.py tells
    less noise   the same beyond 1e-11 of the largest abs(b), which the simulation takes for noise of accelerations
    lenient      that in the largest units of an acceleration, those of solver/problem/units.h, as the simulation has it

Frames: the processor time of the worst of each scene. --keep DIR: scenes that crash or need more than --limit seconds;
problems whose lenient error is above 1e-5, and the worst of each kind: scene, problem, forces, and a line each."""

import json
import math
import random
import sys
from pathlib import Path

import numpy as np

import study

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "certify"))
import residuals  # noqa: E402

NOISE, THETA = 1e-11, 8 * 2.0**-53 / 1e-8
MEASURES = ("strict", "less noise", "lenient")


# ---- Scenes --------------------------------------------------------------------------------------------------


def building(kind, bodies, dimension, numbers):
    """Blocks; the farther end, the height."""
    def uniform(most):
        return round(numbers.uniform(-most, most), 3)
    across = math.isqrt(bodies - 1) + 1
    if kind == "stacks":
        blocks = [study.block(k // 10 * 1.25 + uniform(0.09), 0.25 + k % 10 / 2, uniform(0.09), (1, 1, 0.5))
                  for k in range(bodies)]
    elif kind == "pile":
        axis = {"axis": [0, 1, 0]} if dimension == 3 else {}
        blocks = [study.block(1.3 * (k % across) + uniform(0.05), 0.6 + 1.05 * (k // across), uniform(0.3), (1, 0.7, 0.6),
                              angle=uniform(0.5), **axis) for k in range(bodies)]
    else:
        bricks = numbers.randint(max(2, across // 2), max(2, 2 * across))
        blocks = study.wall(2 * bodies // (2 * bricks - 1) + 2, bricks)[:bodies]
    return blocks, max(one["position"][0] for one in blocks), max(one["position"][2] for one in blocks)


def drawn(index, o):
    numbers = random.Random(f"{o.seed} {index}")
    dimension, kind = 3 if index % 3 == 2 else 2, ("wall", "stacks", "pile", "two walls")[index % 4]
    bodies, sides = numbers.randint(*o.bodies), 2 if kind == "two walls" else 1
    blocks, end, height = building(kind, (bodies - sides) // sides, dimension, numbers)
    if sides == 2:
        others, ends, heights = building(kind, bodies - sides - len(blocks), dimension, numbers)
        for one in others:
            one["position"][0] += end + 1
        blocks, end, height = blocks + others, end + 1 + ends, max(height, heights)
    for side in range(sides):
        speed = round(numbers.uniform(3, 40), 2)
        x, up = -1.1 - 0.05 * speed, round(numbers.uniform(0.5, max(0.5, height)), 3)
        blocks.append(study.block(x if side == 0 else end - x, up, round(numbers.uniform(-0.4, 0.4), 3), (1, 1, 1),
                                  speed if side == 0 else -speed, mass=float(f"{10 ** numbers.uniform(-2, 3):.3g}")))
    name = f"impact-{o.seed}-{index}-{kind.replace(' ', '-')}"
    return study.scene(name, dimension, blocks, o.seconds, round(numbers.uniform(0.1, 1), 2))


# ---- Judged --------------------------------------------------------------------------------------------------


def accelerations(J, M, b, f):
    """Over long doubles, and A over doubles. M by blocks, whose inverses are refined once."""
    W = np.linalg.inv(M)
    kicks = (J.T @ f).reshape(M.shape[:2])
    moved = np.einsum("nij,nj->ni", W, kicks)
    moved += np.einsum("nij,nj->ni", W, kicks - np.einsum("nij,nj->ni", M, moved))
    parts = J.astype(float).reshape(len(b), *M.shape[:2])
    A = np.einsum("rni,nij->rnj", parts, W).reshape(len(b), -1) @ J.astype(float).T
    return J @ moved.ravel() + b, A


def units(problem, A, f):
    """The lenient ones of accelerations."""
    rows = [slice(first, first + problem.rows_of(one)) for first, one in zip(problem.first, problem.contacts)]
    b, forces, s = abs(np.array(problem.b)), abs(np.array(f)), np.zeros(len(f))
    for of in rows:
        if forces[of].any():
            own = np.maximum(forces[of], b[of] / np.maximum(A.diagonal()[of], 1e-300))
            forces[of] = np.maximum(own, own[0])
    S = abs(A) @ forces
    for of in rows:
        s[of.start], s[of.start + 1:of.stop] = (b + S)[of.start], sum(map(np.linalg.norm, (b[of][1:], S[of][1:])))
    return s.tolist()


def errors(problem, f):
    """By each measure."""
    factors = problem["factors"]
    J = np.zeros(factors["J"]["size"], np.longdouble)
    for i, j, x in factors["J"]["entries"]:
        J[i, j] = x
    b, M = np.array(factors["c"], np.longdouble), np.array(factors["M"])
    if len(f) != len(b):
        return [math.inf] * len(MEASURES)
    a, A = accelerations(J, M, b, np.array(f, np.longdouble))
    a, noise = a.astype(float).tolist(), float(NOISE * abs(b).max())
    judged = residuals.Problem(problem["dimension"], residuals.contacts_of(problem), factors["c"])
    for of, row in zip(judged.A, A):
        columns = np.flatnonzero(row)
        of.update(zip(columns.tolist(), row[columns].tolist()))
    judges = [residuals.Judge(judged, f, *by) for by in ((THETA, a), (THETA, a, noise), (1, a, noise))]
    judges[-1].s = units(judged, A, f)
    return [judge.largest()[0] for judge in judges]


def kind_of(line):
    slide = any(one["kind"] == "sliding" for one in line["problem"]["contacts"])
    return f"{line['level']}, some slide" if slide else line["level"]


def run(scene, o):
    """Lines of problems judged, and the scene's, if it came to its end."""
    least = 40 if scene["dimension"] == 2 else 10
    for line in study.frames(scene, *o.levels, limit=o.limit):
        if "problem" not in line:
            yield line
        elif len(line["problem"]["factors"]["c"]) >= least:
            yield line | {"errors": errors(line["problem"], line["f"]), "kind": kind_of(line), "scene": scene}


def keep(line, folder):
    """Scene, problem and forces, as simulate, solve and residuals.py take them."""
    scene, name = line["scene"], f"{line['scene']['name']}-{line['number']}"
    origin = {"scene": scene["name"], "frame": line["frame"], "level": line["level"]}
    for ending, what in ((".scene", scene), (".problem", line["problem"] | {"name": name, "origin": origin}),
                         (".answer", {"f": line["f"], "residual": line["errors"][0]})):
        Path(folder, f"{name}{ending}.json").write_text(json.dumps(what))
    return name


def size_of(scene):
    least = max(size for size in (0, 20, 50) if len(scene["bodies"]) > size)
    return f"{'plane' if scene['dimension'] == 2 else 'space'}, {least} bodies and more"


def main():
    o = study.options(__doc__, scenes=1000, seed=1, bodies=[5, 100], seconds=0.3, levels=["impulses", "forces"],
                      limit=600, keep="")
    found, worst, ends = {}, {}, {}
    if o.keep:
        Path(o.keep).mkdir(parents=True, exist_ok=True)
    for index in range(o.scenes):
        scene = drawn(index, o)
        study.say(f"{index} of {o.scenes}: {scene['name']}")
        last = {}
        for number, last in enumerate(run(scene, o)):
            if "errors" in last:
                last["number"], kind, lenient = number, last["kind"], last["errors"][2]
                found.setdefault(kind, []).append(last["errors"])
                if kind not in worst or lenient > worst[kind]["errors"][2]:
                    worst[kind] = last
                if o.keep and lenient > 1e-5:
                    keep(last, o.keep)
        ends.setdefault(size_of(scene), []).append((scene, last if "seconds" in last else None))
    study.say()
    study.show(["problems", "how many", "error", "above 1e-8, 95 %", "above 1e-5, 95 %", "worst"],
               [(kind, len(all_of), measure, *(study.share(sum(one[k] > most for one in all_of), len(all_of))
                                               for most in (1e-8, 1e-5)), max(one[k] for one in all_of))
                for kind, all_of in sorted(found.items()) for k, measure in enumerate(MEASURES)])
    rows = []
    for size, of in sorted(ends.items()):
        whole = [(scene, end) for scene, end in of if end]
        frames = [(1000 * max(end["seconds"]), scene["name"]) for scene, end in whole]
        counted = [sum(end["statistics"][name] for _, end in whole) for name in ("frames", "undecided", "deep")]
        rows.append((size, len(of), len(of) - len(whole), *counted, study.times([time for time, _ in frames]),
                     *max(frames, default=(None, None))))
    study.show(["scenes", "how many", "not ended", "frames", "undecided problems", "ran out of halvings",
                "worst frame, ms: median (90 %)", "worst of all", "in"], rows)
    study.show(["problems", "the worst", "frame", "error, lenient"],
               [(kind, keep(line, o.keep) if o.keep else line["scene"]["name"], line["frame"], line["errors"][2])
                for kind, line in sorted(worst.items())])
    if o.keep:
        for scene, end in (one for of in ends.values() for one in of):
            if end is None:
                Path(o.keep, f"{scene['name']}.scene.json").write_text(json.dumps(scene))


if __name__ == "__main__":
    study.run(main)
