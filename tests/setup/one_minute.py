#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes the first job of the README at its word, by hand: a minute of search in an empty folder, then every
finished loop through both checkers, and a replay of each that must come to the certified period.

  tests/setup/one_minute.py [MINUTES]

Exit 0 if at least ten different minimized cycles passed, one of them of two contacts under the whole grid.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUN = str(ROOT / "run")


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def replays_as_certified(problem, certificate):
    run = certificate["witness"]["runs"][0]
    command = [RUN, "replay", str(problem), "--json", "--policy", run["policies"][0]]
    replay = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    stated = (certificate["claim"], run["start"], run["period"])
    return (replay["outcome"], replay["start"], replay["period"]) == stated


def main():
    minutes = sys.argv[1] if len(sys.argv) > 1 else "1"
    with tempfile.TemporaryDirectory() as folder:
        store, report = f"{folder}/stiction.store", pathlib.Path(folder) / "report"
        print(output(RUN, "search", "--minutes", minutes, "--store", store))
        output(RUN, "report", store, "-o", str(report))
        certificates = sorted(report.glob("findings/*.certificate.json"))
        names = [str(path) for path in certificates]
        output(RUN, "check", *names)
        output(sys.executable, str(ROOT / "certify/check_certificate.py"), *names)
        cycles = whole_grid = 0
        for path in certificates:
            certificate = json.loads(path.read_text())
            if certificate["claim"] != "cycle":
                continue
            problem = path.with_name(path.name.replace(".certificate", ""))
            if not replays_as_certified(problem, certificate):
                sys.exit(f"{problem.name}: replays to another period than certified")
            cycles += 1
            policies = sum(len(run["policies"]) for run in certificate["witness"]["runs"])
            whole_grid += policies == 1536 and len(certificate["problem"]["contacts"]) == 2
        print(f"{len(certificates)} certificates accepted by both checkers; {cycles} minimized cycles replayed to "
              f"their period, {whole_grid} of two contacts under the whole grid")
        sys.exit(0 if cycles >= 10 and whole_grid >= 1 else 1)


if __name__ == "__main__":
    main()
