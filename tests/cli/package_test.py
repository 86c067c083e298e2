# SPDX-License-Identifier: Apache-2.0
"""stiction report --package: a folder that Python alone verifies, and in which nothing can be altered unseen."""

import hashlib
import json
import os
import shutil
import subprocess
import sys

import cli


class Package(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = cli.Path(cli.tempfile.mkdtemp(prefix="stiction-package-"))
        cls.addClassCleanup(shutil.rmtree, cls.made, ignore_errors=True)
        cls.store = cls.made / "small.store"
        done = cli.run("search", "--generator", "integers", "--contacts", 2, "--problems", 100000, "--seed", 1,
                       "--finishing", 100, "--store", cls.store)
        assert done.code == 0, done.err
        cls.package = cls.made / "package"
        done = cli.run("report", cls.store, "--package", cls.package)
        assert done.code == 0, done.err

    def verify(self, package, *flags):
        """Only Python, nothing of this process: neither its environment nor its folder."""
        done = subprocess.run([sys.executable, "-I", "-S", *flags, package / "verify.py"], env={}, cwd="/",
                              capture_output=True, text=True, timeout=300)
        return done.returncode, done.stdout, done.stderr

    def accepted(self, package):
        code, out, err = self.verify(package)
        self.assertEqual((code, err), (0, ""), out)
        return out

    def wrong(self, package, *says):
        code, out, err = self.verify(package)
        self.assertEqual((code, err), (1, ""), out)
        self.assertTrue(out and all(line.startswith("WRONG: ") for line in out.splitlines()), out)
        for text in says:
            self.assertIn(text, out)
        self.assertNotIn("Traceback", out)
        return out

    def copy(self):
        package = self.folder / "package"
        shutil.copytree(self.package, package)
        return package

    def alter(self, package, name, text):
        """Writes a file and mends its checksum."""
        sums = package / "SHA256SUMS"
        lines = [line for line in sums.read_text().splitlines() if line[66:] != name]
        if text is None:
            (package / name).unlink()
        else:
            (package / name).write_text(text)
            lines.append(f"{hashlib.sha256(text.encode()).hexdigest()}  {name}")
        sums.write_text("".join(line + "\n" for line in sorted(lines, key=lambda line: line[66:])))

    def a_certificate(self, package, claim):
        for finding in json.loads((package / "manifest.json").read_text())["findings"]:
            for certificate in finding["certificates"]:
                if certificate["claim"] == claim:
                    return certificate["file"]
        self.fail(f"no certificate of {claim}")

    def test_python_alone_verifies_it_and_leaves_nothing_behind(self):
        package = self.copy()
        before = sorted(str(path) for path in package.rglob("*"))
        out = self.accepted(package)
        manifest = json.loads((package / "manifest.json").read_text())
        findings, certificates = manifest["findings"], sum(len(f["certificates"]) for f in manifest["findings"])
        loops = [f for f in findings if f["kind"] == "cycle"]
        self.assertGreater(len(loops), 0)
        self.assertRegex(out, rf"^verified: \d+ files, {len(findings)} findings, {certificates} certificates; "
                              rf"{len(loops)} of {len(loops)} kinds of loops are proved here\n$")
        self.assertEqual(sorted(str(path) for path in package.rglob("*")), before)
        # In a folder that cannot be written, too.
        for path in [package, *package.rglob("*")]:
            path.chmod(0o555 if path.is_dir() else 0o444)
        self.assertEqual(self.accepted(package), out)
        for path in [package, *package.rglob("*")]:
            path.chmod(0o755 if path.is_dir() else 0o644)

    def test_it_holds_what_the_store_holds(self):
        manifest = json.loads((self.package / "manifest.json").read_text())
        rows = cli.content(self.store)["findings"]
        self.assertEqual([f["signature"] for f in manifest["findings"]], sorted(row[0] for row in rows))
        met = cli.total(self.store)[1]
        for finding in manifest["findings"]:
            self.assertEqual(finding["met"], met[finding["signature"]])
        self.assertEqual(manifest["campaign"]["seed"], 1)
        for name in ("certificate_reader.py", "check_certificate.py", "check_runs.py", "check_runs_in_space.py"):
            self.assertEqual((self.package / "checkers" / name).read_bytes(), (cli.ROOT / "certify" / name).read_bytes())
        report = self.folder / "report"
        self.succeeds("report", self.store, "-o", report)
        for path in report.rglob("*"):
            name = path.relative_to(report)
            if name.parts[0] == "findings" and path.is_file():
                self.assertEqual((self.package / name).read_bytes(), path.read_bytes())
            if path.suffix == ".csv" and (self.package / "tables" / name).exists():
                self.assertEqual((self.package / "tables" / name).read_bytes(), path.read_bytes())

    def test_the_same_store_gives_the_same_bytes(self):
        again = self.folder / "again"
        self.succeeds("report", self.store, "--package", again)
        self.assertEqual((again / "SHA256SUMS").read_bytes(), (self.package / "SHA256SUMS").read_bytes())
        sums = {line[66:]: line[:64] for line in (again / "SHA256SUMS").read_text().splitlines()}
        for path in again.rglob("*"):
            name = path.relative_to(again).as_posix()
            if path.is_file() and name not in ("SHA256SUMS", ".stiction-files"):
                self.assertEqual(hashlib.sha256(path.read_bytes()).hexdigest(), sums[name])

    def test_a_byte_that_changed_is_noticed_in_every_file(self):
        package = self.copy()
        for path in sorted(path for path in package.rglob("*") if path.is_file()):
            name = path.relative_to(package).as_posix()
            if name in ("SHA256SUMS", ".stiction-files", "verify.py"):
                continue
            with self.subTest(file=name):
                text = path.read_bytes()
                path.write_bytes(text[:-1] + bytes([text[-1] ^ 1]))
                self.wrong(package, f"{name}: checksum is")
                path.write_bytes(text)
        with open(package / "verify.py", "a") as file:
            file.write("# more\n")
        self.wrong(package, "verify.py: checksum is")

    def test_a_missing_and_a_foreign_file_are_noticed(self):
        package = self.copy()
        name = self.a_certificate(package, "cycle")
        (package / name).rename(package / "findings" / "other.json")
        self.wrong(package, f"{name}: missing", "findings/other.json: found a file that SHA256SUMS does not name")
        package = shutil.copytree(self.package, self.folder / "linked")
        (package / name).unlink()
        os.symlink(self.package / name, package / name)
        self.wrong(package, f"{name}: found no plain file")
        (package / "SHA256SUMS").unlink()
        self.wrong(package, "SHA256SUMS: unreadable")

    def test_a_certificate_that_was_altered_with_its_checksum_is_noticed(self):
        for claim, change in [("cycle", lambda w: w["runs"][0].update(period=w["runs"][0]["period"] + 1)),
                              ("solution-exists", lambda w: w["f"].__setitem__(0, "12345/7"))]:
            with self.subTest(claim=claim):
                package = shutil.copytree(self.package, self.folder / claim)
                name = self.a_certificate(package, claim)
                certificate = json.loads((package / name).read_text())
                change(certificate["witness"])
                self.alter(package, name, json.dumps(certificate))
                self.wrong(package, f"{name}: REJECTED: ")

    def test_a_true_certificate_of_another_problem_or_claim_is_noticed(self):
        findings = [f for f in json.loads((self.package / "manifest.json").read_text())["findings"] if f["kind"] == "cycle"]
        first, second = (next(c["file"] for c in f["certificates"] if c["claim"] == "cycle") for f in findings[:2])
        package = self.copy()
        self.alter(package, first, (package / second).read_text())
        self.wrong(package, f"{first}: REJECTED: $.problem", "the problem that was asked for")
        package = shutil.copytree(self.package, self.folder / "claim")
        self.alter(package, first, (package / self.a_certificate(package, "solution-exists")).read_text())
        self.wrong(package, f"{first}: claim is 'solution-exists', expected 'cycle'")

    def test_a_problem_that_was_altered_with_its_checksum_is_noticed(self):
        package = self.copy()
        name = json.loads((package / "manifest.json").read_text())["findings"][0]["problems"][0]["file"]
        problem = json.loads((package / name).read_text())
        problem["b"][0] = "1001/7"
        self.alter(package, name, json.dumps(problem))
        self.wrong(package, f"{name}: digest is sha256:")

    def test_a_manifest_that_is_none_or_leaves_something_out_is_noticed(self):
        manifest = json.loads((self.package / "manifest.json").read_text())
        less = {**manifest, "findings": manifest["findings"][1:]}
        away = json.loads(json.dumps(manifest))
        away["findings"][0]["certificates"][0]["file"] = "../../etc/passwd"
        for text, says in [("[", "manifest.json: unreadable"), ("[]", "manifest.json: $: expected an object"),
                           (json.dumps({**manifest, "version": 2}), "version 2"),
                           (json.dumps({**manifest, "findings": [7]}), "$.findings[0]: expected an object"),
                           (json.dumps(less), "no finding of manifest.json names it"),
                           (json.dumps(away), "names '../../etc/passwd', which SHA256SUMS does not"),
                           ("[" * 100000, "manifest.json: unreadable")]:
            with self.subTest(says=says):
                package = shutil.copytree(self.package, self.folder / str(len(list(self.folder.iterdir()))))
                self.alter(package, "manifest.json", text)
                self.wrong(package, says)
        package = self.copy()
        self.alter(package, "manifest.json", None)
        self.wrong(package, "manifest.json: unreadable")

    def test_bad_usage(self):
        self.refuses("report", self.store, says="-o, --package and --text")
        folder = self.folder / "occupied"
        folder.mkdir()
        (folder / "mine.txt").write_text("mine")
        self.refuses("report", self.store, "--package", folder, says="mine.txt")


if __name__ == "__main__":
    cli.main()
