#!/usr/bin/env bash
# Create .venv from environment.lock unless it is up to date, and add the packages of a further lock if its name is given
# (`workflow/set_up.sh development`). Only one set-up runs at a time; an interrupted set-up starts over.
# With WHEELS=folder, all packages are installed without network from this folder, which `make wheels` fills.
set -euo pipefail
# Unset variables that would interfere: PYTHONHOME, PYTHONPATH and PYTHONUSERBASE would add modules, variables of uv would
# change the packages, and CDPATH would change the folder.
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
            # If the candidate is in a virtual environment, return its base interpreter.
            "$candidate" -c 'import sys; print(getattr(sys, "_base_executable", sys.executable))'
            return
        fi
    done
    echo "Python 3.11 or newer with the venv module is required (on Debian: apt install python3-venv)." >&2
    echo "None found among: ${PYTHON:-python3 python3.13 python3.12 python3.11 python3.14}. Select one with PYTHON=..." >&2
    return 1
}

mkdir -p .cache
exec 9>.cache/set_up.lock
taken=9 status=0
flock --nonblock --conflict-exit-code $taken 9 || status=$?
if ((status == taken)); then
    echo "Waiting for another set-up of this checkout." >&2
    flock 9
elif ((status)); then
    echo "This file system does not support locks: do not start another set-up of this checkout." >&2
fi

# done_with STEP STAMP: return 0 if the step has been finished with the same stamp.
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
        echo "WHEELS=$WHEELS: folder not found. Create it on a machine with network: make wheels WHEELS=$WHEELS" >&2
        exit 1
    fi
    source=(--no-index --find-links "$WHEELS")
fi

# install ARGUMENTS: install with uv, which is several times faster than pip; use pip with WHEELS, or if uv fails.
# Bytecode is compiled later, on import.
install() {
    set -- install --no-compile --no-deps --no-build-isolation "${source[@]}" "$@"
    if [[ -z "${WHEELS:-}" && -x .venv/bin/uv ]]; then
        ! workflow/pip.sh uv "$@" || return 0
        echo "uv failed (see above); trying pip, which is slower." >&2
    fi
    workflow/pip.sh "$@" -qq
}

check() {
    .venv/bin/uv --no-config --quiet pip check --python .venv/bin/python
}

if ! done_with complete "$complete"; then
    echo "Setting up .venv with $("$python" --version) (about a minute, once)"
    echo "1 of 3  installing $(grep -c '^[a-z].*==' environment.lock) packages of environment.lock"
    "$python" -m venv --clear .venv
    # Install the locked setuptools first, so that packages without a wheel are not built with the newest version.
    install --require-hashes --requirement <(sed -En '/^(setuptools|uv)==/,/[^\\]$/p' environment.lock)
    install --require-hashes --requirement environment.lock
    echo "2 of 3  installing this project"
    install --editable .
    # The path is relative because Python before 3.13 decodes this file in the encoding of the locale, which may lack
    # characters of the absolute path.
    echo ../../../../src >.venv/lib/python3.*/site-packages/_vibroimpact.pth
    check
    echo "3 of 3  compiling the simulation, its error estimates and other methods (half a minute)"
    .venv/bin/python workflow/scripts/compile.py
    echo "$complete" >.venv/.complete
    echo "Set-up finished in $((SECONDS / 60)) min $((SECONDS % 60)) s."
fi

if [[ -n $added ]]; then
    echo "Adding $(grep -c '^[a-z].*==' "$1.lock") packages of $1.lock to .venv (once)"
    install --force-reinstall --require-hashes --requirement "$1.lock"
    check
    echo "$added" >".venv/.$1"
fi
