#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clang-tidy (.clang-tidy) on the C++ sources that changed.

    tidy.py BUILD [FILE...]    BUILD knows how each is compiled

Changed is what differs from the last commit, or if nothing does, what the last commit changed. A header is looked at
with one source that includes it. Exit 1 if something was found; SKIPPED, and 0, where there is no clang-tidy."""

import concurrent.futures
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("solver", "scene", "corpus", "certify", "search", "reports", "cli", "bench")
DROPPED = ("-fno-ivopts", "-fno-semantic-interposition", "-Wno-restrict", "-Wno-stringop-overflow", "-Winvalid-pch")


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()


def changed():
    found = git("diff", "--name-only", "--diff-filter=d", "HEAD") + git("ls-files", "--others", "--exclude-standard")
    found = found or git("show", "--format=", "--name-only", "--diff-filter=d", "HEAD")
    return [name for name in found if name.startswith(FOLDERS) and name.endswith((".h", ".ipp", ".cpp"))
            and not name.startswith("bench/peers/")]


def compiled(build):
    """Source -> its command, for clang: without precompiled headers, and with every source of a unity build by itself."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True).stdout
    commands = {}
    for entry in json.loads(listed):
        if not entry["file"].endswith((".cpp", ".cxx")) or " -c " not in entry["command"]:
            continue
        words = entry["command"].split()
        words = words[next(i for i, word in enumerate(words) if word.endswith("++")):]
        kept, skip = [], False
        for word in words:
            if skip:
                skip = word != "cmake_pch.hxx" and not word.endswith("cmake_pch.hxx")
                continue
            if word == "-include":
                skip = True
            elif word not in DROPPED and not word.startswith("-Werror"):
                kept.append(word)
        file = Path(entry["directory"], entry["file"])
        sources = [file]
        if "Unity" in file.parts and file.exists():
            sources = [Path(line.split('"')[1]) for line in file.read_text().splitlines() if line.startswith("#include")]
        for source in sources:
            command = " ".join(str(source) if word == entry["file"] else word for word in kept)
            commands.setdefault(str(source), {"directory": entry["directory"], "file": str(source), "command": command})
    return commands


def sources_for(names, commands):
    """The changed sources, and one for each header that has none of its own."""
    chosen = {}
    for name in names:
        path = ROOT / name
        own = path.with_suffix(".cpp")
        if str(own) in commands:
            chosen[str(own)] = True
            continue
        including = next((source for source in sorted(commands) if f'"{name}"' in Path(source).read_text()), None)
        if including:
            chosen[including] = True
    return list(chosen)


def main():
    build = Path(sys.argv[1]).resolve()
    tool = shutil.which("clang-tidy") or shutil.which("clang-tidy-14")
    if not tool:
        print("SKIPPED: found no clang-tidy")
        return 0
    commands = compiled(build)
    sources = sources_for(sys.argv[2:] or changed(), commands)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "compile_commands.json").write_text(json.dumps([commands[source] for source in sources]))

        def look(source):
            return subprocess.run([tool, "-p", folder, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", source],
                                  capture_output=True, text=True)

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(look, sources))
    for result in results:
        if result.returncode:
            print(result.stdout or result.stderr)
    found = sum(result.returncode != 0 for result in results)
    print(f"clang-tidy: {len(sources)} sources, something found in {found}")
    return found > 0


if __name__ == "__main__":
    sys.exit(main())
