#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a check costs is bounded by what is read: so many seconds and megabytes, and so many for each byte.

  cost_test.py STICTION SOURCES             in CI: families of cost_cases.py, each of one size, and some that are drawn
  cost_test.py STICTION SOURCES --measure   the same, and what each costs

STICTION_TESTS=all has more sizes, up to the largest file, and more that are drawn. Each certificate is shown to a
checker in a process of its own, whose processor time and memory are those of the system (wait4). A checker may accept
or refuse, but not fail, and not cost more than stated below. Python standard library only.

Seconds are those of a machine that is idle: a fixed piece of work, made beside, tells how much slower this one is.
"""

import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

sys.dont_write_bytecode = True
import cost_cases

# At most: processor seconds, and microseconds a byte; megabytes, and bytes a byte. Twice of what was measured.
Cost = namedtuple("Cost", "seconds by_byte megabytes bytes_by_byte")
PROGRAM, SCRIPT = Cost(3, 0.6, 640, 60), Cost(9, 1.0, 120, 36)
REFERENCE = "from fractions import Fraction\nx = Fraction(1, 3)\nfor k in range(60000): x = (x * 7 + k) % 11"
REFERENCE_SECONDS = 0.3  # on an idle machine
TRIES = 3  # of what costs too much
OF_RUNS = ("cycle", "endless", "ray", "counterexample", "every-choice")


def measured(command):
    """Exit code, what was said, processor seconds and megabytes."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (150, 150))

    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=limited)
    text = process.stdout.read().decode(errors="replace")
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def slowness():
    """How many times slower than an idle machine of the kind on which the limits were measured."""
    return max(measured([sys.executable, "-c", REFERENCE])[2] / REFERENCE_SECONDS, 1)


def fault(command, file, cost, told):
    """What is wrong with a check; "" if nothing is. What takes too long is measured again."""
    size = file.stat().st_size
    most = cost.seconds + cost.by_byte * size / 1e6
    for _ in range(TRIES):
        code, text, seconds, megabytes = measured([*command, file])
        told.append(f"{seconds:7.2f} s {megabytes:6.0f} MB {text.split(':')[1].strip()[:9] if ':' in text else code}")
        if code not in (0, 1, 2):
            return f"exit {code}: {text[-200:]}"
        if megabytes > cost.megabytes + cost.bytes_by_byte * size / 2**20:
            return f"{megabytes:.0f} MB for {size} bytes: {text[-120:]}"
        slower = 1 if seconds <= most else slowness()
        if seconds <= slower * most:
            return ""
    return f"{seconds:.1f} s, {slower:.1f} times slower than idle, for {size} bytes: {text[-120:]}"


# --- What is shown ---------------------------------------------------------------------

# Sizes besides, the first of them in CI too. Velocities that no row touches once took 26 s and 1.8 GB.
LARGEST = {"velocities_untouched": (1.59e7, 3.2e7), "semidefinite_of_nothing": (3.1e7,)}


def shown(sources, extent):
    """(name, certificate or text)"""
    read = lambda place: json.loads((sources / "corpus" / place).read_text())
    cycle = read("certificates/safe-tie-cycle-3-contacts.cycle.json")
    loops = [read(f"space/certificates/{name}.json") for name in ("ray-under-slip-literal.ray", "no-state-twice.endless")]
    families = list(cost_cases.families(cycle, loops))
    sizes = (1e5, 4e6) if extent == "all" else (3e5,)
    for name, family in families:
        for size in (*sizes, *(LARGEST.get(name, ()) if extent == "all" else LARGEST.get(name, ())[:1])):
            yield f"{name} {size:.0e}", family(int(size))
    for seed in range(120 if extent == "all" else 25):
        yield f"drawn {seed}", cost_cases.drawn(random.Random(seed), families)


def main(stiction, sources, *options):
    sources, extent, failures, count = Path(sources), os.environ.get("STICTION_TESTS"), [], 0
    checkers = [("stiction check", [stiction, "check"], PROGRAM)]
    for script in () if extent == "short" else ("check_certificate.py", "check_runs.py"):
        checkers.append((script, [sys.executable, sources / "certify" / script], SCRIPT))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "certificate.json"
        for count, (name, content) in enumerate(shown(sources, extent), 1):
            file.write_text(content if isinstance(content, str) else json.dumps(content, separators=(",", ":")))
            claim = content["claim"] if isinstance(content, dict) else ""
            for checker, command, cost in checkers:
                if checker == "check_runs.py" and claim not in OF_RUNS:
                    continue
                told = []
                wrong = fault(command, file, cost, told)
                failures += [f"{name}: {checker}: {wrong}"] if wrong else []
                if "--measure" in options or wrong:
                    print(f"{name:32} {checker:21} {file.stat().st_size / 1e6:6.2f} MB {'; '.join(told)}", flush=True)
    for failure in failures:
        print("FAILED:", failure)
    print(f"{count} certificates, {len(failures)} failures")
    return 1 if failures or count < 50 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
