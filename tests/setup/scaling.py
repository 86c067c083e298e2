#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What merging costs: many small shards of one campaign, merged at once and as a tree, by hand.

  tests/setup/scaling.py PROGRAM [--shards N ...] [--units U] [--fan F] [--threads T] [--json]

Every shard is a search of its own, of U units and without finishing, as a task of `stiction slurm` is; a shard of a
thousand shards is therefore a thousandth of its campaign, and no two campaigns share stores. Of each merge: processor
seconds, memory at most, size of what it leaves. A tree merges F stores at a time; its merges of one level are
independent, so it takes the time of one path, from a shard to the last merge, where there are machines enough. Both must
leave the same statistics and findings. Exit 1 if they do not.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

UNIT_PROBLEMS = 100
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 1, "generators": ["small", "psd"], "contacts": [2, 3, 4],
            "unit_problems": UNIT_PROBLEMS}
HEAD = ["shards", "units", "groups", "one merge, s", "memory, MB", "store, MB", "tree, s in all", "s on a path",
        "memory, MB"]


def call(program, *words):
    """Runs it alone; returns its processor seconds and the most memory it had."""
    process = subprocess.Popen([program, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 4):
        sys.exit(f"scaling: {words[0]}: exit {process.returncode}\n{said.decode()}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def status(program, store):
    return json.loads(subprocess.run([program, "status", store, "--json"], check=True, capture_output=True).stdout)


def total(program, store):
    """Without what another run of the same changes: builds and times."""
    answer = status(program, store)
    return {key: answer[key] for key in answer if key not in ("builds", "processor_seconds")}


def make_shards(program, folder, shards, units, threads):
    campaign = folder / "campaign.json"
    campaign.write_text(json.dumps(CAMPAIGN))
    problems = problems_of(program, folder, campaign, shards * units)

    def make(shard):
        store = folder / f"{shard}.store"
        call(program, "search", campaign, "--store", store, "--shard", f"{shard}/{shards}", "--problems", problems,
             "--finishing", 0, "--threads", 1)
        return store

    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        return list(pool.map(make, range(shards)))


def problems_of(program, folder, campaign, units):
    """How many problems so many units are: a few are asked how many they hold, and their schedule repeats."""
    store, few = folder / "few", 60
    call(program, "search", campaign, "--store", store, "--problems", few * UNIT_PROBLEMS, "--finishing", 0, "--threads", 1)
    answer = status(program, store)
    return answer["problems"] * units // answer["units"]


def merge_tree(program, folder, stores, fan):
    """Processor seconds of all merges and of one path through them, the most memory, and the last store."""
    spent = path = most = level = 0
    while len(stores) > 1 or level == 0:
        merges = []
        for first in range(0, len(stores), fan):
            out = folder / f"level-{level}-{first}"
            merges.append((*call(program, "merge", out, *stores[first:first + fan]), out))
        spent += sum(merge[0] for merge in merges)
        path += max(merge[0] for merge in merges)
        most = max(most, *(merge[1] for merge in merges))
        stores, level = [merge[2] for merge in merges], level + 1
    return {"seconds": spent, "path": path, "memory": most, "store": stores[0]}


def measure(program, folder, shards, units, fan, threads):
    stores = make_shards(program, folder, shards, units, threads)
    flat = folder / "flat"
    seconds, memory = call(program, "merge", flat, *stores)
    tree = merge_tree(program, folder, stores, fan)
    expected = total(program, flat)
    if expected != total(program, tree["store"]):
        sys.exit(f"scaling: {shards} shards: the tree leaves another total than one merge")
    return {"shards": shards, "units": expected["units"], "groups": sum(expected["groups"].values()), "seconds": seconds,
            "memory": memory, "store": os.path.getsize(flat), "tree_seconds": tree["seconds"], "tree_path": tree["path"],
            "tree_memory": tree["memory"]}


def row(merge):
    return [f"{merge['shards']:,}", f"{merge['units']:,}", f"{merge['groups']:,}", f"{merge['seconds']:.2f}",
            f"{merge['memory'] / 1e6:.0f}", f"{merge['store'] / 1e6:.1f}", f"{merge['tree_seconds']:.2f}",
            f"{merge['tree_path']:.2f}", f"{merge['tree_memory'] / 1e6:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--shards", type=int, nargs="+", default=[1, 10, 100, 1000])
    parser.add_argument("--units", type=int, default=64)
    parser.add_argument("--fan", type=int, default=32)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    merges = []
    for shards in options.shards:
        with tempfile.TemporaryDirectory(prefix="stiction-scaling-") as folder:
            merges.append(measure(os.path.abspath(options.program), pathlib.Path(folder), shards, options.units,
                                  options.fan, options.threads))
        print(f"scaling: {merges[-1]}", file=sys.stderr, flush=True)
    if options.json:
        print(json.dumps({"merges": merges, "fan": options.fan}))
    else:
        for line in (HEAD, *map(row, merges)):
            print("  ".join(f"{cell:>14}" for cell in line))


if __name__ == "__main__":
    main()
