# SPDX-License-Identifier: Apache-2.0
"""stiction search --objective, problem --best, minimize --as-scene, records: from a seed to a record that holds."""

import contextlib
import json
import shutil
import sqlite3
import subprocess
import sys
import unittest
from fractions import Fraction

import cli


class Adversary(cli.TestCase):
    def search(self, store, *options, code=0):
        return self.succeeds("search", "--store", store, "--json", *options, code=code)

    def test_a_scene_is_made_worse_then_simpler_and_stays_a_scene(self):
        store, best, simple = (self.folder / name for name in ("s", "best.json", "simple.json"))
        summary = self.search(store, "--objective", "friction", "--generator", "scenes", "--contacts", 4, "--mu", 1,
                              "--gravity-only", "--problems", 8000).json()
        self.assertEqual((summary["objective"], summary["optimizer"]), ("friction", "evolution"))
        self.assertGreaterEqual(summary["candidates"], 7900)
        self.assertLess(summary["best"][0]["value"], 1)
        self.succeeds("problem", store, "--best", "-o", best)
        problem = json.loads(best.read_text())
        self.assertTrue(all(body.get("force", ["0", "0"]) == ["0", "0"] for body in problem["scene"]["bodies"]))
        mu = {contact["mu"] for contact in problem["contacts"]}
        self.assertEqual(len(mu), 1)
        self.succeeds("replay", best, "--json", code=1)
        self.succeeds("minimize", best, "--as-scene", "-o", simple)
        self.refuses("minimize", best, "--as-scene", "--keep", "solved", "-o", "-", says=["--keep", "solved", "choices"])
        simpler = json.loads(simple.read_text())
        self.assertIn("scene", simpler)
        self.assertEqual(simpler["expect"], {"paper": "cycle"})
        self.assertEqual(self.succeeds("replay", simple, "--json").json()["outcome"], "cycle")
        assembled = self.folder / "assembled.json"
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps(simpler["scene"]))
        self.succeeds("assemble", scene, "--full", "-o", assembled)
        again = json.loads(assembled.read_text())
        self.assertEqual((again["A"], again["b"]), (simpler["A"], simpler["b"]))

    @unittest.skipUnless(cli.ALL, "long")
    def test_threads_and_pieces_leave_the_same_store(self):
        options = ["--objective", "period", "--generator", "psd", "--contacts", 2, "--mu", 1, "--optimizer", "continuation",
                   "--finishing", 100]
        one, two = self.folder / "one", self.folder / "two"
        self.search(one, *options, "--problems", 90000, "--threads", 1)
        for problems in (30000, 60000, 90000):
            self.search(two, *options, "--problems", problems, "--threads", 3)
        self.assertSameContent(one, two)

    def test_a_search_goes_on_from_the_problem_of_another(self):
        first, best, second = (self.folder / name for name in ("one", "best.json", "two"))
        options = ["--objective", "pivot", "--generator", "psd", "--contacts", 2, "--mu", 1, "--problems", 10000]
        value = self.search(first, *options).json()["best"][0]["value"]
        self.succeeds("problem", first, "--best", "-o", best)
        later = self.search(second, *options, "--seed", 2, "--from", best).json()["best"][0]["value"]
        self.assertGreaterEqual(later, value)
        again = self.search(second, *options, "--seed", 2, "--from", best).json()  # goes on where it stopped: at its end
        self.assertEqual((again["best"][0]["value"], again["candidates"]), (later, 10000))
        self.refuses("search", *options, "--seed", 2, "--store", second, says=["parents"])
        self.refuses("search", "--objective", "pivot", "--generator", "integers", "--from", best, "--store",
                     self.folder / "s", says=["parents", "psd"])
        self.refuses("search", "--generator", "psd", "--from", best, "--store", self.folder / "s",
                     says=["parents", "--objective"])
        in_space = cli.ROOT / "corpus/space/ray-under-slip-literal.json"
        self.refuses("search", *options, "--from", in_space, "--store", self.folder / "s",
                     says=["ray-under-slip-literal", "in space", "planar"])

    def test_a_search_starts_from_problems_records_findings_stores_and_folders(self):
        loops, folder = self.folder / "loops", self.folder / "problems"
        self.search(loops, "--generator", "psd", "integers", "--contacts", 2, "--mu", 1, "--problems", 40000,
                    "--finishing", 0)
        with contextlib.closing(sqlite3.connect(loops)) as db:
            found = db.execute("SELECT signature FROM findings WHERE generator = 'psd' ORDER BY signature").fetchall()
        options = ["--objective", "period", "--generator", "psd", "--mu", 1, "--problems", 200, "--finishing", 0]

        def parents(*sources, contacts=(2,)):
            store = self.folder / f"s{len(list(self.folder.iterdir()))}"
            best = self.search(store, *options, "--contacts", *contacts, "--from", *sources).json()["best"]
            with contextlib.closing(sqlite3.connect(store)) as db:
                (definition,) = db.execute("SELECT value FROM campaign WHERE key = 'definition'").fetchone()
            return json.loads(definition)["parents"], best

        finding, best = parents(f"{loops}:{found[0][0]}")
        self.assertEqual(len(finding), 1)
        self.assertTrue(best)  # it loops
        of_store, _ = parents(loops)
        self.assertEqual(len(of_store), len(found))  # those of integers do not fit
        self.assertIn(finding[0], of_store)
        record = cli.ROOT / "corpus/records/condition-mu-1-2-contacts.json"
        folder.mkdir()
        shutil.copy(record, folder)
        shutil.copy(cli.ROOT / "corpus/space/ray-under-slip-literal.json", folder)
        self.assertEqual(parents(record)[0], parents(folder)[0])
        near, _ = parents(cli.ROOT / "corpus/records/period-2-contacts.json")  # of near-degenerate, which is not searched
        self.assertEqual((near[0]["generator"], near[0]["contacts"]), ("psd", 2))
        near, best = parents(cli.ROOT / "corpus/cycle-every-policy-mu-1.json", contacts=(3,))
        self.assertEqual((near[0]["generator"], near[0]["contacts"]), ("psd", 2))
        self.assertTrue(best)  # beside a third contact it loops
        (folder / "condition-mu-1-2-contacts.json").unlink()
        self.refuses("search", *options, "--contacts", 2, "--from", folder, "--store", self.folder / "s",
                     says=["problems", "--generator"])

    def test_how_far_a_loop_may_move(self):
        loop = cli.ROOT / "corpus/two-contact-cycle-every-policy-period-4.json"
        rows = self.succeeds("certify", loop, "--robust", "--json").json()
        self.assertEqual([row["policy"] for row in rows], ["paper"])
        self.assertGreater(Fraction(rows[0]["radius"]), Fraction(1, 100000))
        tied = self.file("p.json", cli.REFERENCE)
        self.assertIsNone(self.succeeds("certify", tied, "--robust", "--json", code=3).json()[0]["radius"])
        for other in (["--all"], ["--safe"], ["-o", self.folder / "c.json"]):
            self.refuses("certify", loop, "--robust", *other, says=["--robust", "alone"])
        sliding = cli.ROOT / "corpus/sliding/cycle-of-sliding-contacts.json"
        self.refuses("certify", sliding, "--robust", says=["kind", "robustness"])

    def test_how_far_all_that_a_scene_is_built_of_may_be_off(self):
        problem = self.folder / "p.json"
        self.succeeds("assemble", cli.ROOT / "corpus/scenes/block-in-a-valley.json", "--full", "-o", problem)
        row, = self.succeeds("certify", problem, "--robust", "--json").json()
        self.assertGreater(Fraction(row["scene_radius"]), Fraction(1, 10000))
        self.assertGreater(Fraction(row["scene_radius"]), Fraction(row["radius"]))
        told = self.succeeds("certify", problem, "--robust").out.splitlines()
        self.assertIn(f"loops for all scenes within {row['scene_radius']} of these", told[1])
        solved = self.succeeds("certify", problem, "--robust", "--json", "--policy", "scan=highest", code=3).json()[0]
        self.assertEqual((solved["radius"], solved["scene_radius"]), (None, None))

        def changed(change):
            content = json.loads(problem.read_text())
            change(content)
            return self.file("changed.json", content)

        moving = changed(lambda p: p["scene"]["bodies"][2].update(velocity=["1", "0"]))
        self.refuses("certify", moving, "--robust", says=["scene.bodies[2]", "velocity", "at rest"])
        other = changed(lambda p: p["scene"]["bodies"][2].update(mass="2"))
        self.refuses("certify", other, "--robust", says=["scene", "another problem"])
        unread = changed(lambda p: p.update(scene={"format": "mine"}))
        self.refuses("certify", unread, "--robust", says=["scene", "stiction-scene"])

    def test_what_cannot_be_is_refused(self):
        store = self.folder / "s"
        self.refuses("search", "--objective", "nothing", "--store", store, says=["--objective", "friction"])
        self.refuses("search", "--optimizer", "continuation", "--store", store, says=["--optimizer", "--objective"])
        self.refuses("search", "--gravity-only", "--generator", "psd", "--store", store, says=["psd", "bodies"])
        self.refuses("search", "--mu", "1/100", "--generator", "near-degenerate", "--store", store,
                     says=["near-degenerate", "1/100"])
        self.search(store, "--objective", "steps", "--generator", "psd", "--contacts", 2, "--problems", 10000)
        self.refuses("problem", store, 0, 0, says=["--best"])
        random = self.folder / "random"
        self.search(random, "--generator", "psd", "--contacts", 2, "--problems", 10000)
        self.refuses("problem", random, "--best", says=["no search with an objective"])
        self.refuses("problem", random, "--best", "--exponential", 3, says=["--best"])
        self.refuses("minimize", self.file("p.json", cli.REFERENCE), "--as-scene", "-o", "-", says=["origin", "choices"])


