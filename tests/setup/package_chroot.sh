#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Verifies a data package where there is nothing but Python: a folder with the interpreter, its standard library and
# what these are linked with becomes the root of a process without network.
#
#   tests/setup/package_chroot.sh PACKAGE        as root, or where users may make namespaces
set -eu

[ $# -eq 1 ] && [ -f "$1/verify.py" ] || { echo "usage: $0 PACKAGE (a folder that 'stiction report --package' wrote)" >&2; exit 2; }
package=$(realpath "$1")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT

python=$(python3 -c 'import os, sys; print(os.path.realpath(sys.executable))')
library=$(python3 -c 'import os; print(os.path.dirname(os.__file__))')
mkdir -p "$root/usr/bin" "$root$library" "$root/package"
cp "$python" "$root/usr/bin/python3"
cp -r "$library/." "$root$library/"
rm -rf "$root$library/dist-packages" "$root$library/site-packages" "$root$library/test"
# What the interpreter and the modules of the library are linked with.
ldd "$python" "$library"/lib-dynload/*.so 2>/dev/null | grep -o '/[^ ]*\.so[^ ]*' | grep -v ':$' | sort -u | while read -r file; do
  [ -e "$file" ] || continue
  mkdir -p "$root$(dirname "$file")"
  cp -L "$file" "$root$file"
done
cp -r "$package/." "$root/package/"

echo "in a root with $(find "$root" -path "$root/package" -prune -o -type f -print | wc -l) files beside the package, all of them Python's:"
exec_in=""
[ "$(id -u)" -eq 0 ] || exec_in="--map-root-user"
unshare $exec_in --net chroot "$root" /usr/bin/python3 -I -S /package/verify.py
