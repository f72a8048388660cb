#!/usr/bin/env bash
# Create .venv from environment.lock, unless it is there already. One at a time; an interrupted set-up starts over.
# With WHEELS=folder all packages come from that folder, which `make wheels` fills, and nothing from the network.
set -euo pipefail
# Another PYTHONHOME, PYTHONPATH or PYTHONUSERBASE would bring modules from elsewhere, CDPATH lead to another folder.
for name in "${!PYTHON@}" CDPATH; do
    [[ $name == PYTHON ]] || unset "$name"
done
cd -P -- "$(dirname -- "$0")/.."

usable='import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))'
version='import platform, sys; print(sys.implementation.name, *platform.python_version_tuple()[:2], platform.machine())'

find_python() {
    local candidate
    for candidate in ${PYTHON:-.venv/bin/python python3 python3.13 python3.12 python3.11 python3.14}; do
        if "$candidate" -c "$usable" 2>/dev/null; then
            # Inside an environment, the interpreter that the environment was made from.
            "$candidate" -c 'import sys; print(getattr(sys, "_base_executable", sys.executable))'
            return
        fi
    done
    echo "Set-up needs Python 3.11 or newer with its venv module (on Debian: apt install python3-venv)." >&2
    echo "None of these is one: ${PYTHON:-python3 python3.13 python3.12 python3.11 python3.14}. Name one with PYTHON=..." >&2
    return 1
}

mkdir -p .cache
exec 9>.cache/set_up.lock
taken=9 status=0
flock --nonblock --conflict-exit-code $taken 9 || status=$?
if ((status == taken)); then
    echo "Waiting for another set-up of this checkout to finish." >&2
    flock 9
elif ((status)); then
    echo "This file system has no locks: start no other set-up of this checkout meanwhile." >&2
fi

python=$(find_python)
stamp=$(cat environment.lock pyproject.toml <("$python" -c "$version") <(pwd) | sha256sum)
if [[ -f .venv/.complete && "$(cat .venv/.complete)" == "$stamp" ]]; then
    exit 0
fi

source=()
if [[ -n "${WHEELS:-}" ]]; then
    if [[ ! -d "$WHEELS" ]]; then
        echo "WHEELS=$WHEELS is no folder. Fill one where there is a network: make wheels WHEELS=$WHEELS" >&2
        exit 1
    fi
    source=(--no-index --find-links "$WHEELS")
fi

# Bytecode is made of what is imported.
install() {
    workflow/pip.sh install -qq --no-compile --no-deps --no-build-isolation "$@"
}

packages=$(grep -c '^[a-z].*==' environment.lock)
echo "Setting up .venv with $("$python" --version), once: a minute or two."
echo "1 of 3  installing $packages packages of environment.lock"
"$python" -m venv --clear .venv
# What has no wheel is built with the setuptools of the lock, not with whichever is newest on the day.
install "${source[@]}" --require-hashes --requirement <(sed -n '/^setuptools==/,/[^\\]$/p' environment.lock)
install "${source[@]}" --require-hashes --requirement environment.lock
echo "2 of 3  installing this project"
install "${source[@]}" --editable .
# A relative path: Python before 3.13 reads this file as the locale has it, which may lack letters of the path of this directory.
echo ../../../../src >.venv/lib/python3.*/site-packages/_vibroimpact.pth
conflicts=$(workflow/pip.sh check) || { echo "$conflicts" >&2; exit 1; }
echo "3 of 3  compiling the simulation engine, its certificate and other methods (half a minute)"
.venv/bin/python workflow/scripts/compile.py
echo "$stamp" >.venv/.complete
echo "Set up in $((SECONDS / 60)) min $((SECONDS % 60)) s."
