#!/usr/bin/env bash
# Run pip of .venv, or uv if the first argument is `uv`. Only user settings for the network and the sources of packages
# apply: `user` or `target` would install elsewhere, and `constraint` or `only-binary` would reject locked packages.
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
# Read the settings from configuration files. The section [install] overrides [global], and variables override both.
# PIP_USER=0 is set because `pip config` would take `user` as its option --user and list the user's file only.
while IFS== read -r key value; do
    name=${key^^}
    name=PIP_${name//-/_}
    [[ -n ${!name:-} ]] || export "$name=$value"
done < <(PIP_USER=0 .venv/bin/python -I -m pip config list | sort --reverse |
    sed -nE "s/^(global|install)\.($reach)='(.*)'$/\2=\3/p" | sed 's/\\n/ /g')
# Store temporary files and the cache in the checkout.
export PIP_CONFIG_FILE=/dev/null TMPDIR="$PWD/.cache" PIP_CACHE_DIR="${PIP_CACHE_DIR:-$PWD/.cache/pip}"
if [[ ${1:-} != uv ]]; then
    exec .venv/bin/python -I -m pip --disable-pip-version-check "$@"
fi
# Translate the settings into options of uv.
set -f
options=()
for pair in default-index:INDEX_URL index:EXTRA_INDEX_URL find-links:FIND_LINKS; do
    name=PIP_${pair#*:}
    for word in ${!name:-}; do
        options+=("--${pair%:*}" "$word")
    done
done
if [[ ${PIP_NO_INDEX:-} =~ ^([1yYtT]|[oO][nN]) ]]; then
    options+=(--no-index)
fi
if [[ -n ${PIP_CERT:-} ]]; then
    export SSL_CERT_FILE=$PIP_CERT
fi
if [[ -n ${PIP_PROXY:-} ]]; then
    export HTTP_PROXY=$PIP_PROXY HTTPS_PROXY=$PIP_PROXY http_proxy=$PIP_PROXY https_proxy=$PIP_PROXY
fi
# Accept a file from any index, as pip does, because hashes are checked.
exec .venv/bin/uv --quiet --no-config pip "${@:2}" --python .venv/bin/python --cache-dir .cache/uv \
    --index-strategy unsafe-best-match "${options[@]}"
