# SPDX-License-Identifier: Apache-2.0
"""What the build of `./run search` costs, in processor seconds, against a budget.

    build_budget.py BUILD [REFERENCE_SECONDS]

BUILD/compile_times.csv holds what every compilation cost (cmake/record_time.sh); nothing of the program is
compiled again. Machines differ, and so do they from hour to hour: everything is measured in compilations of a
reference unit, which is compiled here, unless its seconds are given. Exit: 1 above the budget. Where the list is not
that of one whole build, for example because a compiler cache was at work, it says SKIPPED and why."""

import csv
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TARGETS = ["stiction-search", "stiction-ipopt"]
# In reference units.
MOST_IN_ALL = 300
MOST_OF_ONE_UNIT = 40
# About what a small unit of the program reads and instantiates.
REFERENCE = """#include <Eigen/LU>
#include <map>
#include <string>
Eigen::MatrixXd Inverse(const Eigen::MatrixXd& A) { return A.partialPivLu().inverse(); }
std::map<std::string, std::string> Copy(const std::map<std::string, std::string>& m) { return {m.begin(), m.end()}; }
"""


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(0)


def objects(build):
    """What the targets are linked from, and the headers precompiled for them."""
    found = set()
    for target in TARGETS:
        listed = subprocess.run(["ninja", "-C", build, "-t", "inputs", target], capture_output=True, text=True)
        if listed.returncode:
            skip(f"{build} is no build of ninja")
        found |= {line for line in listed.stdout.split() if line.endswith((".o", ".gch"))}
    return found


def recorded(build):
    """Object -> processor seconds of its last compilation."""
    try:
        with open(build / "compile_times.csv") as file:
            return {name: float(seconds) for name, seconds in csv.reader(file)}
    except FileNotFoundError:
        return {}


def reference_seconds():
    """The least of three: what disturbs only adds."""
    launcher = Path(__file__).resolve().parents[2] / "cmake" / "record_time.sh"
    with tempfile.TemporaryDirectory() as folder:
        unit, times = Path(folder) / "reference.cpp", Path(folder) / "times.csv"
        unit.write_text(REFERENCE)
        for _ in range(3):
            subprocess.run([launcher, times, shutil.which("g++"), "-std=c++20", "-O3", "-isystem",
                            "/usr/include/eigen3", "-c", unit, "-o", unit.with_suffix(".o")], check=True)
        with open(times) as file:
            return min(float(seconds) for _, seconds in csv.reader(file))


def main():
    build = Path(sys.argv[1])
    times, wanted = recorded(build), objects(build)
    missing = wanted - set(times)
    if missing:
        skip(f"{len(missing)} of {len(wanted)} compilations were not recorded: a compiler cache, or an older build")
    reference = float(sys.argv[2]) if len(sys.argv) > 2 else reference_seconds()
    costs = sorted(((times[name], name) for name in wanted), reverse=True)
    total = sum(seconds for seconds, _ in costs)
    print(f"{len(costs)} compilations, {total:.0f} s of processor time, {total / reference:.0f} reference units of "
          f"{reference:.2f} s; budget {MOST_IN_ALL}, of one {MOST_OF_ONE_UNIT}")
    for seconds, name in costs[:10]:
        print(f"{seconds:8.1f} s {seconds / reference:6.1f}  {name}")
    return total > MOST_IN_ALL * reference or costs[0][0] > MOST_OF_ONE_UNIT * reference


if __name__ == "__main__":
    sys.exit(main())