class Records(cli.TestCase):
    FOLDER = "corpus/records"

    def test_all_records_hold(self):
        rows = self.succeeds("records", "--folder", cli.ROOT / self.FOLDER, "--check", "--json").json()
        self.assertTrue(rows)
        self.assertEqual([row["frontier"] for row in rows if row["fault"] is not None], [])

    @unittest.skipUnless(cli.ALL, "long")
    def test_the_independent_checker_accepts_their_certificates(self):
        for file in sorted((cli.ROOT / self.FOLDER).glob("*.json")):
            with self.subTest(record=file.stem):
                record = json.loads(file.read_text())
                certificate = self.file("certificate.json", record["certificate"])
                problem = self.file("problem.json", record["problem"])
                done = subprocess.run([sys.executable, cli.ROOT / "certify/check_certificate.py", certificate,
                                       "--problem", problem], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @unittest.skipUnless(cli.ALL, "long")
    def test_no_record_is_beaten_by_others_side_by_side(self):
        folder = self.folder / "records"
        shutil.copytree(cli.ROOT / self.FOLDER, folder)
        done = subprocess.run([sys.executable, cli.ROOT / "tests/setup/close_records.py", cli.program, folder],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        (folder / "descents-6-contacts.json").write_bytes((folder / "descents-5-contacts.json").read_bytes())
        done = subprocess.run([sys.executable, cli.ROOT / "tests/setup/close_records.py", cli.program, folder],
                              capture_output=True, text=True, timeout=300)
        self.assertIn("10 -> 16: descents-3-contacts and descents-3-contacts", done.stdout)

    def test_a_record_is_made_and_a_false_one_caught(self):
        problem = self.file("p.json", cli.REFERENCE)
        folder = self.folder / "records"
        folder.mkdir()
        self.succeeds("records", "--folder", folder, "--add", problem, "--frontier", "period", "--what", "a test",
                      "--objective", "period", "--command", "none", "--seconds", 1, "--random-command", "nothing drawn")
        self.succeeds("records", "--folder", folder, "--check")
        record = json.loads((folder / "period.json").read_text())
        record["value"] = "99"
        (folder / "period.json").write_text(json.dumps(record))
        done = self.succeeds("records", "--folder", folder, "--check", code=1)
        self.assertIn("DOES NOT HOLD", done.out)
        self.refuses("records", "--folder", folder, "--add", problem, says=["--frontier"])
        self.refuses("records", "--folder", self.folder / "none", says=["none"])


if __name__ == "__main__":
    cli.main()
