#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# test.sh BUILD_DIR [COMPONENT]: whether what BUILD_DIR installs (of COMPONENT only) serves another project.
#
# The consumer sees the installed files alone. It is built with the compiler of BUILD_DIR, and instrumented as
# the library is, since the two are linked.
set -euo pipefail

readonly build=$1 component=${2-}
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# The value of a variable in the cache of BUILD_DIR; empty if it is not there.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }

instrumentation=()
sanitizers=$(cached STICTION_SANITIZE)
[[ -z $sanitizers ]] || instrumentation+=("-fsanitize=$sanitizers")
[[ $(cached STICTION_COVERAGE) != ON ]] || instrumentation+=(--coverage)

cmake --install "$build" --prefix "$work/installed" ${component:+--component "$component"}
# Copied, so that nothing is found by way of the checkout.
cp -R -- "$here/consumer" "$work/consumer"
cmake -G Ninja -S "$work/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/installed" \
  -DCMAKE_CXX_COMPILER="$(cached CMAKE_CXX_COMPILER)" -DCMAKE_BUILD_TYPE="$(cached CMAKE_BUILD_TYPE)" \
  -DCMAKE_CXX_FLAGS="${instrumentation[*]}"
cmake --build "$work/build"
"$work/build/consumer"
