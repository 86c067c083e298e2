# SPDX-License-Identifier: Apache-2.0
"""stiction search, status, merge and report: the same units leave the same store, however they were run."""

import json
import shutil
import sqlite3
import subprocess
import tempfile
import time
import unittest
from fractions import Fraction
from pathlib import Path

import cli

PROBLEMS = 190000  # 1036 units: one block and some
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 4, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "first_unit_problems": 220, "unit_problems": 220, "enumerate_every": 3}


class Search(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.common = Path(tempfile.mkdtemp(prefix="stiction-search-"))
        cls.campaign = cls.common / "campaign.json"
        cls.campaign.write_text(json.dumps(CAMPAIGN))
        cls.reference = cls.common / "reference.store"
        cls.done = cls.search(cls.reference, "--threads", 1)
        assert cls.done.code == 0, cls.done.err

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.common)

    @classmethod
    def search(cls, store, *arguments, problems=PROBLEMS):
        return cli.run("search", cls.campaign, "--store", store, "--problems", problems, "--finishing", 100, *arguments)

    def completes(self, store, *arguments, **options):
        done = self.search(store, *arguments, **options)
        self.assertEqual(done.code, 0, done.err)
        return done

    def copy(self, name):
        return Path(shutil.copy(self.reference, self.folder / name))

    # ---- The same content ----

    def test_the_reference_has_what_is_compared_below(self):
        rows = cli.content(self.reference)
        self.assertEqual(len(rows["blocks"]), 1)
        self.assertGreater(len(rows["units"]), 5)
        self.assertGreater(len(rows["findings"]), 2)
        tallies, signatures = cli.total(self.reference)
        self.assertGreaterEqual(sum(tally["problems"] for tally in tallies.values()), PROBLEMS)
        for tally in tallies.values():
            self.assertEqual(sum(tally["outcomes"]), tally["problems"])
            self.assertEqual(sum(tally["steps"]), tally["problems"])
        self.assertGreaterEqual(set(signatures), {row[0] for row in rows["findings"]})
        with sqlite3.connect(self.reference) as db:
            pending = db.execute("SELECT COUNT(*) FROM findings WHERE done = 0").fetchone()
        db.close()
        self.assertEqual(pending, (0,))  # a campaign run to the end has finished them all

    def test_threads_do_not_matter(self):
        for threads in (2, 3):
            self.completes(self.folder / f"{threads}.store", "--threads", threads)
            self.assertSameContent(self.folder / f"{threads}.store", self.reference)

    def test_a_resumed_search_is_the_same_as_one_in_one_go(self):
        store = self.folder / "a.store"
        for problems in (1, 30000, 30001, 120000, PROBLEMS):
            self.completes(store, "--threads", 2, problems=problems)
        self.assertSameContent(store, self.reference)

    def test_a_finished_campaign_stays_as_it_is(self):
        store = self.copy("a.store")
        for problems in (PROBLEMS, PROBLEMS, 1000):
            done = self.completes(store, problems=problems)
            self.assertSameContent(store, self.reference)
            self.assertEqual(cli.unwrapped(done.out.replace(str(store), "")),
                             cli.unwrapped(self.done.out.replace(str(self.reference), "")))

    def test_options_mean_the_same_as_a_campaign_file(self):
        by_options, by_file = self.folder / "o.store", self.folder / "f.store"
        common = ["--problems", 5000, "--finishing", 100, "--store"]
        self.succeeds("search", *common, by_options, "--generator", "psd", "small", "--contacts", 2, 3, "--mu", "1/2",
                      "1", "--policy", "paper", "ties=contacts,scan=highest", "--seed", 9)
        file = self.file("c.json", {
            "format": "stiction-campaign", "version": 1, "seed": 9, "generators": ["psd", "small"],
            "contacts": [2, 3], "mu": ["0.5", "1"], "policies": ["paper", "scan=highest,ties=contacts"]})
        self.succeeds("search", file, *common, by_file)
        self.assertSameContent(by_options, by_file)

    def test_friction_may_be_any_rational(self):
        store = self.folder / "a.store"
        for mu in ("1234567/10000000", "0.1234567", "1e-9", "2147483647/2147483646", "0"):
            self.succeeds("search", "--generator", "psd", "scenes", "--contacts", 2, "--problems", 20000, "--mu", mu,
                          "--store", store)
            problem = self.succeeds("problem", store, 0, 0).out
            self.assertEqual({Fraction(contact["mu"]) for contact in json.loads(problem)["contacts"]}, {Fraction(mu)})
            store.unlink()
        self.refuses("search", "--generator", "near-degenerate", "--mu", "1/65", "--store", store, says="at most 64")

    # ---- Shards and merging ----

    def test_merged_shards_are_the_unsharded_search(self):
        shards = [self.folder / f"{i}.store" for i in range(2)]
        for i, shard in enumerate(shards):
            self.completes(shard, "--threads", 1, "--shard", f"{i}/2")
        merged = self.folder / "merged.store"
        self.succeeds("merge", merged, *shards)
        self.assertEqual(cli.total(merged), cli.total(self.reference))
        self.assertSameContent(merged, self.reference, ["campaign", "findings"])
        before = [cli.content(shard) for shard in shards]

        # In another order, and as often as you like.
        other = self.folder / "other.store"
        self.succeeds("merge", other, shards[1])
        self.succeeds("merge", other, merged, shards[0], other)
        self.assertSameContent(other, merged)
        self.assertEqual([cli.content(shard) for shard in shards], before)

        # Both shards into one file.
        both = self.folder / "both.store"
        for i in (1, 0):
            self.completes(both, "--shard", f"{i}/2")
        self.assertSameContent(both, merged)

        # A search goes on where the merged stores stopped: there is nothing left to do.
        self.completes(merged)
        self.assertSameContent(merged, other)

    def test_units_of_overlapping_shards_are_refused(self):
        half = self.folder / "half.store"
        self.completes(half, "--shard", "0/2")
        out = self.copy("out.store")
        self.refuses("merge", out, half, says="unit")
        self.assertSameContent(out, self.reference)

    def test_two_copies_of_a_block_that_differ_exit_with_70_and_name_it(self):
        changed, out = self.copy("changed.store"), self.copy("out.store")
        cli.change(changed, "UPDATE blocks SET record = replace(record, '\"wrong\":0', '\"wrong\":1')")
        done = cli.run("merge", out, changed)
        self.assertEqual(done.code, 70)
        self.assertIn("block 0 of shard 0/1", done.err)
        self.assertSameContent(out, self.reference)

    def test_merge_refuses_what_does_not_belong_together(self):
        other = self.folder / "other.store"
        self.completes(other, "--seed", 5, problems=1)
        out = self.folder / "out.store"
        self.refuses("merge", out, self.reference, other, says=["seed", "4", "5"])
        self.refuses("merge", other, self.reference, says=["seed", "4", "5"])
        for wrong in (self.folder / "none.store", self.file("text", "no store " * 99), self.folder):
            self.refuses("merge", self.folder / "new.store", wrong, says=wrong)
            self.assertFalse((self.folder / "new.store").exists())

    # ---- Families ----

    FAMILIES = ("-g", "integers", "bodies", "scenes", "psd", "-c", 2, 3, 4)

    def test_any_budget_tries_all_families(self):
        for problems, most in ((12, 1), (20000, 20)):
            store = self.folder / f"{problems}.store"
            done = self.succeeds("search", *self.FAMILIES, "--problems", problems, "--finishing", 0, "--store", store)
            tallies, _ = cli.total(store)
            counts = {(key[0], key[1]): tally["problems"] for key, tally in tallies.items()}
            self.assertEqual(len(counts), 12)
            self.assertLessEqual(max(counts.values()), most * min(counts.values()))
            self.assertNotIn("not reached", done.out)
            self.assertEqual(self.succeeds("status", store, "--json").json()["families"],
                             {"tried": 12, "of": 12, "not_reached": []})

    def test_families_that_were_not_reached_are_named(self):
        store = self.folder / "a.store"
        done = self.succeeds("search", *self.FAMILIES, "--problems", 2, "--store", store)
        for text in (done.out, self.succeeds("status", store).out):
            self.assertIn("2 of 12 families tried (generator, numbers of contacts): integers 2, bodies 2; not reached: "
                          "integers 3 4, bodies 3 4, scenes 2 3 4, psd 2 3 4.", cli.unwrapped(text))
        told = self.succeeds("status", store, "--json").json()["families"]
        self.assertEqual((told["tried"], told["of"], len(told["not_reached"])), (2, 12, 10))
        self.assertIn("scenes 3", told["not_reached"])

    def test_an_older_store_goes_on_with_units_that_are_all_alike(self):
        old = self.folder / "old.store"
        options = ("-g", "psd", "-c", 2, "--finishing", 0, "--store", old)
        self.succeeds("search", *options, "--problems", 1)
        definition = json.loads(dict(cli.content(old)["campaign"])["definition"])
        self.assertEqual(definition.pop("first_unit_problems"), 1)
        old.unlink()
        # As that version wrote it: the same definition without the key.
        file = self.file("all.json", {**definition, "first_unit_problems": definition["unit_problems"]})
        self.succeeds("search", file, "--finishing", 0, "--store", old, "--problems", 1)
        cli.change(old, "UPDATE campaign SET value = ? WHERE key = 'definition'", [json.dumps(definition, separators=(",", ":"))])
        for command in (("search", *options, "--problems", 10001), ("search", "--store", old, "--problems", 20001)):
            self.succeeds(*command)
        tallies, _ = cli.total(old)
        self.assertEqual(sum(tally["problems"] for tally in tallies.values()), 30000)
        self.succeeds("problem", old, 0, 9999)

    # ---- How a search ends ----

    def test_the_end_of_a_search_says_which_it_is(self):
        store = self.folder / "a.store"
        options = ("-g", "psd", "-c", 2, "--store", store, "--finishing", 0)
        first = self.succeeds("search", *options, "--problems", 100)
        self.assertIn("Finished: all problems that were asked for were tried.", first.err)
        self.assertNotIn("it holds", first.err)
        held = self.succeeds("status", store, "--json").json()["problems"]
        again = self.succeeds("search", *options, "--problems", 100)
        self.assertIn("Finished: all problems that were asked for had been tried.", again.err)
        self.assertIn(f"it holds {held:,} problems,", again.err)
        late = self.succeeds("search", *options, "--minutes", 0.01)
        self.assertIn("Out of time after ", late.err)
        self.assertIn("The same command goes on", late.err)
        for done in (first, again, late):
            self.assertNotIn("The same search again goes on", done.out)

    def test_a_search_that_goes_on_counts_what_the_store_holds(self):
        store = self.folder / "a.store"
        self.completes(store, problems=150000)
        held = self.succeeds("status", store, "--json").json()["problems"]
        done = self.completes(store, "--minutes", 10)
        lines = [line for line in done.err.splitlines() if " problems, " in line and "a second" in line]
        for line in lines:
            self.assertGreaterEqual(int(line.split()[2].replace(",", "")), held)

    def test_finishing_says_what_it_finished(self):
        store = self.folder / "a.store"
        self.succeeds("search", self.campaign, "--store", store, "--problems", PROBLEMS, "--finishing", 0)
        waiting = self.succeeds("status", store, "--json").json()["pending"]
        self.assertGreater(waiting, 0)
        done = self.succeeds("search", "--store", store, "--finish")
        self.assertIn("Finished: no finding waits.", done.err)
        self.assertNotIn("0 problems, 0 a second", done.err)
        again = self.succeeds("search", "--store", store, "--finish")
        self.assertIn("Finished: there was no finding to finish.", again.err)

    def test_a_store_alone_names_its_search(self):
        store = self.folder / "a.store"
        self.completes(store, problems=1000)
        self.succeeds("search", "--store", store, "--problems", PROBLEMS, "--finishing", 100)
        self.assertSameContent(store, self.reference)

    # ---- Another campaign ----

    def test_another_campaign_on_the_same_store_is_refused(self):
        store = self.copy("a.store")
        for arguments, says in [(("--seed", 5), "seed 4, not 5"), (("--mu", 1), "mu 1/4, 1/2, 1, 2, 5, not 1"),
                                (("--contacts", 2), "contacts 2, 3, not 2"),
                                (("--generator", "psd"), "generators small, duplicates, not psd"),
                                (("--policy", "ties=contacts"), "policies paper, not ties=contacts")]:
            with self.subTest(arguments=arguments):
                done = self.search(store, *arguments)
                self.assertEqual((done.code, done.out), (2, ""))
                for text in (str(store), f"holds another search: {says};", "--store"):
                    self.assertIn(text, done.err)
                self.assertSameContent(store, self.reference)

    # ---- Refusals ----

    def test_wrong_options_are_refused_before_a_store_is_made(self):
        store = self.folder / "a.store"
        for arguments in [
            ("--problems", 0), ("--problems", -1), ("--problems", "many"), ("--problems", 1.5),
            ("--minutes", 0), ("--minutes", -1), ("--minutes", "nan"), ("--minutes", "inf"), ("--minutes", "1e300"),
            ("--threads", 0), ("--threads", "all"), ("--audit-every", 0), ("--enumerate-every", 0), ("--contacts", 0), ("--contacts", 9), ("--generator", "nonsense"),
            ("--mu", "-1"), ("--mu", "x"), ("--mu", "2147483648"), ("--mu", "1/2147483648"), ("--policy", "nonsense"), ("--policy", "ties=none"),
            ("--policy", "paper", "scan=lowest"),
            ("--seed", -1), ("--seed", 2**64), ("--seed", "x"), ("--seed", 1.5),
            ("--shard", "2/2"), ("--shard", "-1/2"), ("--shard", "0/0"), ("--shard", "1"), ("--shard", "a/b"),
            ("--shard", "0/2x"), ("--shard", f"0/{2**32 + 1}"),
        ]:
            with self.subTest(arguments=arguments):
                for file in self.folder.iterdir():  # of a failure before
                    file.unlink()
                limit = [] if arguments[0] in ("--problems", "--minutes") else ["--problems", 1]
                done = cli.run("search", "--generator=psd", "--contacts=1", "--store", store, *limit, *arguments)
                self.assertEqual((done.code, done.out), (2, ""), done.err)
                self.assertNotIn("internal error", done.err)
                self.assertFalse(store.exists())
        store = self.folder / "b.store"
        self.refuses("search", self.file("c.json", {**CAMPAIGN, "contacts": [9]}), "--store", store,
                     says="contacts[0]: found 9")
        self.refuses("search", self.file("c.json", "{"), "--store", store, says="line 1")
        self.refuses("search", self.folder / "none.json", "--store", store, says="none.json")
        self.assertFalse(store.exists())

    def test_places_where_no_store_can_be(self):
        text = self.file("text", "no store " * 99)
        for store in [self.folder / "no/such/folder.store", self.folder, text / "a.store", text, "/proc/a.store"]:
            with self.subTest(store=store):
                self.refuses("search", "--problems", 1, "--store", store, says=store)
                self.refuses("status", store, says=store)
                self.refuses("report", store, "-o", self.folder / "report", says=store)
        self.assertEqual(text.read_text(), "no store " * 99)
        self.assertFalse((self.folder / "report").exists())
        self.refuses("status", self.folder / "none.store", says="none.store: found no such store")

    # ---- Output ----

    def test_json_is_all_there_is_on_standard_output(self):
        done = self.completes(self.copy("a.store"), "--json")
        summary = done.json()
        self.assertEqual((summary["seed"], summary["pending"]), (4, 0))
        tallies, signatures = cli.total(self.reference)
        self.assertEqual(summary["problems"], sum(tally["problems"] for tally in tallies.values()))
        verdicts = [t["verdicts"] for t in tallies.values()]
        loops = sum(row[of] for matrix in verdicts for row in matrix for of in (1, 2) if len(row) > of)
        self.assertEqual(sum(summary["failures"].get(name, 0) for name in ("cycle", "stall")), loops)
        self.assertEqual(sum(summary["groups"].values()), len(signatures))
        self.assertEqual(summary["suspicions"], sum(sum(map(sum, t["verdicts"])) for t in tallies.values()))
        self.assertEqual(self.succeeds("status", self.reference, "--json").json(), summary)
        self.assertIn("seed 4", done.err)
        self.assertPlain(done)

    def test_status_says_what_the_search_said(self):
        before = cli.content(self.reference)
        text = self.succeeds("status", self.reference).out
        self.assertEqual(text, self.done.out)
        self.assertRegex(text, r"19\d,\d\d\d problems in 1,03\d units, seed 4")
        self.assertEqual(cli.content(self.reference), before)

    def test_the_default_store_is_in_the_working_folder(self):
        self.succeeds("search", self.campaign, "--problems", 1, cwd=self.folder)
        self.succeeds("status", "stiction.store", cwd=self.folder)

    def test_the_certificates_of_a_store_are_accepted(self):
        files = []
        for i, row in enumerate(cli.content(self.reference)["findings"]):
            for certificate in (row[11], row[13], row[14], row[15]):
                if certificate:
                    files.append(self.file(f"{i}-{len(files)}.json", certificate))
            if row[12]:
                self.succeeds("replay", self.file(f"{i}.json", row[12]))
        self.assertGreater(len(files), 1)
        self.succeeds("check", *files)

    def test_every_finding_comes_with_its_solution(self):
        for row in cli.content(self.reference)["findings"]:
            for problem, certificate in ((row[9], row[14]), (row[12], row[15])):
                self.assertEqual(problem == "", certificate == "")
                if not problem:
                    continue
                problem, certificate = json.loads(problem), json.loads(certificate)
                self.assertEqual(certificate["claim"], "solution-exists")
                for key in ("contacts", "A", "b"):
                    self.assertEqual(certificate["problem"][key], problem[key])
            facts = json.loads(row[16])
            self.assertEqual(facts["found"]["existence"]["claim"], "solution-exists")
            if row[1] == "cycle":
                self.assertIs(facts["found"]["safe"], False)

    def test_methods_are_compared(self):
        summary = self.succeeds("status", self.reference, "--json").json()
        self.assertEqual(summary["existence_solved"], summary["existence_checked"])
        self.assertGreaterEqual(summary["compared"], summary["audited"])
        self.assertEqual((summary["disagreements_of_methods"], summary["grave"]), (0, []))
        self.assertGreater(summary["enumerated"], 0)
        self.assertEqual(summary["safety_decided"], summary["audited"])

    def test_a_grave_finding_is_named_first(self):
        store = self.copy("a.store")
        with sqlite3.connect(store) as db:
            signature, = db.execute("SELECT signature FROM findings WHERE kind = 'cycle' LIMIT 1").fetchone()
        db.close()
        cli.change(store, "UPDATE findings SET kind = 'safe-cycle' WHERE signature = ?", [signature])
        lines = self.succeeds("status", store).out.splitlines()
        self.assertEqual(lines[1], f"  GRAVE: safe-cycle: {signature}")
        simplest = next(i for i, line in enumerate(lines) if line.startswith("Simplest"))
        self.assertIn(signature, lines[simplest + 1])
        self.assertEqual(self.succeeds("status", store, "--json").json()["grave"],
                         [{"signature": signature, "kind": "safe-cycle"}])

    def test_any_problem_of_a_search_can_be_looked_at(self):
        row = next(row for row in cli.content(self.reference)["findings"] if row[1] == "cycle")
        out = self.folder / "problem.json"
        self.succeeds("problem", self.reference, row[2], row[3], "-o", out)
        self.assertEqual(json.loads(out.read_text()), json.loads(row[9]))
        self.assertEqual(cli.run("replay", out).code, 1)
        self.assertEqual(self.succeeds("problem", self.reference, row[2], row[3]).out, out.read_text())
        self.refuses("problem", self.reference, 10**6, 0, says="unit 1000000")
        self.refuses("problem", self.reference, 0, 220, says=["index 220", "0 to 219"])
        self.refuses("problem", self.reference, -1, 0)
        self.refuses("problem", self.reference, 0, "x")
        self.refuses("problem", self.folder / "none.store", 0, 0, says="no such store")

    def test_a_store_of_another_version_is_refused(self):
        store = self.copy("old.store")
        for version, says in ((2, "older stiction, commit abc: that one goes on"), (9, "newer stiction: take that one")):
            cli.change(store, "INSERT OR REPLACE INTO campaign VALUES ('build', 'commit abc')")
            cli.change(store, "UPDATE campaign SET value = ? WHERE key = 'version'", [version])
            before = cli.content(store)
            for arguments in (("status", store), ("report", store, "-o", self.folder / "report"),
                              ("merge", self.folder / "out.store", store), ("problem", store, 0, 0),
                              ("merge", "--salvage", self.folder / "out.store", store),
                              ("search", self.campaign, "--store", store, "--problems", 1)):
                self.refuses(*arguments, says=["old.store", f"version {version}", "version 4", "--store NEW_FILE", says])
            self.assertEqual(cli.content(store), before)
            self.assertFalse((self.folder / "out.store").exists())

    def test_status_of_a_running_search(self):
        store = self.folder / "a.store"
        search = subprocess.Popen([cli.program, "search", self.campaign, "--store", store, "--minutes", "1", "--threads", "1"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            units = [0]
            end = time.monotonic() + 30
            while len(set(units)) < 5 and time.monotonic() < end:
                done = cli.run("status", store, "--json")
                if done.code == 0:
                    units.append(done.json()["units"])
                    per_unit = done.json()["problems"] / max(1, units[-1])
                    self.assertTrue(units[-1] == 0 or 110 <= per_unit <= 220)
                else:
                    self.assertEqual((done.code, units), (2, [0]))  # there is no store yet
            self.assertEqual(units, sorted(units))
            self.assertGreaterEqual(len(set(units)), 5)
            self.assertIsNone(search.poll())
        finally:
            search.kill()
            search.wait()

    def test_a_report_is_the_same_each_time(self):
        def files(folder):
            return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

        one, two = self.folder / "one", self.folder / "two"
        done = self.succeeds("report", self.reference, "-o", one)
        self.assertEqual(done.out, f"{one}/index.html\n")
        for _ in range(2):
            self.succeeds("report", self.reference, "-o", two)
            self.assertEqual(files(two), files(one))
        self.assertTrue(files(one)[Path("index.html")].lower().startswith(b"<!doctype html>"))
        problems = [path for path in (one / "findings").glob("*.json") if path.name.count(".") == 1]
        self.assertGreater(len(problems), 2)
        for problem in problems:
            self.assertIn(cli.run("replay", problem).code, (0, 1))
        self.succeeds("check", *(one / "findings").glob("*.certificate.json"))
        self.refuses("report", self.reference, "-o", "/proc/report", says="/proc/report")
        self.refuses("report", self.reference, "-o", self.file("file", ""), says="file")


if __name__ == "__main__":
    cli.main()
