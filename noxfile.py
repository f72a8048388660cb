"""Set up, build and test a clone of this checkout with each Python version and set of packages (make matrix)."""

import shutil
from pathlib import Path

import nox

ROOT = Path(__file__).parent
PYTHONS = nox.project.python_versions(nox.project.load_toml(ROOT / "pyproject.toml"))
PACKAGES = [nox.param(None, id="lock"), nox.param("lowest-direct", id="lowest"), nox.param("highest", id="newest")]
"""Sets of packages, each given by the resolution strategy of uv; None means the locked versions."""
PIN = (
    *("pip", "compile", "pyproject.toml", "--output-file", "environment.lock", "--upgrade", "--all-extras"),
    *("--generate-hashes", "--no-annotate", "--no-emit-find-links", "--no-emit-index-url", "--quiet"),
    *("--only-binary", ":all:", "--no-binary", "connection-pool"),  # pure Python, so that it needs no compiler
)
TARGETS = "set-up", "figures", "check-figures", "test-quick"

nox.options.download_python = "never"


@nox.session(python=PYTHONS)
@nox.parametrize("strategy", PACKAGES)
def matrix(session, strategy):
    """Run the make targets in TARGETS in a clone, with locked, lowest or newest packages."""
    clone = Path(session.create_tmp()) / "clone"
    shutil.rmtree(clone, ignore_errors=True)
    session.run("git", "clone", "--quiet", ROOT, clone, external=True)
    python = Path(session.bin, "python")
    with session.chdir(clone):
        if strategy:
            Path("development.lock").write_text("", encoding="utf-8")
            # Resolve as `make lock` does, but without packages that none of the targets needs.
            Path("excluded.txt").write_text("snakemake-executor-plugin-slurm\njupyterlab\n", encoding="utf-8")
            pin = *PIN, "--resolution", strategy, "--excludes", "excluded.txt", "--python", python
            session.run(ROOT / ".venv/bin/uv", *pin, external=True)
        for target in TARGETS:
            session.run("make", target, f"PYTHON={python}", env={"MAKEFLAGS": None}, external=True)
    shutil.rmtree(clone)
