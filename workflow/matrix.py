"""Set up, build and test the committed checkout on several Pythons, with locked, lowest and newest packages.

Each combination works in a clone below .cache/matrix, so that the checkout and its .venv stay as they are. The clone of
one that failed is left to look at, beside its log.
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
"""Of the output of a step that failed, the last ones are shown."""
PACKAGES = {"lock": None, "lowest": "lowest-direct", "newest": "highest"}
"""Name of each set of packages, and what uv calls its resolution; None for the locks as they are."""
STEPS = {
    "set-up": ["make", "set-up"],
    "figures": ["make", "figures"],
    "check": ["make", "check-figures"],
    "tests": ["make", "test-quick"],
}
APART = ["snakemake-executor-plugin-slurm", "jupyterlab"]
"""Packages that `make lock` leaves out, too."""
WITHOUT_WHEEL = ["connection-pool"]
"""Packages in pure Python of which no release has a wheel."""


def named_pythons(root) -> list[str]:
    """Return the versions of Python that the classifiers of pyproject.toml name, as "3.11"."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    versions = (entry.removeprefix("Programming Language :: Python :: ") for entry in project["classifiers"])
    return [version for version in versions if version.startswith("3.")]


def interpreter(version: str) -> str | None:
    """Return the path of a Python of a version such as "3.11", on the PATH or below pyenv; None if there is none."""
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
    """Replace the locks of a clone by one of the lowest or newest allowed packages; return uv's exit status.

    Only releases with a wheel for this Python count: nobody without a compiler can install older ones.
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
    """Return the outcome of each step of one combination: its seconds, "failed" or "not run"."""
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
                print(*(f"    {line}" for line in ends), f"{step} failed; {log.name} has all", sep="\n")
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
        "--python", nargs="+", choices=known, metavar="VERSION", help=f"of {', '.join(known)}; all found"
    )
    parser.add_argument("--packages", nargs="+", choices=PACKAGES, default=list(PACKAGES), help="all three by default")
    given = parser.parse_args(arguments)
    found = {version: interpreter(version) for version in given.python or known}
    missing = [version for version, python in found.items() if python is None]
    if missing and (given.python or len(missing) == len(found)):
        parser.error(f"argument --python: {', '.join(missing)} not found, neither on the PATH nor below pyenv")
    print(*(f"Python {version}: not found, not run" for version in missing), sep="\n", end="\n" * bool(missing))
    try:
        if changes(ROOT):
            print("What is not committed takes no part.")
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
