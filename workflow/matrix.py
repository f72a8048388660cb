"""Set up, build and test the committed checkout on several Pythons, with locked, lowest and newest packages.

Each combination runs in a clone in .cache/matrix, so that the checkout and its .venv do not change. The clone and the
log of a failed combination are kept.
"""

import argparse
import itertools
import os
import shutil
import subprocess
import sys
import time
import tomllib
from glob import glob
from pathlib import Path

from vibroimpact_pipeline.git import GitRefused, changes, output

ROOT = Path(__file__).resolve().parents[1]
PLACE = Path(".cache/matrix")
LINES = 12
"""Number of lines shown from the end of the output of a failed step."""
PACKAGES = {"lock": None, "lowest": "lowest-direct", "newest": "highest"}
"""Resolution strategy of uv for each set of packages; None uses the locks."""
STEPS = {
    "set-up": ["make", "set-up"],
    "figures": ["make", "figures"],
    "check": ["make", "check-figures"],
    "tests": ["make", "test-quick"],
}
APART = ["snakemake-executor-plugin-slurm", "jupyterlab"]
"""Packages to exclude, as `make lock` does."""
WITHOUT_WHEEL = ["connection-pool"]
"""Pure Python packages without wheels."""


def named_pythons(root) -> list[str]:
    """Return the versions of Python in the classifiers of pyproject.toml, such as "3.11"."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    versions = (entry.removeprefix("Programming Language :: Python :: ") for entry in project["classifiers"])
    return [version for version in versions if version.startswith("3.")]


def interpreter(version: str) -> str | None:
    """Return the path of a Python version such as "3.11" from PATH or pyenv, or None if not found."""
    below = glob(f"{os.getenv('PYENV_ROOT', os.path.expanduser('~/.pyenv'))}/versions/{version}.*/bin/python3")
    for candidate in [*sorted(below), shutil.which(f"python{version}")]:
        code = "import sys, venv, ensurepip; print('%d.%d' % sys.version_info[:2])"
        if (
            candidate
            and subprocess.run([candidate, "-c", code], capture_output=True, text=True).stdout == f"{version}\n"
        ):
            return candidate
    return None


def pin(clone: Path, python: str, resolution: str, log) -> int:
    """Replace the locks of a clone by one with the lowest or newest allowed packages; return the exit status of uv.

    Only releases with a wheel for this Python are used, since other releases need a compiler.
    """
    (clone / ".cache").mkdir(exist_ok=True)
    (clone / ".cache/apart.txt").write_text("\n".join(APART), encoding="utf-8")
    command = [Path(sys.executable).with_name("uv"), "pip", "compile", "--python", python, "--resolution", resolution]
    command += ["--no-python-downloads", "--only-binary", ":all:", *(f"--no-binary={name}" for name in WITHOUT_WHEEL)]
    command += [
        "--generate-hashes",
        "--all-extras",
        "--excludes",
        ".cache/apart.txt",
        "--no-annotate",
        "--quiet",
        "--no-emit-find-links",
    ]
    command += ["--no-emit-index-url", "--cache-dir", ROOT / ".cache/uv", "--upgrade", "pyproject.toml"]
    command += ["--output-file", "environment.lock"]
    (clone / "development.lock").write_text("", encoding="utf-8")
    return subprocess.run(command, cwd=clone, stdout=log, stderr=subprocess.STDOUT).returncode


def run(version: str, python: str, packages: str) -> dict[str, str]:
    """Run all steps of one combination; return the outcome of each: its time, "failed" or "not run"."""
    clone = ROOT / PLACE / f"{version}-{packages}"
    shutil.rmtree(clone, ignore_errors=True)
    clone.parent.mkdir(parents=True, exist_ok=True)
    outcomes = dict.fromkeys(STEPS, "not run")
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", "PYTHON"))
    }
    with open(f"{clone}.log", "w", encoding="utf-8") as log:
        output("clone", "--quiet", "--template=", ROOT, clone, root=ROOT)
        for step, command in STEPS.items():
            print(f"{version}, {packages}: {step}", flush=True)
            log.write(f"\n$ {' '.join(command)}\n")
            log.flush()
            begun, status = time.monotonic(), 0
            if step == "set-up" and PACKAGES[packages]:
                status = pin(clone, python, PACKAGES[packages], log)
            status = (
                status
                or subprocess.run(
                    command, cwd=clone, env=environment | {"PYTHON": python}, stdout=log, stderr=subprocess.STDOUT
                ).returncode
            )
            outcomes[step] = "failed" if status else f"{time.monotonic() - begun:.0f} s"
            if status:
                ends = Path(log.name).read_text(encoding="utf-8").splitlines()[-LINES:]
                print(*(f"    {line}" for line in ends), f"{step} failed; full log: {log.name}", sep="\n")
            if status and step == "set-up":
                break
    if "failed" not in outcomes.values():
        shutil.rmtree(clone)
    return outcomes


def table(rows: list[dict[str, str]]) -> str:
    """Return rows with the same keys as a Markdown table."""
    lines = [list(rows[0]), ["---"] * len(rows[0]), *(list(row.values()) for row in rows)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join("| " + " | ".join(map(str.ljust, line, widths)) + " |" for line in lines)


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    known = named_pythons(ROOT)
    parser.add_argument(
        "--python",
        nargs="+",
        choices=known,
        metavar="VERSION",
        help=f"some of {', '.join(known)}; default: all that are installed",
    )
    parser.add_argument(
        "--packages", nargs="+", choices=PACKAGES, default=list(PACKAGES), help="sets of packages; default: all three"
    )
    given = parser.parse_args(arguments)
    found = {version: interpreter(version) for version in given.python or known}
    missing = [version for version, python in found.items() if python is None]
    if missing and (given.python or len(missing) == len(found)):
        parser.error(f"argument --python: {', '.join(missing)} not found on PATH or in pyenv")
    print(*(f"Python {version}: not found, skipped" for version in missing), sep="\n", end="\n" * bool(missing))
    try:
        if changes(ROOT):
            print("Uncommitted changes are not tested.")
    except GitRefused as refused:
        parser.error(str(refused))
    rows = [
        {"Python": version, "packages": packages, **run(version, found[version], packages)}
        for version, packages in itertools.product([v for v in found if found[v]], given.packages)
    ]
    print(table(rows))
    return int(any("failed" in row.values() for row in rows))


if __name__ == "__main__":
    sys.exit(main())
