"""What the installed package promises: light, and in need of three packages only."""

import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_importing_the_package_and_its_public_names_loads_neither_pandas_nor_matplotlib():
    code = (
        "import sys, vibroimpact as vi\n"
        "[getattr(vi, name) for name in vi.__all__]\n"
        "print(sorted({'pandas', 'matplotlib', 'snakemake', 'jsonschema'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_the_wheel_needs_numpy_scipy_and_numba_only(tmp_path):
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    [wheel] = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = Parser().parsestr(archive.read(next(n for n in names if n.endswith("METADATA"))).decode())
    required = {line.split(">")[0] for line in metadata.get_all("Requires-Dist") if "extra ==" not in line}
    assert required == {"numpy", "scipy", "numba"}
    assert metadata["License-Expression"] == "MIT"
    assert "vibroimpact/figures/kit/vibroimpact.mplstyle" in names
    assert not [name for name in names if "__pycache__" in name]
