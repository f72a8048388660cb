"""The installed package needs three packages only, imports no others, and works as the README states."""

import ast
import ctypes
import os
import re
import shlex
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import numpy
import pytest

import compiled_code
import vibroimpact as vi
from pipeline_trees import ROOT, copied


def test_importing_the_package_and_its_public_names_loads_neither_pandas_nor_matplotlib():
    code = (
        "import sys, vibroimpact as vi\n"
        "[getattr(vi, name) for name in vi.__all__]\n"
        "print(sorted({'pandas', 'xarray', 'matplotlib', 'snakemake', 'pydantic'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.thorough
def test_a_users_script_passes_a_strict_type_checker_and_runs(tmp_path):
    """The test includes the script of the studies if they are installed."""
    scripts = sorted((ROOT / "tests/shared").rglob("users_script*.py"))
    check = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path)]
    checked = subprocess.run([*check, *scripts], capture_output=True, text=True, cwd=tmp_path, check=False)
    assert checked.returncode == 0, checked.stdout
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import vibroimpact as vi\nvi.simulate([0.0] * 8, 20)\n", encoding="utf-8")
    assert subprocess.run([*check, wrong], capture_output=True, cwd=tmp_path, check=False).returncode == 1
    for script in scripts:
        subprocess.run([sys.executable, str(script)], capture_output=True, check=True)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    sources = copied(ROOT, folder / "sources")
    (sources / "src/vibroimpact/.ipynb_checkpoints").mkdir()
    (sources / "src/vibroimpact/.ipynb_checkpoints/copy.py").touch()
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=sources.path, check=True, capture_output=True)
    [path] = folder.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def alone(wheel, tmp_path_factory):
    """Return a function that runs Python with the wheel and the three packages that it needs, and no others."""
    site = tmp_path_factory.mktemp("site")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    packages = Path(numpy.__file__).parents[1]
    for name in ("numpy", "numpy.libs", "scipy", "scipy.libs", "numba", "llvmlite"):
        if (packages / name).exists():
            (site / name).symlink_to(packages / name)

    def run(*arguments, preexec_fn=None, **environment):
        kept = {name: value for name, value in os.environ.items() if name not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")}
        return subprocess.run(
            [sys.executable, "-S", *arguments],
            env={**kept, "PYTHONPATH": str(site), **environment},
            capture_output=True,
            text=True,
            check=True,
            preexec_fn=preexec_fn,
        )

    run.site = site
    return run


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


def test_every_module_of_the_wheel_imports_with_the_three_packages_or_names_those_it_lacks(alone):
    outcomes = dict(line.split(" ", 1) for line in alone("-c", IMPORT_ALL).stdout.splitlines())
    library = ROOT / "src/vibroimpact"
    parts = {path.stem for path in library.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert {name for name in outcomes if name.count(".") == 1} == {
        f"vibroimpact.{part}" for part in parts - {"__init__"}
    }
    errors = {name: text for name, text in outcomes.items() if text != "imports"}
    for name, text in errors.items():
        needs = re.fullmatch(r"this part of vibroimpact needs ([\w ]+): pip install '\.\[(\w+)\]'", text)
        assert needs, (name, text)
        assert set(needs[1].split(" and ")) <= EXTRAS[needs[2]], (name, text)
    science = "vibroimpact.system", "vibroimpact.theory", "vibroimpact.exact", "vibroimpact.integrators"
    assert {name for name in errors if name.startswith(science)} == {
        "vibroimpact.theory.fixed_points.table",
        "vibroimpact.exact.orbits.proof",
    }


def test_the_wheel_needs_numpy_scipy_and_numba_only(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        information, entry_points = (
            archive.read(next(name for name in names if name.endswith(end))).decode()
            for end in ("METADATA", "entry_points.txt")
        )
    assert "vibroimpact = vibroimpact.__main__:main" in entry_points
    metadata = Parser().parsestr(information)
    required = {re.split("[<>]", line)[0] for line in metadata.get_all("Requires-Dist") if "extra ==" not in line}
    assert required == {"numpy", "scipy", "numba"}
    assert metadata["License-Expression"] == "MIT"
    shipped = ("figures/plotting/vibroimpact.mplstyle", "py.typed", "__init__.pyi")
    assert {f"vibroimpact/{name}" for name in shipped} <= {*names}
    assert {re.split("[/-]", name)[0] for name in names} == {"vibroimpact"}  # the library and its metadata
    assert not [name for name in names if "__pycache__" in name or ".ipynb_checkpoints" in name]


LIBRARY_SECTION = (ROOT / "README.md").read_text(encoding="utf-8").split("## As a library")[1].split("\n## ")[0]
BLOCKS = re.findall(r"```(\w*)\n(.*?)```", LIBRARY_SECTION, re.DOTALL)


@pytest.mark.thorough
def test_python_and_commands_of_the_readme_run_with_the_three_packages(alone, tmp_path, monkeypatch):
    compiled_code.share(alone.site / "vibroimpact", tmp_path / "code")  # avoids compilation
    cache = {"NUMBA_CACHE_DIR": str(tmp_path / "code")}
    [code] = [text for language, text in BLOCKS if language == "python"]
    printed = alone("-c", code, **cache).stdout
    run = re.search(r"Run\(cycles=100, tau0=0, events=(\d+): \1 impact, 0 stick, 0 release, samples=2", printed)
    assert run, printed
    assert "Certificate(decided=True" in printed
    assert len(re.findall(r"^[\d.]+ [12] -?1 impact$", printed, re.MULTILINE)) == 5
    monkeypatch.chdir(tmp_path)
    lines = [line for language, text in BLOCKS if not language for line in text.splitlines()]
    assert {line.split()[1] for line in lines} == {"-m", "fixed-points", "orbits", "simulate"}
    for line in lines:
        program, *arguments = shlex.split(line)
        text = alone(*(arguments if program == "python" else ["-m", program, *arguments]), **cache).stdout
        text = Path("orbits.csv").read_text() if "--output" in line else text
        assert "compile" in line or len(text.splitlines()) > 3, line


def test_the_stub_contains_the_public_names_of_the_package():
    stub = ast.parse((ROOT / "src/vibroimpact/__init__.pyi").read_text(encoding="utf-8"))
    imported = {
        name.asname: node.module for node in stub.body if isinstance(node, ast.ImportFrom) for name in node.names
    }
    assert imported == vi._PUBLIC


ADVANCE = """
import vibroimpact as vi
from vibroimpact.exact.engine.flow import advance, flow_of
from vibroimpact.system.chapter import CASES, PARAMETERS

print(advance(flow_of(vi.System(**PARAMETERS, **CASES["equal"])), 0, (0.0, 0.0, 0.0, 0.0), 0.0, 1.0, 0.5))
"""


def _drop_override_of_permissions():
    """Drop CAP_DAC_OVERRIDE, so that permissions restrict root too, after the next exec."""
    ctypes.CDLL(None).prctl(24, 1, 0, 0, 0)  # PR_CAPBSET_DROP


@pytest.mark.thorough
def test_a_read_only_installation_without_a_home_works(alone, tmp_path):
    """Only a folder for temporary files is writable."""
    folders = [alone.site, *(path for path in alone.site.rglob("*") if path.is_dir() and not path.is_symlink())]
    modes = {path: path.stat().st_mode for path in folders}
    for path in folders:
        path.chmod(0o555)
    places = {"HOME": str(alone.site), "TMPDIR": str(tmp_path)}
    run = alone("-c", ADVANCE, preexec_fn=_drop_override_of_permissions, **places)
    for path, mode in modes.items():
        path.chmod(mode)
    assert "is writable, so every process compiles; set XDG_CACHE_HOME to a folder" in run.stderr
    assert "compiling" in run.stderr
    assert "python -m vibroimpact.compile" not in run.stderr
