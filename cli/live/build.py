#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build.py OUT: writes the sources of sources.txt as one WebAssembly module, compressed.

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
COMPILE = ["-std=c++20", "-O2", "-DNDEBUG", "-fno-rtti", "-fwasm-exceptions", "-DSTICTION_BOOST_RATIONALS",
           "-DEIGEN_MPL2_ONLY", "-DFMT_HEADER_ONLY"]
LINK = ["-O2", "-fwasm-exceptions", "--no-entry", "-sSTANDALONE_WASM", "-sFILESYSTEM=0", "-sALLOW_MEMORY_GROWTH",
        "-sMAXIMUM_MEMORY=1GB"]


def sources():
    return [line for line in (HERE / "sources.txt").read_text().split("\n") if line and not line.startswith("#")]


def module():
    """The bytes of the module. One compilation, since most of it is reading headers."""
    with tempfile.TemporaryDirectory() as scratch:
        headers = Path(scratch, "headers")
        headers.mkdir()
        for name, folder in HEADERS.items():
            (headers / name).symlink_to(folder)
        Path(scratch, "all.cpp").write_text("".join(f'#include "{file}"\n' for file in [*sources(), "cli/live/exports.cpp"]))
        for words in (["-c", "all.cpp", "-o", "all.o", f"-ffile-prefix-map={ROOT}/=", "-I", ROOT, "-isystem", "headers",
                       *COMPILE],
                      ["all.o", "-o", "solver.wasm", *LINK]):
            done = subprocess.run(["emcc", *words], cwd=scratch, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"emcc: {done.stderr}")
        return Path(scratch, "solver.wasm").read_bytes()


if __name__ == "__main__":
    if shutil.which("emcc") is None:
        sys.exit("expected emcc: apt-get install --no-install-recommends emscripten")
    Path(sys.argv[1]).write_bytes(gzip.compress(module(), 9, mtime=0))
