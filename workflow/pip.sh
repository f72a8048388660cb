#!/usr/bin/env bash
# pip of .venv. Of the user's settings only those count that say where packages are and how to reach them: `user` or `target`
# would install elsewhere, `constraint` or `only-binary` refuse packages of the lock.
set -euo pipefail
unset CDPATH
cd -P -- "$(dirname -- "$0")/.."

reach='index-url|extra-index-url|no-index|find-links|trusted-host|cert|client-cert|proxy|timeout|default-timeout|retries'
reach+='|keyring-provider'
for name in "${!PIP_@}"; do
    key=${name#PIP_}
    key=${key,,}
    [[ ${key//_/-} =~ ^($reach|cache-dir|config-file)$ ]] || unset "$name"
done
# Those of configuration files, of which the section of a command goes before [global], and a variable before both. `user` has
# another meaning for this one command.
while IFS== read -r key value; do
    name=${key^^}
    name=PIP_${name//-/_}
    [[ -n ${!name:-} ]] || export "$name=$value"
done < <(PIP_USER=0 .venv/bin/python -I -m pip config list | sort --reverse |
    sed -nE "s/^(global|install)\.($reach)='(.*)'$/\2=\3/p" | sed 's/\\n/ /g')
# What pip itself needs meanwhile lies in the checkout, too.
export PIP_CONFIG_FILE=/dev/null TMPDIR="$PWD/.cache" PIP_CACHE_DIR="${PIP_CACHE_DIR:-$PWD/.cache/pip}"
exec .venv/bin/python -I -m pip --disable-pip-version-check "$@"
