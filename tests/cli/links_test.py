# SPDX-License-Identifier: Apache-2.0
"""Links that somebody planted where a verb makes a file or a folder of its own: what they lead to is left alone, and the
verb either works or refuses in one line.

links_test.py PATH_TO_STICTION [SOURCES]
"""

import os
import subprocess

import cli

SCENE = "corpus/scenes/stack.json"
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 4, "generators": ["small"], "contacts": [2],
            "unit_problems": 2000}
SMALL = ("--generator", "small", "--contacts", 2, "--threads", 1, "--problems", 2000)


def tree(folder):
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


class Links(cli.TestCase):
    def setUp(self):
        super().setUp()
        self.theirs, self.here = self.folder / "theirs", self.folder / "here"
        self.afresh()
        self.source = self.folder / "source.store"
        self.succeeds("search", *SMALL, "--store", self.source)

    def afresh(self):
        subprocess.run(["rm", "-rf", self.here, self.theirs], check=True)
        self.here.mkdir()
        (self.theirs / "folder").mkdir(parents=True)
        for name in ("thesis", "folder/chapter"):
            (self.theirs / name).write_text("mine, and longer than the head of any file that is looked at\n" * 20)
        self.before = tree(self.theirs)

    def plant(self, path):
        """What can stand at a name: links to a file, to a folder and to nothing; another name of a file; a folder."""
        yield "a link to a file", lambda: path.symlink_to(self.theirs / "thesis")
        yield "a link to a folder", lambda: path.symlink_to(self.theirs / "folder")
        yield "a link to nothing", lambda: path.symlink_to(self.theirs / "new")
        yield "another name of a file", lambda: path.hardlink_to(self.theirs / "thesis")

        def folder():
            path.mkdir()
            (path / "mine").write_text("mine")
        yield "a folder", folder

    def holds(self, name, *arguments, works=None):
        """With whatever has the name: nothing of others changes, what was planted stays, and one line at most is said."""
        path = self.here / name
        for what, plant in self.plant(path):
            with self.subTest(verb=arguments[0], name=name, what=what):
                self.afresh()
                plant()
                done = cli.run(*arguments)
                self.assertEqual(tree(self.theirs), self.before)
                self.assertTrue(os.path.lexists(path), "it has been removed")
                if path.is_dir() and not path.is_symlink():
                    self.assertEqual(tree(path), {"mine": b"mine"})
                self.assertIn(done.code, (0, 2, 74) if works is None else (0,), done.err)
                if done.code:
                    self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                    self.assertIn(str(self.here), done.err)

    def folders(self):
        """The verbs that write a folder."""
        other = self.folder / "other.store"
        self.succeeds("search", *SMALL, "--seed", 2, "--store", other)
        return (("report", self.source), ("report", self.source, other), ("report", self.source, "--package"),
                ("simulate", cli.ROOT / SCENE, "--seconds", 0.05),
                ("slurm", self.file("c.json", CAMPAIGN), "--shards", 1, "--problems", 2000))

    def test_a_folder_that_is_written(self):
        for verb in self.folders():
            out = ("-o", self.here / "rep") if verb[-1] != "--package" else (self.here / "rep",)
            self.holds(".rep.stiction", *verb, *out)
            self.holds(".rep.stiction-old", *verb, *out, works=True)

    def test_the_name_under_which_a_folder_is_kept(self):
        for verb in self.folders()[3:]:
            for _, plant in self.plant(self.here / "rep.old"):
                self.afresh()
                (self.here / "rep").mkdir()
                (self.here / "rep/notes").write_text("notes")
                plant()
                self.succeeds(*verb, "-o", self.here / "rep", "--replace")
                self.assertEqual(tree(self.here / "rep.old2"), {"notes": b"notes"})
                self.assertEqual(tree(self.theirs), self.before)

    def test_a_file_that_is_written(self):
        """The temporary name has the number of the process: links are planted by the process itself."""
        problem = self.file("p.json", cli.REFERENCE)
        for verb in (("certify", problem), ("replay", problem, "--html"), ("problem", "--exponential", 2),
                     ("minimize", problem), ("draw", cli.ROOT / SCENE)):
            out = self.here / "out"
            self.afresh()

            def plant():
                for k in range(1, 5):
                    os.symlink(self.theirs / "thesis", self.here / f".stiction-{os.getpid()}-{k}")

            words = [*verb, out] if verb[-1] == "--html" else [*verb, "-o", out]
            done = subprocess.run([cli.program, *map(str, words)], preexec_fn=plant, capture_output=True, text=True,
                                  timeout=120)
            self.assertIn(done.returncode, (0, 1), done.stderr)
            self.assertEqual(tree(self.theirs), self.before)
            self.assertTrue(out.is_file() and not out.is_symlink(), verb)
            self.assertEqual(len(list(self.here.iterdir())), 5, "the links, and what was written")

    def test_what_stands_beside_a_store(self):
        store = self.here / "s.store"
        for end in ("", ".lock", "-wal", "-shm", "-journal"):
            self.holds(f"s.store{end}", "search", *SMALL, "--store", store)
            self.holds(f"s.store{end}", "merge", store, self.source)

    def test_a_new_store(self):
        for verb in (("search", *SMALL, "--store", self.here / "s.store"), ("merge", self.here / "s.store", self.source)):
            self.afresh()

            def plant():
                for end in ("", "-journal", "-wal"):
                    os.symlink(self.theirs / "thesis", self.here / f"s.store.new-{os.getpid()}{end}")

            done = subprocess.run([cli.program, *map(str, verb)], preexec_fn=plant, capture_output=True, text=True,
                                  timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(tree(self.theirs), self.before)
            self.assertEqual(len(list(self.here.iterdir())), 4, "three links and the store")

    def test_readers(self):
        """`status` and `report` look at the lock of a store, and wait for no pipe in its place."""
        for plant in (lambda path: path.symlink_to(self.theirs / "thesis"), os.mkfifo):
            lock = self.folder / "source.store.lock"
            plant(lock)
            for verb in (("status", self.source), ("report", self.source, "-o", self.here / "rep")):
                self.succeeds(*verb, timeout=60)
            lock.unlink()
        self.assertEqual(tree(self.theirs), self.before)

    def test_the_scripts_of_a_job_array(self):
        array = self.here / "array"
        self.succeeds("slurm", self.file("c.json", CAMPAIGN), "--shards", 1, "--problems", 2000, "-o", array)
        names = ["shards/.0.7.0", "shards/.0.7.0.lock", "shards/.0.7.0-wal", ".merged.7.store", ".merged.7.store.lock",
                 "options", "shards/0.store.damaged", "merged.store"]
        for name in names:
            (array / name).symlink_to(self.theirs / "thesis")
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "sbatch").write_text("#!/bin/bash\necho 7\n")
        (tools / "sbatch").chmod(0o755)
        environment = {**os.environ, "SLURM_JOB_ID": "7", "SLURM_RESTART_COUNT": "0",
                       "PATH": f"{tools}:{os.environ['PATH']}"}

        def script(*words):
            done = subprocess.run(["bash", array / words[0], *words[1:]], env=environment, capture_output=True, text=True,
                                  timeout=300)
            self.assertEqual(tree(self.theirs), self.before, words)
            return done

        self.assertEqual(script("submit.sh", "--account=a").returncode, 0)
        (array / "shards/0.store").write_text("torn")
        self.assertEqual(script("merge.sh").returncode, 0)  # sets it aside, and submits the shard again
        self.assertEqual(script("task.sh", "0").returncode, 0)
        done = script("merge.sh")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((array / "merged.store").is_symlink())


if __name__ == "__main__":
    cli.main()
