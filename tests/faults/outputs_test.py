# SPDX-License-Identifier: Apache-2.0
"""Outputs when something goes wrong: kills, full disks, folders that cannot be written.

outputs_test.py PATH_TO_STICTION [SOURCES]
"""

import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import cli  # noqa: E402

KILLS = 12
SCENE = "corpus/scenes/stack.json"


def few_bytes():
    """No file may grow beyond a few bytes, as on a full disk. A signal would end who does not ignore it."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))


def no_core():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def tree(folder):
    """Every file below a folder, by its name in it."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


class Outputs(cli.TestCase):
    def store(self, name="s.store", problems=2000, seed=1):
        store = self.folder / name
        self.succeeds("search", "--problems", problems, "--seed", seed, "--generator", "small", "--contacts", 2,
                      "--store", store, "--threads", 1)
        return store

    def seconds(self, *arguments):
        start = time.monotonic()
        self.succeeds(*arguments)
        return time.monotonic() - start

    def kill(self, arguments, seconds):
        """Whether the program was still running."""
        process = subprocess.Popen([cli.program, *map(str, arguments)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, preexec_fn=no_core)
        try:
            process.communicate(timeout=seconds)
            return False
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return True

    def kill_often(self, arguments, seconds, look, allowed):
        """A machine may have become quicker since `seconds` was measured: where it was too late, the next comes earlier."""
        moments = random.Random(1994)
        kills = 0
        for _ in range(KILLS):
            killed = self.kill(arguments, seconds * moments.uniform(0.3, 1.1))
            kills += killed
            seconds *= 1 if killed else 0.7
            self.assertIn(look(), allowed)
        self.assertGreater(kills, 0)

    # ---- Kills ----

    def test_a_killed_certify_leaves_the_old_certificate_or_the_new_one(self):
        file, out = cli.ROOT / "corpus/no-solution-scripted-wedge.json", self.folder / "c.json"
        arguments = ("certify", file, "-o", out)
        seconds = self.seconds(*arguments)
        new = out.read_bytes()
        out.write_text("old")
        self.kill_often(arguments, seconds, out.read_bytes, [b"old", new])

    def test_a_killed_report_leaves_the_old_folder_or_the_new_one(self):
        first, second, out = self.store("a.store", seed=1), self.store("b.store", seed=2), self.folder / "out"
        self.seconds("report", second, "-o", out)
        new = tree(out)
        seconds = self.seconds("report", first, "-o", out)
        old = tree(out)
        self.assertNotEqual(old, new)
        self.kill_often(("report", second, "-o", out), seconds, lambda: tree(out), [old, new])
        self.succeeds("report", second, "-o", out)
        self.assertEqual(tree(out), new)
        self.assertEqual([path for path in self.folder.iterdir() if path.name.startswith(".")], [])

    def test_a_killed_simulation_leaves_the_old_folder_or_the_new_one(self):
        out = self.folder / "out"
        arguments = ("simulate", cli.ROOT / SCENE, "-o", out, "--threads", 1, "--seconds")
        seconds = self.seconds(*arguments, 1)
        new = tree(out)
        self.succeeds(*arguments, 0.1)
        old = tree(out)
        self.kill_often((*arguments, 1), seconds, lambda: tree(out), [old, new])

    # ---- Disks ----

    def fails_to_write(self, *arguments, says, **options):
        done = subprocess.run([cli.program, *map(str, arguments)], capture_output=True, text=True, timeout=120, **options)
        self.assertEqual(done.returncode, 74, done.stderr)
        said = [line for line in done.stderr.splitlines() if line.startswith("stiction: ")]
        self.assertEqual(len(said), 1, done.stderr)
        self.assertIn(str(says), said[0])

    def outputs(self, folder):
        """A call of every verb that writes, into the folder, and what it is to name."""
        problem = self.file("problem.json", cli.REFERENCE)
        frictionless, lcp = cli.ROOT / "corpus/exponential-pivots-5-frictionless.json", self.folder / "lcp.dat"
        self.succeeds("export", frictionless, "-o", lcp, "--format", "siconos-lcp")
        scene = cli.ROOT / SCENE
        calls = [("certify", problem), ("certify", problem, "--safe"), ("minimize", problem), ("import", lcp),
                 ("problem", "--exponential", 5), ("draw", scene),
                 ("replay", problem, "--all-policies", "--record"),
                 ("export", frictionless, "--format", "siconos-lcp")]
        for number, call in enumerate(calls):
            out = folder / f"{number}"
            yield (*call, *(() if "--record" in call else ("-o",)), out), out

    def test_every_output_on_a_full_disk_leaves_the_old_file_and_exits_with_74(self):
        folder = self.folder / "out"
        folder.mkdir()
        for arguments, out in self.outputs(folder):
            with self.subTest(arguments=arguments):
                out.write_text("old")
                self.fails_to_write(*arguments, says=out, preexec_fn=few_bytes)
                self.assertEqual(out.read_text(), "old")
                self.assertIn(cli.run(*arguments).code, (0, 1))
                self.assertGreater(len(out.read_text()), 100)
        self.assertEqual(len(list(folder.iterdir())), 8, "nothing is left beside them")

    def test_folders_on_a_full_disk_leave_the_old_folder(self):
        for arguments in (("report", self.store()), ("simulate", cli.ROOT / SCENE, "--seconds", 0.1)):
            out = self.folder / arguments[0]
            self.succeeds(*arguments, "-o", out)
            old = tree(out)
            self.fails_to_write(*arguments, "-o", out, says=out.name, preexec_fn=few_bytes)
            self.assertEqual(tree(out), old)
            self.assertFalse((self.folder / f".{out.name}.stiction").exists())

    def test_a_search_on_a_full_disk_keeps_what_it_has(self):
        store = self.store()
        before = cli.content(store)
        bound = store.stat().st_size + 4096

        def full():
            resource.setrlimit(resource.RLIMIT_FSIZE, (bound, bound))

        arguments = ("search", "--problems", 10**8, "--seed", 1, "--generator", "small", "--contacts", 2, "--store", store,
                     "--threads", 1)
        self.fails_to_write(*arguments, says=store, preexec_fn=full)
        after = cli.content(store)
        self.assertGreaterEqual(len(after["units"]) + 1024 * len(after["blocks"]),
                                len(before["units"]) + 1024 * len(before["blocks"]))
        self.succeeds("status", store)

    def test_a_new_store_on_a_full_disk_is_none(self):
        store = self.folder / "new.store"
        self.fails_to_write("search", "--problems", 1000, "--store", store, says=store, preexec_fn=few_bytes)
        self.assertFalse(store.exists())

    def test_a_small_disk(self):
        """The same on a file system that is really full."""
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "none", disk],
                                                       capture_output=True).returncode == 0
        if not mounted:
            self.skipTest("no file system can be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        out = disk / "c.json"
        out.write_text("old")
        filler = os.open(disk / "filler", os.O_WRONLY | os.O_CREAT)
        try:
            while os.write(filler, bytes(4096)):
                pass
        except OSError:
            os.close(filler)
        self.fails_to_write("certify", self.file("p.json", cli.REFERENCE), "-o", out, says=out)
        self.assertEqual(out.read_text(), "old")
        self.fails_to_write("search", "--problems", 1000, "--store", disk / "s", says=disk / "s")
        self.fails_to_write("simulate", cli.ROOT / SCENE, "-o", disk / "run", "--seconds", 0.1, says=disk / "run")
        self.assertEqual(sorted(path.name for path in disk.iterdir()), ["c.json", "filler"])

    # ---- Folders of others ----

    def test_findings_of_another_campaign_never_stay_in_a_report(self):
        first, second = self.store("a.store", seed=1), self.store("b.store", seed=2)
        self.succeeds("report", second, "-o", self.folder / "alone")
        self.succeeds("report", first, "-o", self.folder / "out")
        self.succeeds("report", second, "-o", self.folder / "out")
        self.assertEqual(tree(self.folder / "out"), tree(self.folder / "alone"))

    def test_a_folder_of_somebody_else_is_refused_or_kept(self):
        out = self.folder / "out"
        (out / "thesis").mkdir(parents=True)
        (out / "thesis/chapter.txt").write_text("mine")
        for arguments in (("report", self.store()), ("simulate", cli.ROOT / SCENE, "--seconds", 0.1)):
            self.refuses(*arguments, "-o", out, says=[out, "'thesis'", "--replace"])
        self.assertEqual(tree(out), {"thesis/chapter.txt": b"mine"})
        done = self.succeeds(*arguments, "-o", out, "--replace")
        self.assertIn(str(out) + ".old", done.err)
        self.assertEqual(tree(self.folder / "out.old"), {"thesis/chapter.txt": b"mine"})
        self.assertIn("animation.html", tree(out))


if __name__ == "__main__":
    cli.main()
