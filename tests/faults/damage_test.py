# SPDX-License-Identifier: Apache-2.0
"""Stores that a disk or a hand has changed: named and refused, or no different in what they say.

damage_test.py PATH_TO_STICTION [SOURCES]
"""

import json
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

FLIPS = 60 if cli.ALL else 10
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 5, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "first_unit_problems": 220, "unit_problems": 220}
PROBLEMS = 190000  # one block and some units


class Damage(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.common = Path(tempfile.mkdtemp(prefix="stiction-damage-"))
        cls.addClassCleanup(shutil.rmtree, cls.common)
        campaign = cls.common / "campaign.json"
        campaign.write_text(json.dumps(CAMPAIGN))
        cls.whole = cls.common / "whole.store"
        done = cli.run("search", campaign, "--store", cls.whole, "--problems", PROBLEMS)
        assert done.code == 0, done.err
        db = sqlite3.connect(cls.whole)
        db.execute("PRAGMA journal_mode = DELETE")  # one file
        db.execute("VACUUM")  # without pages that nothing stands on
        db.close()

    def copy(self, name="a.store"):
        return Path(shutil.copy(self.whole, self.folder / name))

    def files(self, store):
        """What a report of a store says, or why there is none."""
        out = self.folder / "report"
        shutil.rmtree(out, ignore_errors=True)
        done = cli.run("report", store, "-o", out)
        if done.code != 0:
            self.assertEqual(done.code, 2, done.err)
            self.assertIn(str(store), done.err)
            self.assertFalse(out.exists())
            return None
        return {str(path.relative_to(out)): path.read_bytes() for path in out.rglob("*") if path.is_file()}

    def test_a_flipped_byte_is_never_published(self):
        expected = self.files(self.whole)
        content = self.whole.read_bytes()
        places, refused = random.Random(1994), 0
        for _ in range(FLIPS):
            place, bit = places.randrange(100, len(content)), 1 << places.randrange(8)
            damaged = bytearray(content)
            damaged[place] ^= bit
            store = self.folder / "a.store"
            store.write_bytes(damaged)
            files = self.files(store)
            refused += files is None
            if files is not None:
                self.assertEqual(files, expected, f"byte {place}, bit {bit}")
        self.assertGreater(refused, FLIPS / 2)

    def test_every_reader_refuses_a_damaged_row_by_name(self):
        store = self.copy()
        signature = cli.content(store)["findings"][0][0]
        cli.change(store, "UPDATE findings SET contacts = contacts + 1 WHERE signature = ?", [signature], reseal=False)
        for arguments in (("status", store), ("report", store, "-o", self.folder / "report"),
                          ("merge", self.folder / "out.store", store), ("problem", store, 0, 0),
                          ("search", self.common / "campaign.json", "--store", store, "--problems", PROBLEMS)):
            self.refuses(*arguments, says=[store, f"finding {signature}: found content of SHA-256", "merge --salvage"])
        self.assertFalse((self.folder / "out.store").exists())
        self.assertFalse((self.folder / "report").exists())

    def test_what_no_search_writes_is_refused_though_it_is_sealed(self):
        cycle = "signature = (SELECT MIN(signature) FROM findings WHERE kind = 'cycle' AND done = 1)"
        for column, value, says in [
                ("kind", "'nonsense'", ["kind: found 'nonsense'"]),
                ("contacts", "-5", ["contacts: found -5"]),
                ("contacts", "contacts + 1", ["contacts: found", "as its unit has"]),
                ("unit", "-1", ["unit: found -1"]),
                ("generator", "'psd'", ["generator: found 'psd'"]),
                ("policy", "'ties=contacts'", ["policy: found 'ties=contacts'"]),
                ("exact_outcome", "'won'", ["exact_outcome: found 'won'"]),
                ("problem", "'{}'", ["problem: contacts"]),
                ("problem", "minimized", ["found"]),
                ("certificate", "'[1'", ["certificate: line 1"]),
                ("certificate", "minimized_certificate", ["certificate: found the certificate of sha256"]),
                ("certificate", "replace(certificate, 'stiction-certificate', 'x')", ["format"]),
                ("facts", "'{}'", ["facts: found"]),
                ("facts", "replace(facts, '\"start\"', '\"begin\"')", ["begin"]),
                ("minimized", "''", ["minimized"])]:
            with self.subTest(column=column, value=value):
                store = self.copy()
                self.assertEqual(cli.change(store, f"UPDATE findings SET {column} = {value} WHERE {cycle}"), 1)
                self.refuses("status", store, says=[store, *says])
                self.refuses("report", store, "-o", self.folder / "report", says=says)
        for change, says in [("replace(record, '\"audited\"', '\"audit\"')", "audit"),
                             ("replace(record, '\"small\"', '\"psd\"')", "generator"),
                             ("replace(record, '\"wrong\":0', '\"wrong\":1000000000')", "wrong"),
                             ("replace(record, '\"problems\"', '\"problem\"')", "problem")]:
            with self.subTest(change=change):
                store = self.copy()
                self.assertEqual(cli.change(store, f"UPDATE blocks SET record = {change}"), 1)
                self.refuses("status", store, says=[store, says])
                self.refuses("merge", self.folder / "out.store", store, says=says)

    def test_salvage_saves_what_is_sound_and_says_what_is_left_out(self):
        store, out = self.copy(), self.folder / "out.store"
        signature = cli.content(store)["findings"][0][0]
        cli.change(store, "UPDATE findings SET policy = 'x' WHERE signature = ?", [signature], reseal=False)
        cli.change(store, "UPDATE units SET record = '{}' WHERE unit = (SELECT MIN(unit) FROM units)", reseal=False)
        self.refuses("merge", out, store, says="damaged")
        done = self.succeeds("merge", "--salvage", out, store)
        for text in (f"finding {signature}", "unit 1024", "left out in all: 2 rows, 0 whole stores"):
            self.assertIn(text, done.err)
        whole, saved = cli.content(self.whole), cli.content(out)
        self.assertEqual(saved["blocks"], whole["blocks"])
        self.assertEqual(saved["units"], whole["units"][1:])
        self.assertEqual(saved["findings"], whole["findings"][1:])
        # With a sound copy beside it nothing is lost, in any order.
        for name, stores in (("1", (store, self.whole)), ("2", (self.whole, store))):
            self.succeeds("merge", "--salvage", self.folder / name, *stores)
            self.assertSameContent(self.folder / name, self.whole)
        # What was left out is run again.
        self.succeeds("search", self.common / "campaign.json", "--store", out, "--problems", PROBLEMS)
        self.assertSameContent(out, self.whole, ["blocks", "units"])

    def test_salvage_of_pages_that_cannot_be_read(self):
        content = bytearray(self.whole.read_bytes())
        for page in range(4096 * 8, len(content), 4096 * 16):
            content[page:page + 64] = bytes(64)
        store, out = self.folder / "a.store", self.folder / "out.store"
        store.write_bytes(content)
        self.refuses("status", store, says="damaged")
        done = cli.run("merge", "--salvage", out, store)
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("left out", done.err)
        saved, whole = cli.content(out), cli.content(self.whole)
        for table in ("blocks", "units", "findings"):
            self.assertLessEqual(set(saved[table]), set(whole[table]))
        self.assertGreater(len(saved["findings"]) + len(saved["units"]), 0)

    def test_salvage_of_nothing_is_refused(self):
        text, out = self.file("text", "no store " * 99), self.folder / "out.store"
        self.refuses("merge", "--salvage", out, text, says=text)
        self.assertFalse(out.exists())
        done = self.succeeds("merge", "--salvage", out, text, self.whole)
        self.assertIn("1 whole store\n", done.err)
        self.assertSameContent(out, self.whole)

    def test_the_manifest_of_a_report_is_of_every_file(self):
        out = self.folder / "report"
        self.succeeds("report", self.whole, "-o", out)
        done = subprocess.run(["sha256sum", "--check", "--strict", "SHA256SUMS"], cwd=out, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        listed = {line.split("  ", 1)[1] for line in (out / "SHA256SUMS").read_text().splitlines()}
        present = {str(path.relative_to(out)) for path in out.rglob("*") if path.is_file()}
        self.assertEqual(present - listed, {"SHA256SUMS", ".stiction-files", "work.csv"})
        self.assertLessEqual(listed, present)


if __name__ == "__main__":
    cli.main()
