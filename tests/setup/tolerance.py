#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Would somebody who builds this scene see the loop? Draws scenes like it, every dimension a little off, and counts how
often the published algorithm still loops, exactly. A sample, and no proof: `certify --robust` proves less.

    tests/setup/tolerance.py build/release/stiction SCENE.json [--percent 1] [--draws 1000] [--policy paper]

Off by up to so many percent, each by itself and independent: masses, moments of inertia, friction coefficients; both
coordinates of every centre of mass and of every contact point, in percent of the largest distance between a contact and
the centre of a body that it touches; every normal and the direction of gravity, a percent being a hundredth of a radian.
Bodies are as they are drawn: whether they still touch where their contacts are is not asked.
SCENE: a scene of the plane, or a problem with one: contacts that are given, with points and normals, or bodies of polygons
that touch; no joints.
"""

import argparse
import json
import math
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path


def number(text):
    return float(Fraction(text))


def shown(x):
    return str(Fraction(x).limit_denominator(10**9))


def corners_of(shape):
    """In the coordinates of the body; of a disc none."""
    if "box" in shape:
        (w, h), (u, v) = map(number, shape["box"]), map(number, shape.get("center", ["0", "0"]))
        return [(u + i * w / 2, v + j * h / 2) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [(number(u), number(v)) for u, v in shape.get("polygon", [])]


class Scene:
    """Bodies as points with mass and inertia, contacts as points with normals."""

    def __init__(self, program, file):
        self.program = program
        content = json.loads(Path(file).read_text())
        scene = content.get("scene", content)
        self.gravity = [number(x) for x in scene["gravity"]]
        self.bodies = {body["name"]: body for body in scene["bodies"]}
        self.mu = {frozenset(pair["bodies"]): number(pair["mu"]) for pair in scene.get("pairs", []) if "mu" in pair}
        self.usual_mu = number(scene.get("mu", "0"))
        self.contacts = [(*contact["bodies"], [number(x) for x in contact["at"]], [number(x) for x in contact["normal"]])
                         for contact in scene.get("contacts", [])] or self.found(file)
        for name, body in self.bodies.items():
            if not body.get("fixed") and not {"mass", "inertia"} <= set(body):
                sys.exit(f"{file}: {name}: found no mass or no inertia, expected both as numbers")
        self.size = max(math.dist(point, self.place(name)) for a, b, point, _ in self.contacts
                        for name in (a, b) if not self.bodies[name].get("fixed"))

    def found(self, file):
        """Contacts of a scene that gives none."""
        with tempfile.TemporaryDirectory() as folder:
            told = subprocess.run([self.program, "assemble", file, "--full", "--explain", "-o", Path(folder) / "p.json"],
                                  capture_output=True, text=True, check=True).stdout
        found = re.findall(r"contact \d+ \((.*?) on (.*?), at \(([^,]*), ([^)]*)\)\)", told)
        return [(a, b, (float(x), float(y)), self.normal(a, b, (float(x), float(y)))) for a, b, x, y in found]

    def place(self, name):
        return [number(x) for x in self.bodies[name].get("position", ["0", "0"])]

    def edges(self, name):
        body = self.bodies[name]
        (x, y), (c, s) = self.place(name), [number(v) for v in body.get("rotation", ["1", "0"])]
        for shape in body["shapes"]:
            corners = [(x + c * u - s * v, y + s * u + c * v) for u, v in corners_of(shape)]
            yield from zip(corners, corners[1:] + corners[:1])

    def normal(self, a, b, point):
        """Of the edge that the point is on, from b to a: the edge whose ends are farthest, where there are several."""
        best = None
        for name, sign in ((a, -1), (b, 1)):
            for p, q in self.edges(name):
                length = math.dist(p, q)
                t = ((point[0] - p[0]) * (q[0] - p[0]) + (point[1] - p[1]) * (q[1] - p[1])) / length**2
                away = abs((q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0])) / length
                if away > 1e-4 * length or not 0 <= t <= 1:
                    continue
                inside = min(t, 1 - t) * length
                if best is None or inside > best[0]:
                    best = inside, (sign * (q[1] - p[1]) / length, sign * (p[0] - q[0]) / length)
        if best is None:
            sys.exit(f"contact of {a} and {b} at {point}: found no edge there, expected polygons")
        return best[1]

    def drawn(self, draw, part):
        """The scene with everything off by up to this part; `draw` is random."""
        off = lambda: part * draw.uniform(-1, 1)
        turned = lambda v, angle: (v[0] * math.cos(angle) - v[1] * math.sin(angle),
                                   v[0] * math.sin(angle) + v[1] * math.cos(angle))
        moved = lambda p: [shown(x + self.size * off()) for x in p]
        bodies = []
        for name, body in self.bodies.items():
            one = {"name": name, "position": [shown(x) for x in self.place(name)]}
            if body.get("fixed"):
                one["fixed"] = True
            else:
                one.update(mass=shown(number(body["mass"]) * (1 + off())), position=moved(self.place(name)),
                           inertia=shown(number(body["inertia"]) * (1 + off())))
            bodies.append(one)
        pairs = [{"bodies": sorted(pair), "mu": shown(mu * (1 + off()))} for pair, mu in self.mu.items()]
        contacts = [{"bodies": [a, b], "at": moved(point), "normal": [shown(x) for x in turned(normal, off())]}
                    for a, b, point, normal in self.contacts]
        return {"format": "stiction-scene", "version": 1, "name": "drawn", "dimension": 2, "mu": shown(self.usual_mu * (1 + off())),
                "gravity": [shown(x) for x in turned(self.gravity, off())], "bodies": bodies, "contacts": contacts,
                "pairs": pairs}

    def end(self, scene, policy, folder):
        """How the published algorithm ends on it, exactly."""
        file, problem = folder / "scene.json", folder / "problem.json"
        file.write_text(json.dumps(scene))
        subprocess.run([self.program, "assemble", file, "--full", "-o", problem], check=True, capture_output=True)
        done = subprocess.run([self.program, "solve", problem, "--method", "baraff", "--arithmetic", "exact", "--policy",
                               policy, "--json"], capture_output=True, text=True)
        if not done.stdout:
            sys.exit(done.stderr)
        return json.loads(done.stdout)["outcome"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--percent", type=float, nargs="+", default=[1.0])
    parser.add_argument("--draws", type=int, default=1000)
    parser.add_argument("--policy", default="paper")
    parser.add_argument("--seed", type=int, default=1)
    o = parser.parse_args()
    scene = Scene(o.program, o.scene)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if scene.end(scene.drawn(random.Random(0), 0), o.policy, folder) != "cycle":
            sys.exit(f"{o.scene}: found no loop without any change, expected one")
        for percent in o.percent:
            draw = random.Random(f"{o.seed} {percent}")
            ends = [scene.end(scene.drawn(draw, percent / 100), o.policy, folder) for _ in range(o.draws)]
            counts = ", ".join(f"{ends.count(end)} {end}" for end in sorted(set(ends)))
            print(f"{percent:g} %: of {o.draws}: {counts}", flush=True)


if __name__ == "__main__":
    main()
