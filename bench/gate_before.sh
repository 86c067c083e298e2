#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench --suite gate of cceb0e3, the last commit before there was one gate: its methods, judged as today's are.
#
#   bench/gate_before.sh FOLDER [OPTIONS OF bench]     writes nothing but the folder; prints what the suite prints
set -euo pipefail

[[ $# -ge 1 ]] || { echo "usage: bench/gate_before.sh FOLDER [--problems N] [--seed N] [--json]" >&2; exit 2; }
readonly folder=$1
shift
root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
readonly root

if [[ ! -e $folder ]]; then
  git -C "$root" worktree add --detach "$folder" cceb0e3 >&2
  # The suite and its judge, and what they are built of.
  for file in bench/{CMakeLists.txt,gate.cpp,gate_dials.cpp,gate_dials.h,structure.cpp,structure.h,suite.h} \
    certify/judge.{cpp,h} cli/stiction_bench.cpp corpus/rational.{cpp,h} solver/problem/{law,scalar,units}.h; do
    cp "$root/$file" "$folder/$file"
  done
  sed -i 's/ipopt_process.cpp lemke_space.cpp/ipopt_process.cpp judge.cpp lemke_space.cpp/' "$folder/certify/CMakeLists.txt"
  sed -i -e '/^enum class FrictionLaw/,/^}/d' -e '0,/^#include "solver/s//#include "solver\/problem\/law.h"\n&/' \
    "$folder/solver/problem/answer.h"
fi
cmake -G Ninja -DCMAKE_BUILD_TYPE=Release -S "$folder" -B "$folder/build" >&2
ninja -C "$folder/build" stiction-bench >&2
exec "$folder/build/stiction-bench" --suite gate "$@"
