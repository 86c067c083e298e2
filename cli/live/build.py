#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build.py OUT: writes the sources of sources.txt as one WebAssembly module, compressed.
build.py --check COMPILER: only whether they compile as they must there, without GMP, by a compiler of this system.

Needs Emscripten (Debian: apt-get install --no-install-recommends emscripten). Pages hold the module of the last release,
reports/web/solver, so that neither the program nor its pages need Emscripten."""

import gzip
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# Headers alone, and these alone: no other header of this system may come between those of Emscripten.
HEADERS = {"boost": "/usr/include/boost", "Eigen": "/usr/include/eigen3/Eigen", "nlohmann": "/usr/include/nlohmann",
           "fmt": "/usr/include/fmt"}
EMBEDDED = {"solver/complete/cells.json": "kCellsJson"}  # as the build embeds them (embed in CMakeLists.txt)
# Of the module, and of a check.
OF_BOTH = ["-std=c++20", "-DNDEBUG", "-DSTICTION_BOOST_RATIONALS", "-DEIGEN_MPL2_ONLY", "-DFMT_HEADER_ONLY", "-I", ROOT, "-I", "."]
COMPILE = [*OF_BOTH, "-O2", "-fwasm-exceptions", "-isystem", "headers", f"-ffile-prefix-map={ROOT}/="]
LINK = ["-O2", "-fwasm-exceptions", "--no-entry", "-sSTANDALONE_WASM", "-sFILESYSTEM=0", "-sALLOW_MEMORY_GROWTH",
        "-sMAXIMUM_MEMORY=1GB"]


def sources():
    return [line for line in (HERE / "sources.txt").read_text().split("\n") if line and not line.startswith("#")]


def write_sources(scratch):
    """All in one file, since most of a compilation is reading headers; and what they embed."""
    for file, name in EMBEDDED.items():
        header = Path(scratch, file.replace(".", "_") + ".h")
        header.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cmake", f"-DINPUT={ROOT / file}", f"-DOUTPUT={header}", f"-DNAME={name}", "-P",
                        ROOT / "cmake/embed.cmake"], check=True)
    Path(scratch, "all.cpp").write_text("".join(f'#include "{file}"\n' for file in [*sources(), "cli/live/exports.cpp"]))


def run(scratch, *words):
    done = subprocess.run(words, cwd=scratch, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{words[0]}: {done.stderr}")


def check(compiler):
    with tempfile.TemporaryDirectory() as scratch:
        write_sources(scratch)
        run(scratch, compiler, "-fsyntax-only", *OF_BOTH, "-isystem", "/usr/include/eigen3", "all.cpp")


def module():
    """The bytes of the module."""
    with tempfile.TemporaryDirectory() as scratch:
        headers = Path(scratch, "headers")
        headers.mkdir()
        for name, folder in HEADERS.items():
            (headers / name).symlink_to(folder)
        write_sources(scratch)
        run(scratch, "emcc", "-c", "all.cpp", "-o", "all.o", *COMPILE)
        run(scratch, "emcc", "all.o", "-o", "solver.wasm", *LINK)
        return Path(scratch, "solver.wasm").read_bytes()


if __name__ == "__main__":
    if len(sys.argv) != (3 if "--check" in sys.argv else 2):
        sys.exit(__doc__)
    if sys.argv[1] == "--check":
        sys.exit(check(sys.argv[2]))
    if shutil.which("emcc") is None:
        sys.exit("expected emcc: apt-get install --no-install-recommends emscripten")
    Path(sys.argv[1]).write_bytes(gzip.compress(module(), 9, mtime=0))
