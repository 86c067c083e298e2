# SPDX-License-Identifier: Apache-2.0
"""fuzz.py: what it makes of a target's ends. The target here is a script that ends as it is told."""

import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import fuzz

# Called with options it is libFuzzer: it ends as the next word of `plan` says. With a file alone it takes the input
# again, as the file's text says.
TARGET = """#!{python}
import sys, time
from pathlib import Path
folder = Path({folder!r})
options = [word for word in sys.argv[1:] if word.startswith("-")]
if not options:
    text = Path(sys.argv[-1]).read_text()
    while text == "busy": pass
    if text == "waits": time.sleep(60)
    sys.exit(0)
plan = (folder / "plan").read_text().split()
(folder / "plan").write_text(" ".join(plan[1:]))
end = plan[0] if plan else "ok"
prefix = next(word.split("=")[1] for word in options if word.startswith("-artifact_prefix"))
print("#9 NEW cov: 17 ft: 1\\nstat::number_of_executed_units: 100", file=sys.stderr)
start = time.process_time()
while time.process_time() - start < 0.6: pass
if end in ("quick", "busy", "waits"): Path(prefix, "timeout-" + end).write_text(end)
if end == "crash": Path(prefix, "crash-1").write_text("")
sys.exit(0 if end == "ok" else 70)
"""


class Ends(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="stiction-fuzz-"))
        self.addCleanup(shutil.rmtree, self.folder)
        before = {name: getattr(fuzz, name) for name in ("BUILD", "program", "SECONDS_PER_INPUT")}
        self.addCleanup(lambda: [setattr(fuzz, name, value) for name, value in before.items()])
        fuzz.BUILD, fuzz.SECONDS_PER_INPUT = self.folder, 1
        target = self.folder / "target"
        target.write_text(TARGET.format(python=sys.executable, folder=str(self.folder)))
        target.chmod(0o755)
        fuzz.program = lambda name: target
        fuzz.Ledger.FILE = self.folder / "spent.json"

    def go(self, plan, seconds=2):
        (self.folder / "plan").write_text(plan)
        return fuzz.Run("rational", fuzz.Ledger()).go(seconds)

    def test_a_target_spends_its_time(self):
        run = self.go("")
        self.assertGreaterEqual(run.spent["seconds"], 1.5)
        self.assertEqual((run.spent["findings"], run.spent["broken"], run.spent["edges"]), ([], False, 17))
        self.assertEqual(run.spent["inputs"] % 100, 0)
        inputs = run.spent["inputs"]
        again = self.go("crash")  # nothing is left to do
        self.assertEqual((again.spent["inputs"], again.spent["findings"]), (inputs, []))

    def test_what_was_slow_beside_other_work_is_no_finding_and_no_end(self):
        run = self.go("quick ok")
        self.assertEqual((run.spent["findings"], run.spent["broken"]), ([], False))
        self.assertGreaterEqual(run.spent["seconds"], 1.5)
        self.assertTrue((self.folder / "found/rational/slow-unit-timeout-quick").exists())

    def test_what_computes_without_end_is_one(self):
        run = self.go("busy")
        self.assertEqual((run.spent["findings"], run.spent["broken"]), (["timeout-busy"], False))

    def test_what_waits_is_one(self):
        run = self.go("waits")
        self.assertEqual((run.spent["findings"], run.spent["broken"]), (["timeout-waits"], False))

    def test_a_crash_is_one(self):
        run = self.go("crash")
        self.assertEqual(run.spent["findings"], ["crash-1"])
        self.assertIn("crash-1", run.line())

    def test_an_end_without_a_file_stops_the_target_until_it_is_called_again(self):
        run = self.go("dies ok ok ok")
        self.assertTrue(run.spent["broken"])
        self.assertLess(run.spent["seconds"], 1.5)
        self.assertIn("ended by itself", run.line())
        self.assertTrue(json.loads(fuzz.Ledger.FILE.read_text())["rational"]["broken"])
        self.assertTrue(fuzz.Run("rational", fuzz.Ledger()).go(0).spent["broken"])
        self.assertFalse(self.go("ok ok ok").spent["broken"])


if __name__ == "__main__":
    unittest.main()
