#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the fuzz targets (targets.h) with clang, libFuzzer and the sanitizers in build/sanitize, and runs them.

    tests/fuzz/fuzz.py [--seconds N] [--target NAME ...] [--longer NAME=N] [--jobs N]

A target starts from its seeds (targets.json), from inputs that once failed (findings/NAME), and from what
earlier runs found worth keeping (build/fuzz/corpus/NAME). An input that fails, takes too long or too much
memory is written to build/fuzz/found/NAME, and the target goes on. What took too long beside other work is run again
alone, and stays a finding if it does not end within as much processor time.

Seconds are processor time of one and the same binary, over as many calls as it takes: what was spent is kept in
build/fuzz/spent.json beside the binary's hash, call by call, so that a run that was cut goes on, and a tree that
builds other code starts anew. With --seconds 0 nothing runs, and the table says what the binaries of this tree have
behind them. Prints a line per target.
Exit: 0 if nothing was found, 1 if something was.
"""

import argparse
import collections
import concurrent.futures
import fcntl
import hashlib
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "fuzz"
BINARIES = ROOT / "build" / "sanitize"  # that of ./run test --nightly, whose tests are sanitized
TABLE = json.loads((ROOT / "tests/fuzz/targets.json").read_text())

SECONDS_PER_INPUT = 20
MEGABYTES = 2560
MOST_FINDINGS = 5  # of a target, then it has to be mended first
SECONDS_PER_CALL = 300  # of libFuzzer: no more is lost if all is killed
WORDS_IN_DICTIONARY = 500


def build(targets, jobs):
    if not (BINARIES / "build.ninja").exists():
        subprocess.run(["cmake", "-S", ROOT, "--preset", "sanitize"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", BINARIES, "-j", str(jobs), *(f"fuzz_{name}" for name in targets)], check=True)


# ---- Seeds -------------------------------------------------------------------------------------

def seeds_of(name):
    """Bytes of every seed that is not too long; a file of lines holds one each."""
    for folder in TABLE[name]["seeds"]:
        for file in sorted((ROOT / folder).iterdir()):
            if file.suffix == ".lines":
                yield from file.read_bytes().splitlines()
            elif file.suffix in (".json", ".dat") and file.stat().st_size <= TABLE[name]["bytes"]:
                yield file.read_bytes()


def write_seeds(name):
    folder = BUILD / "seeds" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for seed in seeds_of(name):
        (folder / hashlib.sha1(seed).hexdigest()).write_bytes(seed)
    return folder


def write_dictionary(name):
    """Words of the seeds, the most frequent ones."""
    words = collections.Counter()
    for seed in seeds_of(name):
        words.update(re.findall(rb'"[^"\\]{1,40}"|[^\s"\\,:\[\]{}]{1,40}', seed))
    file = BUILD / f"{name}.dict"
    escaped = ("".join(f"\\x{byte:02x}" for byte in word) for word, _ in words.most_common(WORDS_IN_DICTIONARY))
    file.write_text("".join(f'"{word}"\n' for word in escaped))
    return file


# ---- What was spent ----------------------------------------------------------------------------

class Ledger:
    """build/fuzz/spent.json: seconds and inputs by target and binary. Shared by the threads of a run."""

    FILE = BUILD / "spent.json"

    def __init__(self):
        self.lock = threading.Lock()
        self.rows = json.loads(self.FILE.read_text()) if self.FILE.exists() else {}

    def row(self, name):
        """Of the binary that is there now; another one has spent nothing."""
        binary = hashlib.sha256(program(name).read_bytes()).hexdigest()
        with self.lock:
            if self.rows.get(name, {}).get("binary") != binary:
                self.rows[name] = {"binary": binary, "seconds": 0.0, "inputs": 0, "edges": 0, "findings": [],
                                   "broken": False}
            return self.rows[name]

    def write(self):
        with self.lock:
            new = self.FILE.with_suffix(".new")
            new.write_text(json.dumps(self.rows, indent=1) + "\n")
            new.replace(self.FILE)


# ---- Runs --------------------------------------------------------------------------------------

def program(name):
    return BINARIES / "tests/fuzz" / f"fuzz_{name}"


def ends_in_time(command):
    """Whether a command ends well within the processor time of an input."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS_PER_INPUT, SECONDS_PER_INPUT))

    try:
        return subprocess.run([str(word) for word in command], preexec_fn=limit, timeout=10 * SECONDS_PER_INPUT,
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except subprocess.TimeoutExpired:  # it waits for something
        return False


class Run:
    """What one target did."""

    def __init__(self, name, ledger):
        self.name = name
        self.ledger = ledger
        self.spent = ledger.row(name)
        self.found = BUILD / "found" / name
        self.corpus = BUILD / "corpus" / name
        for folder in (self.found, self.corpus):
            folder.mkdir(parents=True, exist_ok=True)
        self.before = {file for file in self.found.iterdir() if file.name not in self.spent["findings"]}

    def findings(self):
        """Of this binary."""
        new = set(self.found.iterdir()) - self.before
        return sorted(file for file in new if not file.name.startswith("slow-unit"))

    def command(self, seconds):
        folders = [self.corpus, write_seeds(self.name), ROOT / "tests/fuzz/findings" / self.name]
        dictionary = write_dictionary(self.name)
        words = [f"-dict={dictionary}"] if dictionary.stat().st_size else []
        return [program(self.name), *(f for f in folders if f.is_dir()), *words,
                f"-max_total_time={seconds}", f"-max_len={TABLE[self.name]['bytes']}",
                f"-timeout={SECONDS_PER_INPUT}", f"-rss_limit_mb={MEGABYTES}",
                f"-artifact_prefix={self.found}/", "-print_final_stats=1", "-report_slow_units=5"]

    def once(self, seconds):
        """libFuzzer until it has spent its time, or has found something."""
        log = BUILD / "log" / f"{self.name}.txt"
        log.parent.mkdir(exist_ok=True)
        with log.open("ab") as output:
            start = output.tell()
            process = subprocess.Popen([str(word) for word in self.command(seconds)], stdin=subprocess.DEVNULL,
                                       stdout=output, stderr=output)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        text = log.read_bytes()[start:].decode(errors="replace")
        executed = re.findall(r"stat::number_of_executed_units: (\d+)", text)
        self.spent["seconds"] += usage.ru_utime + usage.ru_stime
        self.spent["inputs"] += int(executed[-1]) if executed else 0
        self.spent["edges"] = max([self.spent["edges"], *map(int, re.findall(r"\bcov: (\d+)", text))])
        excused = self.judge_timeouts()
        self.spent["findings"] = [file.name for file in self.findings()]
        self.ledger.write()
        return process.returncode == 0 or excused

    def judge_timeouts(self):
        """libFuzzer's clock goes on while the machine does something else: alone, by processor time, it is judged.
        Whether one was none."""
        excused = False
        for file in self.findings():
            if file.name in self.spent["findings"] or not file.name.startswith("timeout-"):
                continue  # judged before, or another kind
            if ends_in_time([program(self.name), file]):
                file.rename(file.with_name(f"slow-unit-{file.name}"))
                excused = True
        return excused

    def go(self, seconds):
        while (left := round(seconds - self.spent["seconds"])) > 0 and len(self.findings()) < MOST_FINDINGS:
            before = len(self.findings())
            self.spent["broken"] = False  # of a call before: it is tried again
            if not self.once(min(left, SECONDS_PER_CALL)) and len(self.findings()) == before:
                self.spent["broken"] = True  # ended by itself without a file that says why
                self.ledger.write()
                break
        print(self.line(), flush=True)
        return self

    def line(self):
        line = (f"{self.name:12} {self.spent['inputs']:>11} {self.spent['seconds']:>9.0f} {self.spent['edges']:>9} "
                f"{len(list(self.corpus.iterdir())):>8} {len(self.spent['findings']):>9}")
        for file in self.findings():
            line += f"\n  {file}: run {program(self.name)} {file}"
        if self.spent["broken"]:
            line += f"\n  ended by itself: {BUILD}/log/{self.name}.txt"
        return line


def longer(words):
    name, _, seconds = words.partition("=")
    if name not in TABLE or not seconds.isdigit():
        raise argparse.ArgumentTypeError(f"found '{words}', expected one of {', '.join(TABLE)}, '=' and seconds")
    return name, int(seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=60, help="of processor time of every target (default 60)")
    parser.add_argument("--target", nargs="+", choices=list(TABLE), metavar="NAME",
                        default=[name for name, row in TABLE.items() if not row.get("only_if_named")],
                        help=f"of {', '.join(TABLE)}")
    parser.add_argument("--longer", type=longer, default=("", 0), metavar="NAME=N", help="seconds of one of them")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build, and targets at a time")
    o = parser.parse_args()
    BUILD.mkdir(parents=True, exist_ok=True)
    lock = (BUILD / "lock").open("w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"{BUILD}: another run of targets is under way")
    build(o.target, o.jobs)
    ledger = Ledger()
    print(f"{'target':12} {'inputs':>11} {'seconds':>9} {'edges':>9} {'corpus':>8} {'findings':>9}", flush=True)
    of = {name: seconds for name, seconds in [o.longer] if name in o.target}  # the longest first
    of |= {target: o.seconds for target in o.target if target not in of}
    with concurrent.futures.ThreadPoolExecutor(max_workers=o.jobs) as pool:
        runs = list(pool.map(lambda item: Run(item[0], ledger).go(item[1]), of.items()))
    return 1 if any(run.spent["broken"] or run.spent["findings"] for run in runs) else 0


if __name__ == "__main__":
    sys.exit(main())
