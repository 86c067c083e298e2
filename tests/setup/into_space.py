#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts a scene of the plane into space, and prints how section 5.6 ends there: over intervals, which prove, over doubles,
and exactly where the run in the plane tells.

    tests/setup/into_space.py build/release/stiction SCENE.json -o PROBLEM.json

The plane becomes y and z. Bodies keep mass, centre and moment of inertia, which they get about y and z, too, so that
they are symmetric about the plane; contacts stay where they are, with their normals, as given ones. So the rows of the
plane are rows in space; the second tangents are along x, along which nothing accelerates and which no old row is coupled
with (search/adversary/frontiers.md, part 6).
SCENE: a scene of the plane, a problem with one, or a record of such a problem; at rest, without joints. PROBLEM carries
its scene, and, in "expect", the readings of space under which intervals or doubles find a loop.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

READINGS = ("paper", "slip=redirect")


def number(text):
    return Fraction(text)


def place(body, local):
    """A point of the body in the world."""
    (x, y), (c, s) = map(number, body["position"]), map(number, body["rotation"])
    u, v = map(number, local)
    return x + c * u - s * v, y + s * u + c * v


def direction(body, local):
    return place({**body, "position": ["0", "0"]}, local)


def in_space(v):
    return ["0", *map(str, v)]


def body_in_space(body):
    one = {"name": body["name"], "position": in_space(body["position"])}
    if body.get("fixed"):
        return {**one, "fixed": True}
    return {**one, "mass": body["mass"], "inertia": [body["inertia"]] * 3, "force": in_space(body["force"]),
            "torque": [body["torque"], "0", "0"]}


def contact_in_space(bodies, contact):
    a, b = contact["bodies"]
    return {"bodies": [a, b], "at": in_space(place(bodies[b], contact["anchors"][1])),
            "normal": in_space(direction(bodies[b], contact["axis"]))}


def scene_in_space(scene):
    """Of one as `assemble --given` writes it."""
    if scene["dimension"] != 2 or scene["joints"]:
        sys.exit("found a scene of space or with joints, expected one of the plane without")
    bodies = {body["name"]: body for body in scene["bodies"]}
    if any(number(x) != 0 for body in bodies.values() for x in (*body["velocity"], body["spin"])):
        sys.exit("found a body that moves, expected a scene at rest")
    return {"format": "stiction-scene", "version": 1, "name": scene["name"], "dimension": 3,
            "note": "a scene of the plane, in the plane x = 0",
            "gravity": in_space(scene["gravity"]), "mu": scene["mu"],
            "bodies": [body_in_space(body) for body in bodies.values()],
            "contacts": [contact_in_space(bodies, contact) for contact in scene["contacts"]],
            "pairs": [{"bodies": pair["bodies"], "mu": pair["mu"]} for pair in scene["pairs"] if "mu" in pair]}


def run(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode not in (0, 1, 3):
        sys.exit(done.stderr)
    return done.stdout


def given(program, file, folder):
    """The scene of the file, its contacts given."""
    content = json.loads(Path(file).read_text())
    scene, out = folder / "scene.json", folder / "given.json"
    scene.write_text(json.dumps(content.get("problem", content)))
    run(program, "assemble", scene, "--full", "--given", out, "-o", folder / "planar.json")
    return json.loads(out.read_text())


def ends(program, problem, policy, arithmetic):
    """What solve says, as a dict."""
    return json.loads(run(program, "solve", problem, "--method", "baraff", "--arithmetic", arithmetic, "--policy", policy,
                          "--json"))


# ---- What the plane proves -------------------------------------------------------------------------------------


def planar_part(problem):
    """The problem of the normals and first tangents, or None: nothing else may be coupled with them or accelerate."""
    A, b = problem["A"], problem["b"]
    kept = [row for row in range(len(b)) if row % 3 < 2]
    for row in range(2, len(b), 3):
        if number(b[row]) != 0 or any(number(A[row][k]) != 0 or number(A[k][row]) != 0 for k in kept):
            return None
    return {"format": "stiction-problem", "version": 1, "name": problem["name"], "dimension": 2,
            "contacts": problem["contacts"], "A": [[A[i][k] for k in kept] for i in kept], "b": [b[i] for i in kept]}


def mirrored(planar):
    """With every tangent reversed."""
    sign = lambda i, k=0: -1 if (i + k) % 2 else 1
    return {**planar, "A": [[str(sign(i, k) * number(x)) for k, x in enumerate(row)] for i, row in enumerate(planar["A"])],
            "b": [str(sign(i) * number(x)) for i, x in enumerate(planar["b"])]}


def exact_run(program, planar, folder):
    file = folder / "plane.json"
    file.write_text(json.dumps(planar))
    return json.loads(run(program, "replay", file, "--json"))


OPPOSITE = {"NC-": "NC+", "NC+": "NC-"}


def jumps(run):
    """Whether friction goes from NC- through CF to NC+, or back, within a drive, the latter by a step of length zero: in
    space that is back to the set it came from, and given up."""
    left = {}  # in this drive
    for step in run["pivots"]:
        variable = (step["drive"], step["limiting"])
        if step["from"] == "CF" and number(step["step"]) == 0 and step["to"] == OPPOSITE.get(left.get(variable)):
            return True
        left[variable] = step["from"]
    return False


def moves(run, swap):
    return [(step["drive"], step["limiting"], *(OPPOSITE.get(s, s) if swap else s for s in (step["from"], step["to"])))
            for step in run["pivots"]]


def loop_by_the_plane(program, problem):
    """(drives before, drives of a period) of the loop in space, exactly, under `paper` and either reading of space, if that
    of the plane proves it; otherwise None. Where NC- and NC+ would tie, the plane takes NC- and space the lower index:
    then the run with all tangents reversed is another one."""
    planar = planar_part(problem)
    if planar is None:
        return None
    with tempfile.TemporaryDirectory() as name:
        there, back = (exact_run(program, p, Path(name)) for p in (planar, mirrored(planar)))
    if there["outcome"] != "cycle" or jumps(there) or moves(there, False) != moves(back, True):
        return None
    return there["start"], there["period"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--name", help="of the scene in space; by default that of the plane")
    parser.add_argument("-o", "--output", required=True)
    o = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = scene_in_space(given(o.program, o.scene, folder))
        scene["name"] = o.name or scene["name"]
        (folder / "space.json").write_text(json.dumps(scene))
        run(o.program, "assemble", folder / "space.json", "--full", "-o", o.output)
    expect = {}
    for policy in READINGS:
        found = [ends(o.program, o.output, policy, arithmetic)["outcome"] for arithmetic in ("interval", "double")]
        print(f"{policy}: {found[0]} over intervals, {found[1]} over doubles")
        if "cycle" in found:
            expect[policy] = "cycle"
    text = Path(o.output).read_text()
    print("exactly, by the plane:", loop_by_the_plane(o.program, json.loads(text)))
    if expect:
        Path(o.output).write_text(text.rstrip().removesuffix("}").rstrip() + f',\n  "expect": {json.dumps(expect)}\n}}\n')


if __name__ == "__main__":
    main()
