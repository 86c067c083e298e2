#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build.py [--check]: the sources of sources.txt as one WebAssembly module, compressed: reports/web/solver/solver.wasm.gz.

Needs Emscripten (Debian: apt-get install --no-install-recommends emscripten). The module is committed, so that neither
the program nor its pages need Emscripten. Beside it stand the hashes of all sources that it was made of, as sha256sum
writes them: tests/cli/live_test.py fails when one has changed since. The same sources and packages of Debian 12 give the
same module: --check compiles, writes nothing, and fails where the committed one is another."""

import argparse
import gzip
import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MODULE = ROOT / "reports/web/solver/solver.wasm.gz"
HASHES = ROOT / "reports/web/solver/sources.sha256"
# Headers alone, and these alone: no other header of this system may come between those of Emscripten.
HEADERS = {"boost": "/usr/include/boost", "Eigen": "/usr/include/eigen3/Eigen", "nlohmann": "/usr/include/nlohmann",
           "fmt": "/usr/include/fmt"}
COMPILE = ["-std=c++20", "-O2", "-DNDEBUG", "-fno-rtti", "-fwasm-exceptions", "-DSTICTION_BOOST_RATIONALS",
           "-DEIGEN_MPL2_ONLY", "-DFMT_HEADER_ONLY"]
LINK = ["-O2", "-fwasm-exceptions", "--no-entry", "-sSTANDALONE_WASM", "-sFILESYSTEM=0", "-sALLOW_MEMORY_GROWTH",
        "-sMAXIMUM_MEMORY=1GB"]
# clang 14 orders some blocks of a module by where they stand in memory: another place in every run but for this, and
# with another length of any path, which is why it sees none but those of a scratch folder, always as long.
STEADY = ["setarch", "--addr-no-randomize"]


# What the sources may include.
FOLDERS = ("certify", "cli", "corpus", "reports", "scene", "search", "solver")


def not_cpp(folder, names):
    return [name for name in names if not Path(folder, name).is_dir() and Path(name).suffix not in (".h", ".ipp", ".cpp")]


def sources():
    return [line for line in (HERE / "sources.txt").read_text().split("\n") if line and not line.startswith("#")]


def hashes(rule):
    """Of the sources in a Makefile's rule, `all.o: all.cpp sources/solver/row.h headers/...`: `sha256sum --check` reads them."""
    words = rule.replace("\\\n", " ").split()
    files = sorted({word.removeprefix("sources/") for word in words if word.startswith("sources/")})
    return "".join(f"{hashlib.sha256((ROOT / file).read_bytes()).hexdigest()}  {file}\n" for file in files)


def module():
    """The bytes of the module, and the hashes of its sources. One compilation, since most of it is reading headers."""
    with tempfile.TemporaryDirectory(dir="/tmp") as scratch:
        headers = Path(scratch, "headers")
        headers.mkdir()
        for name, folder in HEADERS.items():
            (headers / name).symlink_to(folder)
        for folder in FOLDERS:  # copied: of a link the compiler would see where it leads
            shutil.copytree(ROOT / folder, Path(scratch, "sources", folder), ignore=not_cpp)
        Path(scratch, "all.cpp").write_text("".join(f'#include "{file}"\n' for file in [*sources(), "cli/live/exports.cpp"]))
        for words in (["-c", "all.cpp", "-o", "all.o", "-MMD", "-MF", "all.d", "-ffile-prefix-map=sources/=", "-I", "sources",
                       "-isystem", "headers", *COMPILE],
                      ["all.o", "-o", "solver.wasm", *LINK]):
            done = subprocess.run([*STEADY, "emcc", *words], cwd=scratch, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"emcc: {done.stderr}")
        return Path(scratch, "solver.wasm").read_bytes(), hashes(Path(scratch, "all.d").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the committed module is another")
    options = parser.parse_args()
    if shutil.which("emcc") is None:
        sys.exit("expected emcc: apt-get install --no-install-recommends emscripten")
    made, of = module()
    if not options.check:
        MODULE.write_bytes(gzip.compress(made, 9, mtime=0))
        HASHES.write_text(of)
    elif made != gzip.decompress(MODULE.read_bytes()) or of != HASHES.read_text():
        sys.exit(f"{MODULE.relative_to(ROOT)} is not what its sources give: python3 cli/live/build.py makes it anew")


if __name__ == "__main__":
    main()
