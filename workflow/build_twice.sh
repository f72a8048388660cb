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
    (cd "$work/$build" && PYTHONPATH=$PWD/src "$root/.venv/bin/snakemake" --cores "${CORES:-2}")
done
PYTHONPATH=$work/first/src "$root/.venv/bin/python" -m vibroimpact_pipeline.same_bytes "$work/first/results" "$work/second/results"
