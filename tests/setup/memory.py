#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How a night grows: resident memory and size of the store of one search, by hand.

  tests/setup/memory.py PROGRAM [--campaign FILE] [--minutes M ...] [--night N] [--threads T] [--json]

At every mark: problems, groups, memory now and at most so far, the store with its log. With --night also what N minutes
would come to, from the growth between the last two marks, by problem: no less, where the growth falls with time.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
NIGHT = ROOT / "search" / "campaigns" / "night.json"
HEAD = ["minutes", "problems", "groups", "memory, MB", "at most", "store, MB", "bytes of store a problem"]


def memory(pid):
    """Bytes: resident now, and at most so far."""
    lines = pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
    sizes = {line.split(":")[0]: int(line.split()[1]) * 1024 for line in lines if line.startswith(("VmRSS", "VmHWM"))}
    return sizes["VmRSS"], sizes["VmHWM"]


def size(store):
    """The file, and what is written and not yet in it."""
    return sum(os.path.getsize(f"{store}{end}") for end in ("", "-wal") if os.path.exists(f"{store}{end}"))


def sample(program, search, store, minutes):
    if search.poll() is not None:
        sys.exit(f"memory: the search ended by itself, with status {search.returncode}")
    resident, most = memory(search.pid)
    done = subprocess.run([program, "status", store, "--json"], check=True, capture_output=True, text=True)
    status = json.loads(done.stdout)
    return {"minutes": minutes, "problems": status["problems"], "groups": sum(status["groups"].values()),
            "resident": resident, "most": most, "store": size(store)}


def watch(program, campaign, marks, threads, folder):
    """A sample at every mark of one search."""
    store = folder / "night.store"
    command = [program, "search", campaign, "--store", store, "--minutes", max(marks) + 60]
    if threads:
        command += ["--threads", threads]
    search = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    start, samples = time.monotonic(), []
    try:
        for mark in sorted(marks):
            time.sleep(max(0, start + 60 * mark - time.monotonic()))
            samples.append(sample(program, search, store, mark))
            print(f"memory: {samples[-1]}", file=sys.stderr, flush=True)
    finally:
        search.terminate()
        search.wait()
    return samples


def night(samples, minutes):
    """What a night comes to: all that grew between the last two marks grows on so, problem by problem."""
    before, last = samples[-2:]
    problems = last["problems"] * minutes / last["minutes"]
    more = (problems - last["problems"]) / (last["problems"] - before["problems"])
    grown = {key: last[key] + more * max(0, last[key] - before[key]) for key in ("groups", "resident", "most", "store")}
    return {"minutes": minutes, "problems": problems, **grown}


def row(sample):
    return [f"{sample['minutes']:g}", f"{round(sample['problems'], -3):,.0f}", f"{sample['groups']:,.0f}",
            *(f"{sample[key] / 1e6:,.1f}" for key in ("resident", "most", "store")),
            f"{sample['store'] / sample['problems']:.3f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--campaign", default=NIGHT)
    parser.add_argument("--minutes", type=float, nargs="+", default=[1, 10, 60])
    parser.add_argument("--night", type=float)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.night and len(options.minutes) < 2:
        parser.error("--minutes: found one mark, expected two or more: --night goes by the growth between two")
    with tempfile.TemporaryDirectory(prefix="stiction-memory-") as folder:
        samples = watch(os.path.abspath(options.program), options.campaign, options.minutes, options.threads,
                        pathlib.Path(folder))
    told = [night(samples, options.night)] if options.night else []
    if options.json:
        print(json.dumps({"samples": samples, "told": told}))
    else:
        for line in (HEAD, *map(row, [*samples, *told])):
            print("  ".join(f"{cell:>24}" for cell in line))


if __name__ == "__main__":
    main()
