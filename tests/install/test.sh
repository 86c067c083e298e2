#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# test.sh BUILD_DIR [COMPONENT [examples]]: whether what BUILD_DIR installs (of COMPONENT only) serves another project:
# the consumer of this folder, or the engines of solver/c/examples, those of them that are installed.
#
# The consumer sees the installed files alone. It is built with the compilers of BUILD_DIR, and instrumented as
# the library is, since the two are linked. C finds the library by CMake and by pkg-config; with the latter the
# program of solver/c/velocity_step.md is built. The examples that solve.h and stiction.h open with print what stands there.
set -euo pipefail

readonly build=$1 component=${2-} project=${3-consumer}
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
readonly interface=$here/../../solver/c
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# The value of a variable in the cache of BUILD_DIR; empty if it is not there.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }

instrumentation=()
sanitizers=$(cached STICTION_SANITIZE)
[[ -z $sanitizers ]] || instrumentation+=("-fsanitize=$sanitizers")
[[ $(cached STICTION_COVERAGE) != ON ]] || instrumentation+=(--coverage)

cxx=$(cached CMAKE_CXX_COMPILER)
cc=${cxx/clang++/clang}
cc=${cc/g++/gcc}

cmake --install "$build" --prefix "$work/installed" ${component:+--component "$component"}
# The program in a header's opening comment, and what the header says that it prints.
example_of() { sed -n '/^\/\/   #include/,/^\/\/   }$/s/^\/\/ \{0,3\}//p' "$1"; }
prints_of() { sed -n 's/^\/\/ prints: //p' "$1"; }
header=$(find "$work/installed" -path '*/solver/solve.h') header_of_c=$(find "$work/installed" -name stiction.h)
example_of "$header" >"$work/example.cpp"
example_of "$header_of_c" >"$work/example.c"

# Copied, so that nothing is found by way of the checkout.
cp -R -- "$here/consumer" "$interface/examples" "$work"
cmake -G Ninja -S "$work/$project" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/installed" \
  -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE="$(cached CMAKE_BUILD_TYPE)" \
  -DCMAKE_CXX_FLAGS="${instrumentation[*]}" -DCMAKE_C_FLAGS="${instrumentation[*]}" -DEXAMPLE="$work/example.cpp"
cmake --build "$work/build"
if [[ $project == examples ]]; then
  ctest --test-dir "$work/build" --output-on-failure --no-tests=ignore
  exit
fi
"$work/build/consumer"
"$work/build/from_c"

sed -n '/^```c$/,/^```$/{/^```/!p}' "$interface/velocity_step.md" >"$work/velocity_step.c"
PKG_CONFIG_PATH=$(dirname -- "$(find "$work/installed" -name stiction.pc)")
export PKG_CONFIG_PATH
read -ra cflags <<<"$(pkg-config --cflags stiction)"
read -ra libs <<<"$(pkg-config --libs stiction)"
linker=$cc
[[ -z $sanitizers ]] || linker=$cxx # sanitizers of C++ ask for it
for name in velocity_step example; do
  "$cc" -std=c11 -Wall -Wextra -pedantic -Werror "${instrumentation[@]}" "${cflags[@]}" -c "$work/$name.c" -o "$work/$name.o"
  "$linker" "${instrumentation[@]}" "$work/$name.o" "${libs[@]}" -o "$work/$name"
done
"$work/velocity_step"
diff <(prints_of "$header_of_c") <("$work/example")
diff <(prints_of "$header") <("$work/build/example")
