#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# record_time.sh FILE COMPILER ARGS...: compiles, and adds the line `object,seconds` to FILE: the processor time of
# this compilation. CMake calls it for every unit; tests/setup/build_budget.py reads FILE.
file=$1
shift
object=
for ((i = 1; i < $#; ++i)); do
  [[ ${!i} != -o ]] || { ((++i)) && object=${!i}; }
done
exec 3>&1 4>&2
TIMEFORMAT='%U %S'
status=0
seconds=$({ time "$@" 1>&3 2>&4 || exit $?; } 2>&1) || status=$?
((status == 0)) && awk -v object="$object" '{ printf "%s,%.2f\n", object, $1 + $2 }' <<<"$seconds" >>"$file"
exit $status
