# SPDX-License-Identifier: Apache-2.0
"""stiction draw: numbers, cones, gravity, scales and pins of a scene; PNG and PDF.

draw_test.py PATH_TO_STICTION
"""
import json
import math
import os
import re
import shutil
import struct
import unittest
import xml.etree.ElementTree as xml
from fractions import Fraction

import cli

SCENES = cli.ROOT / "corpus/scenes"
SVG = "{http://www.w3.org/2000/svg}"


class Draw(cli.TestCase):
    def drawn(self, scene):
        done = cli.run("draw", SCENES / f"{scene}.json", "-o", "-")
        self.assertEqual(done.code, 0, done.err)
        return xml.fromstring(done.out)

    def words(self, picture):
        return [text.text for text in picture.iter(f"{SVG}text")]

    def numbers(self, path):
        return [float(x) for x in re.findall(r"-?\d+\.?\d*", path)]

    def test_contacts_have_the_numbers_of_assemble(self):
        for scene in ("stack", "space/stack"):
            told = self.succeeds("assemble", SCENES / f"{scene}.json", "-o", self.folder / "p.json", "--explain").out
            numbers = [word for word in self.words(self.drawn(scene)) if word.isdigit()]
            self.assertEqual(numbers, [str(i) for i in range(1, len(numbers) + 1)])
            self.assertGreater(len(numbers), 1)
            self.assertTrue(re.search(rf"\b{len(numbers)} contacts", told) or f"contact {len(numbers)}" in told, told)

    def test_cones_are_as_wide_as_friction(self):
        picture, scene = self.drawn("stack"), json.loads((SCENES / "stack.json").read_text())
        cones = [path.get("d") for path in picture.iter(f"{SVG}path") if path.get("stroke") == "#2a7d2a"]
        self.assertEqual(len(cones), len([word for word in self.words(picture) if word.isdigit()]))
        mu = float(Fraction(scene["mu"]))
        for cone in cones:
            x, y, left_x, left_y, _, _, right_x, right_y = self.numbers(cone)
            angle = abs(math.atan2(left_x - x, left_y - y) - math.atan2(right_x - x, right_y - y))
            self.assertAlmostEqual(min(angle, 2 * math.pi - angle) / 2, math.atan(mu), delta=0.02)

    def test_forces_and_lengths_are_to_the_scales(self):
        """Forces of a block at rest add to its weight, by the arrow of the scale."""
        picture = self.drawn("incline-rests")
        force, = [word for word in self.words(picture) if " N;" in word]
        arrow, = [self.numbers(path.get("d")) for path in picture.iter(f"{SVG}path") if path.get("stroke") == "#d00000"]
        pixels_a_newton = abs(arrow[4] - arrow[0]) / float(force.split()[0])
        scene = json.loads((SCENES / "incline-rests.json").read_text())
        total = [0.0, 0.0]
        for line in picture.iter(f"{SVG}line"):
            self.assertFalse(line.get("stroke-dasharray"))
            x1, y1, x2, y2 = (float(line.get(name)) for name in ("x1", "y1", "x2", "y2"))
            total = [total[0] + x2 - x1, total[1] + y2 - y1]
        moving = [body for body in scene["bodies"] if not body.get("fixed")]
        weight = sum(float(Fraction(body["mass"])) for body in moving) * math.hypot(*map(float, scene["gravity"]))
        self.assertAlmostEqual(math.hypot(*total) / pixels_a_newton / weight, 1, delta=0.05)
        self.assertTrue(any(word.endswith(" m") for word in self.words(picture)))
        self.assertTrue(any(word.startswith("gravity ") for word in self.words(picture)))

    def test_joints_are_pins(self):
        picture = self.drawn("double-pendulum")
        self.assertEqual(len([c for c in picture.iter(f"{SVG}circle") if c.get("r") == "7"]), 2)
        self.assertFalse([word for word in self.words(picture) if " N;" in word])  # nothing to scale

    @unittest.skipUnless(shutil.which("rsvg-convert"), "librsvg2-bin is not installed")
    def test_png_and_pdf(self):
        for scene in ("stack", "space/conical-pendulum"):
            for end, begins in (("png", b"\x89PNG\r\n"), ("pdf", b"%PDF-")):
                one, other = self.folder / f"a.{end}", self.folder / f"b.{end}"
                for file in (one, other):
                    self.succeeds("draw", SCENES / f"{scene}.json", "-o", file)
                self.assertTrue(one.read_bytes().startswith(begins))
                self.assertEqual(one.read_bytes(), other.read_bytes())
            width, = struct.unpack(">I", (self.folder / "a.png").read_bytes()[16:20])
            self.assertEqual(width, 1600)

    def test_without_the_converter_its_package_is_named(self):
        path = os.environ["PATH"]
        os.environ["PATH"] = str(self.folder)
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        self.refuses("draw", SCENES / "stack.json", "-o", self.folder / "a.png", says="librsvg2-bin")
        self.assertFalse((self.folder / "a.png").exists())
        self.succeeds("draw", SCENES / "stack.json", "-o", self.folder / "a.svg")


if __name__ == "__main__":
    cli.main()
