#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# npm ci && ./vendor.sh: vendor/plot.js, what the pages use of Observable Plot with what that needs, as one module; beside
# it the licences of all packages of which it has a part.
set -euo pipefail
cd -- "$(dirname -- "$0")"

plot() {
  echo 'export {axisX, axisY, barX, dot, gridX, gridY, plot, ruleX, ruleY} from "@observablehq/plot";' |
    node_modules/.bin/esbuild --bundle --charset=utf8 --format=esm --target=es2022 --legal-comments=none "$@"
}

# Its exports have a line of their own, as join.py wants it.
plot --minify | sed 's/export{\([^}]*\)};$/\nexport {\1};/' >vendor/plot.js

# What is not minified names its files.
plot | sed -n 's#^// \(node_modules/\(@[^/]*/\)\?[^/]*\)/.*#\1#p' | LC_ALL=C sort -u | while read -r folder; do
  node -p '((p) => `${p.name} ${p.version}\n`)(require(process.argv[1]))' "./$folder/package.json"
  cat "$folder"/LICENSE*
  echo
done >vendor/plot.LICENSES.txt
