#!/usr/bin/env bash
# Create .venv from environment.lock, unless it is there already, and add the packages of another lock, if one is named
# (`workflow/set_up.sh development`), once. One at a time; an interrupted set-up starts over.
# With WHEELS=folder all packages come from that folder, which `make wheels` fills, and nothing from the network.
set -euo pipefail
# Another PYTHONHOME, PYTHONPATH or PYTHONUSERBASE would bring modules from elsewhere, a variable of uv packages, CDPATH lead to
# another folder.
for name in "${!PYTHON@}" "${!UV_@}" CDPATH; do
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

# done_with STAMP: a step is finished, and with the same things as now.
done_with() {
    [[ -f .venv/.$1 && "$(cat ".venv/.$1")" == "$2" ]]
}

python=$(find_python)
complete=$(cat environment.lock pyproject.toml <("$python" -c "$version") <(pwd) | sha256sum)
added=$([[ -z ${1:-} ]] || sha256sum "$1.lock")
if done_with complete "$complete" && { [[ -z $added ]] || done_with "$1" "$added"; }; then
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

# install ARGUMENTS: by uv, which is several times as fast; by pip from a folder, or where uv cannot reach the packages.
# Bytecode is made of what is imported.
install() {
    set -- install --no-compile --no-deps --no-build-isolation "${source[@]}" "$@"
    if [[ -z "${WHEELS:-}" && -x .venv/bin/uv ]]; then
        ! workflow/pip.sh uv "$@" || return 0
        echo "uv failed, see above. Trying pip, which is slower." >&2
    fi
    workflow/pip.sh "$@" -qq
}

check() {
    .venv/bin/uv --no-config --quiet pip check --python .venv/bin/python
}

if ! done_with complete "$complete"; then
    echo "Setting up .venv with $("$python" --version), once: about a minute."
    echo "1 of 3  installing $(grep -c '^[a-z].*==' environment.lock) packages of environment.lock"
    "$python" -m venv --clear .venv
    # What has no wheel is built with the setuptools of the lock, not with whichever is newest on the day.
    install --require-hashes --requirement <(sed -En '/^(setuptools|uv)==/,/[^\\]$/p' environment.lock)
    install --require-hashes --requirement environment.lock
    echo "2 of 3  installing this project"
    install --editable .
    # A relative path: Python before 3.13 reads this file as the locale has it, which may lack letters of the path of this directory.
    echo ../../../../src >.venv/lib/python3.*/site-packages/_vibroimpact.pth
    check
    echo "3 of 3  compiling the simulation, its certificate and other methods (half a minute)"
    .venv/bin/python workflow/scripts/compile.py
    echo "$complete" >.venv/.complete
    echo "Set up in $((SECONDS / 60)) min $((SECONDS % 60)) s."
fi

if [[ -n $added ]]; then
    echo "Adding $(grep -c '^[a-z].*==' "$1.lock") packages of $1.lock to .venv, once."
    install --force-reinstall --require-hashes --requirement "$1.lock"
    check
    echo "$added" >".venv/.$1"
fi
