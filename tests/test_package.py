"""What the installed package promises: light, and in need of three packages only."""

import os
import re
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import numpy
import pytest

from pipeline_trees import ROOT


def test_importing_the_package_and_its_public_names_loads_neither_pandas_nor_matplotlib():
    code = (
        "import sys, vibroimpact as vi\n"
        "[getattr(vi, name) for name in vi.__all__]\n"
        "print(sorted({'pandas', 'matplotlib', 'snakemake', 'pydantic'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    [path] = folder.glob("*.whl")
    return path


EXTRAS = {"figures": {"matplotlib", "pandas"}, "reference": {"flint", "mpmath"}}
IMPORT_ALL = """
import importlib, pkgutil, vibroimpact

for module in pkgutil.walk_packages(vibroimpact.__path__, "vibroimpact.", onerror=lambda name: None):
    try:
        importlib.import_module(module.name)
        print(module.name, "imports")
    except ModuleNotFoundError as error:
        print(module.name, error)
"""


def test_every_module_of_the_wheel_imports_with_the_three_or_says_what_it_lacks(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    site = Path(numpy.__file__).parents[1]
    for name in ("numpy", "numpy.libs", "scipy", "scipy.libs", "numba", "llvmlite"):
        if (site / name).exists():
            (tmp_path / name).symlink_to(site / name)
    alone = [sys.executable, "-S", "-c", IMPORT_ALL]  # without the packages of the environment
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    run = subprocess.run(alone, env=environment, capture_output=True, text=True, check=True)
    said = dict(line.split(" ", 1) for line in run.stdout.splitlines())
    assert {name for name in said if name.count(".") == 1} == {
        f"vibroimpact.{room}"
        for room in ("accuracy", "claims", "exact", "figures", "regimes", "rivals", "system", "theory")
    }
    lacking = {name: words for name, words in said.items() if words != "imports"}
    for name, words in lacking.items():
        needs = re.fullmatch(r"this part of vibroimpact needs ([\w ]+): pip install 'vibroimpact\[(\w+)\]'", words)
        assert needs, (name, words)
        assert set(needs[1].split(" and ")) <= EXTRAS[needs[2]], (name, words)
    science = (
        "vibroimpact.system",
        "vibroimpact.theory",
        "vibroimpact.exact",
        "vibroimpact.regimes",
        "vibroimpact.rivals",
    )
    assert {name for name in lacking if name.startswith(science)} == {
        "vibroimpact.theory.fixed_points.certify",
        "vibroimpact.exact.orbits.certify",
    }


def test_the_wheel_needs_numpy_scipy_and_numba_only(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = Parser().parsestr(archive.read(next(n for n in names if n.endswith("METADATA"))).decode())
    required = {line.split(">")[0] for line in metadata.get_all("Requires-Dist") if "extra ==" not in line}
    assert required == {"numpy", "scipy", "numba"}
    assert metadata["License-Expression"] == "MIT"
    assert "vibroimpact/figures/kit/vibroimpact.mplstyle" in names
    assert not [name for name in names if name.startswith("vibroimpact_pipeline")]
    assert not [name for name in names if "__pycache__" in name]
