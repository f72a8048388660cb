#!/usr/bin/env bash
# Build the committed state twice from nothing and compare every file that contains no timing, byte for byte.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
commit=$(git rev-parse HEAD)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for build in first second; do
    mkdir "$work/$build"
    git archive "$commit" | tar -x -C "$work/$build"
    echo "The $build build ..."
    (cd "$work/$build" && PYTHONPATH=$PWD/src "$root/.venv/bin/snakemake" --cores "${CORES:-2}" --quiet all -- figures)
    (cd "$work/$build" && find results -name '*.csv' -o -name '*.png' -o -name '*.svg' -o -name '*.pdf' |
        sort | xargs sha256sum) >"$work/$build.sums"
done
diff "$work/first.sums" "$work/second.sums"
echo "$(wc -l <"$work/first.sums") files, the same bytes in both builds."
