# SPDX-License-Identifier: Apache-2.0
"""How the time of a frame grows with the bodies of a scene.

Walls of so many courses of as many bricks, in the plane and in space: at rest, then hit after a tenth of a second by a
block of 10 kg at 20 m/s; and planar piles that fall and are hit. Processor time, one thread: the first frame, which has
no forces to start from; the median of those until the hit; the worst after it, within a fifth of a second; nothing of
what takes more than --limit seconds. Exponents are those of the number of bodies, by least squares of logarithms."""

import numpy as np

import impacts
import study


def walls(dimension, courses):
    return study.scene("wall", dimension, [*study.wall(courses, courses), study.block(
        -3, courses / 4, edges=(1, 1, 1), speed=20, mass=10)], 0.3)


def pile(bodies):
    blocks, _, height = impacts.building("pile", bodies, 2, impacts.random.Random(bodies))
    return study.scene("pile", 2, [*blocks, study.block(-3, height / 2, edges=(1, 1, 1), speed=20, mass=10)], 0.3)


def rows(name, scenes, limit):
    found = []
    for scene in scenes:
        *_, end = [None, *study.frames(scene, limit=limit)]
        bodies, times = len(scene["bodies"]) - 1, 1000 * np.array(end["seconds"]) if end else None
        row = bodies, *((times[0], np.median(times[1:22]), times[22:].max()) if end else (None, None, None))
        found += [row] if end else []
        yield name, *row
    if len(found) > 1:
        whole = np.log(found)
        yield name, "exponent", *(float(np.polyfit(whole[:, 0], column, 1)[0]) for column in whole.T[1:])


def main():
    o = study.options(__doc__, walls=[10, 22, 32], walls_in_space=[10, 22], piles=[100, 500, 1000], limit=600)
    study.show(["scene", "bodies", "first frame, ms", "until the hit", "worst after it"],
               [*rows("wall", [walls(2, n) for n in o.walls], o.limit),
                *rows("wall in space", [walls(3, n) for n in o.walls_in_space], o.limit),
                *rows("pile", map(pile, o.piles), o.limit)])


study.run(main)
