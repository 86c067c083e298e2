#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build.py [OUT]: the sources of sources.txt as one WebAssembly module, compressed: reports/web/solver/solver.wasm.gz.

Needs Emscripten (Debian: apt-get install --no-install-recommends emscripten). The module is committed, so that neither
the program nor its pages need Emscripten; the same sources and packages of Debian 12 give the same module, which
tests/cli/live_test.py holds wherever Emscripten is."""

import gzip
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MODULE = ROOT / "reports/web/solver/solver.wasm.gz"
# Headers alone, and these alone: no other header of this system may come between those of Emscripten.
HEADERS = {"boost": "/usr/include/boost", "Eigen": "/usr/include/eigen3/Eigen", "nlohmann": "/usr/include/nlohmann",
           "fmt": "/usr/include/fmt"}
COMPILE = ["-std=c++20", "-O2", "-DNDEBUG", "-fno-rtti", "-fwasm-exceptions", "-DSTICTION_BOOST_RATIONALS", "-DSTICTION_PORTABLE_NUMBERS",
           "-DEIGEN_MPL2_ONLY", "-DFMT_HEADER_ONLY"]
LINK = ["-O2", "-fwasm-exceptions", "--no-entry", "-sSTANDALONE_WASM", "-sFILESYSTEM=0", "-sALLOW_MEMORY_GROWTH",
        "-sMAXIMUM_MEMORY=1GB"]
# clang 14 orders some blocks of a module by where they stand in memory: another place in every run but for this, and
# with another length of any path, which is why it sees none but those of a scratch folder, always as long.
STEADY = ["setarch", "--addr-no-randomize"]


# What the sources may include.
FOLDERS = ("answers", "certify", "cli", "corpus", "reports", "scene", "search", "solver")


def not_cpp(folder, names):
    return [name for name in names if not Path(folder, name).is_dir() and Path(name).suffix not in (".h", ".ipp", ".cpp")]


def sources():
    return [line for line in (HERE / "sources.txt").read_text().split("\n") if line and not line.startswith("#")]


def module():
    """The bytes of the module. One compilation, since most of it is reading headers."""
    with tempfile.TemporaryDirectory(dir="/tmp") as scratch:
        headers = Path(scratch, "headers")
        headers.mkdir()
        for name, folder in HEADERS.items():
            (headers / name).symlink_to(folder)
        for folder in FOLDERS:  # copied: of a link the compiler would see where it leads
            shutil.copytree(ROOT / folder, Path(scratch, "sources", folder), ignore=not_cpp)
        Path(scratch, "all.cpp").write_text("".join(f'#include "{file}"\n' for file in [*sources(), "cli/live/exports.cpp"]))
        for words in (["-c", "all.cpp", "-o", "all.o", "-ffile-prefix-map=sources/=", "-I", "sources", "-isystem", "headers",
                       *COMPILE],
                      ["all.o", "-o", "solver.wasm", *LINK]):
            done = subprocess.run([*STEADY, "emcc", *words], cwd=scratch, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"emcc: {done.stderr}")
        return Path(scratch, "solver.wasm").read_bytes()


def main():
    if shutil.which("emcc") is None:
        sys.exit("expected emcc: apt-get install --no-install-recommends emscripten")
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else MODULE
    out.write_bytes(gzip.compress(module(), 9, mtime=0))


if __name__ == "__main__":
    main()
