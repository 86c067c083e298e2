# SPDX-License-Identifier: Apache-2.0
"""What comes out of a simulation: tables as CSV and JSON lines, and how its bodies moved."""

import csv
import json
import math
import struct

import cli

FOLDER = cli.ROOT / "corpus" / "scenes"
TABLES = ("bodies", "contacts", "energy", "drift", "motion")
PAGE = cli.ROOT / "corpus" / "formats" / "simulation_tables.md"
RUNS = {"plane": "stack", "space": "space/box-on-slope-slides"}


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def bits(x):
    return struct.pack("<d", float(x))


class Tables(cli.TestCase):
    def simulate(self, scene, *options):
        out = self.folder / scene.replace("/", "-")
        self.succeeds("simulate", FOLDER / f"{scene}.json", "-o", out, "--seconds", "0.25", "--no-svg", "--replace",
                      *options)
        return out

    def test_both_forms_say_the_same_to_the_bit_and_columns_are_those_described(self):
        documented = PAGE.read_text()
        for kind, scene in RUNS.items():
            out = self.simulate(scene, "--tables", "both")
            described = rows_of(out / "columns.csv")
            for row in described:
                self.assertIn(f"| `{row['column']}` |", documented)
            for name in TABLES:
                with self.subTest(kind=kind, table=name):
                    rows = rows_of(out / f"{name}.csv")
                    objects = [json.loads(line) for line in (out / f"{name}.jsonl").read_text().splitlines()]
                    self.assertEqual(len(rows), len(objects))
                    self.assertGreater(len(rows), 0)
                    columns = [row["column"] for row in described if row["table"] == name]
                    self.assertEqual(list(rows[0]), columns)
                    for row, found in zip(rows, objects):
                        self.assertEqual(list(found), columns)
                        for column in columns:
                            if isinstance(found[column], float):
                                self.assertEqual(bits(row[column]), bits(found[column]), column)
                                self.assertEqual(repr(found[column]).replace("e-0", "e-"),
                                                 row[column].replace("e-0", "e-"))
                            else:
                                self.assertEqual(row[column], str(found[column]), column)

    def test_there_is_a_row_for_every_body_of_every_state_and_energies_are_theirs(self):
        out = self.simulate("stack")
        scene = json.loads((FOLDER / "stack.json").read_text())
        bodies, energies = rows_of(out / "bodies.csv"), rows_of(out / "energy.csv")
        count = len(scene["bodies"])
        self.assertEqual(len(bodies), 16 * count)
        self.assertEqual([int(row["step"]) for row in bodies], [k for k in range(16) for _ in range(count)])
        self.assertEqual([row["name"] for row in bodies[:count]], [body["name"] for body in scene["bodies"]])
        self.assertEqual([row["time_s"] for row in bodies[::count]], [row["time_s"] for row in energies])
        contacts = rows_of(out / "contacts.csv")
        self.assertEqual({int(row["step"]) for row in contacts}, set(range(15)))
        self.assertFalse((out / "bodies.jsonl").exists())

    def test_forces_of_contacts_balance_the_weight_of_what_rests(self):
        out = self.simulate("stack")
        scene = json.loads((FOLDER / "stack.json").read_text())
        gravity = abs(float(scene["gravity"][1]))
        sums = {}
        for row in rows_of(out / "contacts.csv"):
            if row["step"] != "14":
                continue
            for name, sign in ((row["name_a"], 1), (row["name_b"], -1)):
                x, y = sums.get(name, (0, 0))
                sums[name] = (x + sign * float(row["fx_N"]), y + sign * float(row["fy_N"]))
        for body in scene["bodies"]:
            if not body.get("fixed"):
                weight = gravity * float(body["mass"])
                self.assertLess(math.hypot(sums[body["name"]][0], sums[body["name"]][1] - weight), 1e-6 * weight)

    def test_the_report_says_what_rests_and_what_slides(self):
        for scene, word in (("incline-rests", "rests"), ("incline-slides", "slides")):
            out = self.folder / scene
            said = cli.run("simulate", FOLDER / f"{scene}.json", "-o", out, "--seconds", 1, "--no-svg", "--json").json()
            motion, = said["motion"]
            self.assertEqual((motion["name"], motion["does"], motion["window_s"]), ("block", word, 0.5))
            row, = rows_of(out / "motion.csv")
            self.assertEqual({key: str(value) for key, value in motion.items() if not isinstance(value, float)},
                             {key: row[key] for key in ("body", "name", "does")})
            for key in ("moved_m", "speed_m_per_s"):
                self.assertEqual(float(row[key]), motion[key])
        text = cli.run("simulate", FOLDER / "incline-slides.json", "-o", out, "--seconds", 1, "--no-svg").out
        self.assertRegex(text, r"in the last 0\.5 s 0 of 1 body that can move rest\n  block slides: moved by \S+ m, \S+ m")

    def test_one_form_or_none_is_written_where_it_is_asked_for(self):
        out = self.simulate("stack", "--tables", "jsonl")
        self.assertTrue((out / "contacts.jsonl").exists() and not (out / "energy.csv").exists())
        out = self.simulate("stack", "--tables", "none")
        self.assertEqual(sorted(file.name for file in out.iterdir() if not file.name.startswith(".")), ["animation.html"])
        self.refuses("simulate", FOLDER / "stack.json", "-o", out, "--tables", "xml", says=["csv", "jsonl"])

    def test_names_are_quoted_and_a_run_with_an_undecided_problem_has_all_tables(self):
        jaw = {"fixed": True, "shapes": [{"box": [1, 1]}]}
        scene = {"format": "stiction-scene", "version": 1, "name": "vice", "dimension": 2, "bodies": [
            {"name": 'left, "the" jaw', "position": [-1.2, 0], "velocity": [1, 0], **jaw},
            {"name": "right\u00e4", "position": [1.2, 0], "velocity": [-1, 0], **jaw},
            {"name": "block", "mass": "1", "shapes": [{"box": [1, 1]}]}]}
        out = self.folder / "vice"
        done = cli.run("simulate", self.file("vice.json", scene), "-o", out, "--no-svg", "--tables", "both")
        self.assertEqual(done.code, 3)
        bodies = rows_of(out / "bodies.csv")
        self.assertEqual([row["name"] for row in bodies[:3]], ['left, "the" jaw', "right\u00e4", "block"])
        self.assertEqual(json.loads((out / "bodies.jsonl").read_text().splitlines()[0])["name"], 'left, "the" jaw')
        self.assertGreater(len(bodies), 6)


if __name__ == "__main__":
    cli.main()
