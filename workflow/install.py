"""`python workflow/install.py ARGUMENTS`: like `pip install ARGUMENTS`, by uv, which is ten times as fast.

uv does not read what pip was told of where packages come from, so it is handed on. Where uv cannot, pip does it.
"""

import ast
import os
import subprocess
import sys
from itertools import chain

OPTIONS = {
    "index-url": "--default-index",
    "extra-index-url": "--index",
    "find-links": "--find-links",
    "trusted-host": "--allow-insecure-host",
}
VARIABLES = {"cert": "SSL_CERT_FILE", "proxy": "ALL_PROXY", "timeout": "UV_HTTP_TIMEOUT"}


def settings_of_pip() -> dict[str, str]:
    """Its settings by name, what ranks higher last: all commands, `pip install`, the environment."""
    listed = subprocess.run([sys.executable, "-m", "pip", "config", "list"], capture_output=True, text=True, check=True)
    pairs = [line.partition("=")[::2] for line in listed.stdout.splitlines()]
    ranked = {place: [] for place in ("global", "install", ":env:")}
    for key, value in pairs:
        place, _, name = key.partition(".")
        ranked.get(place, []).append((name, ast.literal_eval(value)))
    return {name: value for place in ranked.values() for name, value in place}


def main(arguments: list[str]) -> int:
    """The exit status of what installed, or could not."""
    settings = {} if "--no-index" in arguments else settings_of_pip()
    sources = [(option, value) for name, option in OPTIONS.items() for value in settings.get(name, "").split()]
    told = {variable: settings[name] for name, variable in VARIABLES.items() if name in settings}
    # As pip does, all places are looked at and the version decides; which file it may be, the hashes say.
    options = ["--python", sys.executable, "--index-strategy", "unsafe-best-match", *chain(*sources), *arguments]
    install = [sys.executable, "-m", "uv", "pip", "install", *options]
    status = subprocess.run(install, env=told | os.environ, check=False).returncode
    if status:
        print("uv could not install this; pip tries it now, which takes longer.", file=sys.stderr)
        status = subprocess.run([sys.executable, "-m", "pip", "install", *arguments], check=False).returncode
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
