# SPDX-License-Identifier: Apache-2.0
"""stiction slurm: the scripts run without Slurm, in a loop and under GNU parallel, and leave the same whatever the number
of shards. The test with a Slurm is tests/setup/cluster.py."""

import os
import shutil
import signal
import stat
import subprocess
import time

import cli

CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 4, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "first_unit_problems": 2000, "unit_problems": 2000}
PROBLEMS = 300000 if cli.ALL else 60000


class Slurm(cli.TestCase):
    def make(self, shards, problems=PROBLEMS, name=None):
        folder = self.folder / (name or f"array of {shards}")  # a blank in the name
        done = self.succeeds("slurm", self.file("c.json", CAMPAIGN), "--shards", shards, "--problems", problems,
                             "-o", folder)
        self.assertEqual(done.out, f"{folder}/submit.sh\n")
        return folder

    def script(self, folder, script, *arguments, path=None, **variables):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("SLURM_")}
        # Without the commands of a Slurm that may be installed here.
        environment.update(PATH=path or self.tools(), **{name: str(value) for name, value in variables.items()})
        return subprocess.run(["bash", folder / script, *map(str, arguments)], env=environment, cwd="/",
                              capture_output=True, text=True, timeout=300)

    def tools(self, **more):
        """A folder with the programs that the scripts need, and those that stand for Slurm's."""
        bin_ = self.folder / "bin"
        if not bin_.exists():
            bin_.mkdir()
            for name in ("bash", "date", "head", "mktemp", "mv", "rm", "sed", "sleep", "sync", "tr", "cat"):
                (bin_ / name).symlink_to(shutil.which(name))
        for name, text in more.items():
            (bin_ / name).write_text(f"#!/bin/bash\n{text}\n")
            (bin_ / name).chmod(0o755)
        return str(bin_)

    def run_all(self, folder, shards):
        for shard in range(shards):
            done = self.script(folder, "task.sh", SLURM_ARRAY_TASK_ID=shard)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = self.script(folder, "merge.sh")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.tables_of(folder)

    def tables_of(self, folder):
        """All but of work.csv, which says how long the processors took."""
        return {path.name: path.read_bytes() for path in (folder / "report").glob("*.csv") if path.name != "work.csv"}

    def test_the_number_of_shards_does_not_matter(self):
        one = self.make(1)
        tables = self.run_all(one, 1)
        self.assertGreater(len(tables), 5)
        self.assertGreater(len(tables["findings.csv"].splitlines()), 2)
        self.assertNotIn(b"pending", tables["findings.csv"])
        for shards in (4, 16):
            folder = self.make(shards)
            self.assertEqual(self.run_all(folder, shards), tables)
            self.assertSameContent(folder / "merged.store", one / "merged.store", ["campaign", "findings"])
            self.assertEqual(sorted(path.name for path in (folder / "shards").iterdir()),
                             sorted([".keep", *(f"{shard}.store" for shard in range(shards))]))
        # And it is what one search finds.
        plain = self.folder / "plain.store"
        self.succeeds("search", self.folder / "c.json", "--store", plain, "--problems", PROBLEMS, "--finishing", 100)
        self.assertSameContent(plain, one / "merged.store", ["campaign", "findings", "blocks", "units"])

    def test_gnu_parallel_runs_the_same_tasks(self):
        if shutil.which("parallel") is None:
            self.skipTest("SKIPPED: GNU parallel is not installed")
        folder = self.make(4, name="array-of-4")  # parallel takes its command for one of the shell
        done = subprocess.run(["parallel", "--will-cite", "-j2", str(folder / "task.sh"), ":::", *map(str, range(4))],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.script(folder, "merge.sh")
        self.assertEqual(done.returncode, 0, done.stderr)
        one = self.make(1)
        self.assertEqual(self.tables_of(folder), self.run_all(one, 1))

    def test_a_task_that_is_done_is_not_done_again(self):
        folder = self.make(2)
        self.assertEqual(self.script(folder, "task.sh", 1).returncode, 0)
        before = (folder / "shards/1.store").stat()
        done = self.script(folder, "task.sh", 1)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((folder / "shards/1.store").stat(), before)
        for shard in (2, "x", ""):
            done = self.script(folder, "task.sh", shard)
            self.assertEqual(done.returncode, 2)
            self.assertIn("expected 0 to 1", done.stderr)

    def test_a_merge_does_without_nothing_that_is_missing(self):
        folder = self.make(4)
        for shard in (0, 2, 3):
            self.script(folder, "task.sh", shard)
        (folder / "shards/2.store").write_bytes(b"torn")
        done = self.script(folder, "merge.sh")
        self.assertEqual(done.returncode, 75)
        self.assertIn("missing: 1,2", done.stderr)
        self.assertFalse((folder / "merged.store").exists())
        self.assertTrue((folder / "shards/2.store.damaged").exists())
        # With Slurm they run again, and the merge after them, with the options of the first time.
        calls = self.folder / "calls"
        path = self.tools(sbatch=f'echo "$@" >>{calls}; echo 77', scontrol="exit 1")
        (folder / "options").write_text("--account=a b\n")
        done = self.script(folder, "merge.sh", path=path)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(calls.read_text().splitlines(),
                         ["--parsable --account=a b --array=1-2 --export=ALL,STICTION_FIRST=0 task.sh",
                          "--parsable --account=a b --export=ALL,STICTION_ROUND=2 --dependency=afterany:77 merge.sh"])
        self.assertEqual(self.script(folder, "merge.sh", path=path, STICTION_ROUND=5).returncode, 75)

    def test_a_thousand_tasks_make_an_array(self):
        folder = self.make(2500, problems=10**8)
        calls = self.folder / "calls"
        path = self.tools(sbatch=f'for word; do echo "$word"; done >>{calls}; echo "7;cluster"', seq='exec /usr/bin/seq "$@"')
        done = self.script(folder, "submit.sh", "--comment=two words", path=path)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "tasks 7, 7, 7, merge 7\n", ""))
        words = calls.read_text().splitlines()
        self.assertEqual(words.count("--comment=two words"), 4)
        self.assertEqual([word for word in words if "FIRST" in word], [f"--export=ALL,STICTION_FIRST={i}" for i in (0, 1000, 2000)])
        self.assertEqual([word for word in words if "--array" in word], [f"--array=0-{last}" for last in (999, 999, 499)])
        self.assertIn("--dependency=afterany:7:7:7", words)
        # A task knows its shard from both.
        done = self.script(folder, "task.sh", SLURM_ARRAY_TASK_ID=500, STICTION_FIRST=2000)
        self.assertIn("found shard '2500', expected 0 to 2499", done.stderr)

    def test_a_task_that_is_named_is_the_one_that_runs(self):
        folder = self.make(3, problems=20000)
        done = self.script(folder, "task.sh", 0, SLURM_ARRAY_TASK_ID=1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path.name for path in (folder / "shards").iterdir()}, {".keep", "0.store"})
        self.assertEqual(self.script(folder, "task.sh", 7, SLURM_ARRAY_TASK_ID=1).returncode, 2)

    def test_where_slurm_takes_no_more_the_merge_waits_for_what_it_took(self):
        folder = self.make(2500, problems=10**8)
        calls = self.folder / "calls"
        path = self.tools(sbatch=f'echo "$@" >>{calls}; [[ "$*" != *FIRST=1000* ]] && echo 7', seq='exec /usr/bin/seq "$@"')
        done = self.script(folder, "submit.sh", path=path)
        self.assertEqual((done.returncode, done.stdout), (0, "tasks 7, merge 7\n"), done.stderr)
        self.assertIn("from shard 1000 on: the merge has them run", done.stderr)
        self.assertIn("--dependency=afterany:7 merge.sh", calls.read_text())
        nothing = self.script(folder, "submit.sh", path=self.tools(sbatch="exit 1", seq='exec /usr/bin/seq "$@"'))
        self.assertEqual((nothing.returncode, nothing.stdout), (1, ""))

    def test_what_a_dead_node_leaves_goes_with_the_merge(self):
        folder = self.make(1, problems=20000)
        self.script(folder, "task.sh", 0)
        for name in (".0.99.0", ".0.99.0-wal"):
            (folder / "shards" / name).write_text("torn")
        self.assertEqual(self.script(folder, "merge.sh").returncode, 0)
        self.assertEqual({path.name for path in (folder / "shards").iterdir()}, {".keep", "0.store"})

    def start_task(self, folder, **variables):
        environment = {**os.environ, "PATH": self.tools(), **variables}
        task = subprocess.Popen(["bash", str(folder / "task.sh"), "0"], env=environment, stderr=subprocess.PIPE, text=True)
        self.addCleanup(task.wait)
        self.addCleanup(task.kill)
        end = time.monotonic() + 60
        while not list((folder / "shards").glob(".0.*/store-wal")) and time.monotonic() < end:
            time.sleep(0.02)
        return task

    def child_of(self, task):
        with open(f"/proc/{task.pid}/task/{task.pid}/children", encoding="ascii") as children:
            return int(children.read().split()[0])

    def test_a_task_whose_program_is_killed_or_that_is_told_to_end_is_queued_again(self):
        folder = self.make(2, problems=10**9)
        calls = self.folder / "calls"
        self.tools(scontrol=f'echo "$@" >>{calls}; exit 1')
        for kill in ("program", "task"):
            calls.write_text("")
            task = self.start_task(folder, SLURM_ARRAY_JOB_ID="5", SLURM_ARRAY_TASK_ID="0")
            if kill == "program":
                os.kill(self.child_of(task), signal.SIGKILL)
            else:
                task.terminate()
            _, err = task.communicate(timeout=60)
            self.assertEqual(task.returncode, 75, err)
            self.assertEqual(calls.read_text(), "requeue 5_0\n")
            self.assertEqual([path.name for path in (folder / "shards").iterdir()], [".keep"])
        calls.write_text("")
        task = self.start_task(folder, SLURM_ARRAY_JOB_ID="5", SLURM_ARRAY_TASK_ID="0", SLURM_RESTART_COUNT="5")
        os.kill(self.child_of(task), signal.SIGKILL)
        task.communicate(timeout=60)
        self.assertEqual((task.returncode, calls.read_text()), (75, ""))

    def test_a_name_that_looks_like_a_mark_is_a_name(self):
        folder = self.make(1, problems=2000, name="at@UNITS@@DIR@")
        self.assertIn("/at@UNITS@@DIR@\n", (folder / "task.sh").read_text())
        self.assertEqual(self.script(folder, "task.sh", 0).returncode, 0)

    def test_what_cannot_be_cut_is_refused(self):
        campaign, out = self.file("c.json", CAMPAIGN), self.folder / "out"
        self.refuses("slurm", campaign, "--shards", 100, "--problems", 2000, "-o", out, says="expected at most 1")
        self.refuses("slurm", campaign, "--shards", 1, "--problems", 2000, "-o", self.folder / "a%b", says="a%b")
        self.refuses("slurm", self.folder / "none.json", "--shards", 1, "--problems", 1, "-o", out, says="none.json")
        self.assertFalse(out.exists())
        folder = self.make(1)
        (folder / "shards/0.store").write_text("x")
        self.refuses("slurm", campaign, "--shards", 1, "--problems", 2000, "-o", folder, says=["0.store", "--replace"])
        for script in ("task.sh", "merge.sh", "submit.sh"):
            self.assertTrue((folder / script).stat().st_mode & stat.S_IXUSR)
            self.assertEqual(subprocess.run(["bash", "-n", folder / script]).returncode, 0)


if __name__ == "__main__":
    cli.main()
