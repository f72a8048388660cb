"""Fingerprints of code: they change with what the code does, and with nothing else."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from vibroimpact_pipeline.sources import NO_DATA, Sources

SOURCES = Sources()


def test_imports_are_followed_through_the_library():
    used = SOURCES.modules_used(["vibroimpact.theory.masri_printed"])
    assert "vibroimpact.theory.masri_printed" in used
    assert "vibroimpact" in used
    assert not any(name.startswith(("vibroimpact.exact", "vibroimpact.figures")) for name in used)
    assert "vibroimpact.system.restitution" in SOURCES.modules_used(["vibroimpact.exact.engine.simulation"])


def test_what_an_editor_keeps_beside_a_file_is_no_source():
    names = [".manifold.py.swp", "manifold.py~", ".#manifold.py", "manifold.py", "style.mplstyle", "tolerances.yaml"]
    assert [name for name in names if not NO_DATA.search(name)] == ["style.mplstyle", "tolerances.yaml"]


def test_an_unknown_module_is_refused():
    with pytest.raises(ValueError, match=r"'vibroimpact\.nothing'"):
        SOURCES.modules_used(["vibroimpact.nothing"])


def test_a_touched_script_keeps_its_fingerprint_and_an_edited_one_does_not(tmp_path):
    script = tmp_path / "script.py"
    script.write_text("import vibroimpact.theory.manifold\n")
    before = SOURCES.fingerprint(script)
    os.utime(script, (0, 0))
    assert SOURCES.fingerprint(script) == before
    script.write_text("import vibroimpact.theory.manifold\nprint(1)\n")
    assert SOURCES.fingerprint(script) != before


def test_a_script_beside_the_script_counts(tmp_path):
    (tmp_path / "script.py").write_text("from helper import help_me\n")
    (tmp_path / "helper.py").write_text("help_me = 1\n")
    before = SOURCES.fingerprint(tmp_path / "script.py")
    (tmp_path / "helper.py").write_text("help_me = 2\n")
    assert SOURCES.fingerprint(tmp_path / "script.py") != before


def test_of_a_notebook_only_what_its_cells_say_counts(tmp_path):
    notebook = tmp_path / "notebook.ipynb"

    def fingerprint(source, **more):
        cell = {"cell_type": "code", "source": [source], "outputs": more.get("outputs", [])}
        notebook.write_text(json.dumps({"cells": [cell], "metadata": more}))
        return SOURCES.fingerprint(notebook)

    before = fingerprint("from vibroimpact.theory import manifold")
    assert fingerprint("from vibroimpact.theory import manifold", outputs=[{"text": "1"}]) == before
    assert fingerprint("from vibroimpact.theory import masri_printed") != before


@pytest.mark.parametrize(
    ("edited", "changes"),
    [
        ("theory/manifold.py", True),
        ("theory/__init__.py", True),
        ("exact/engine/simulation.py", False),
        ("figures/kit/vibroimpact.mplstyle", False),
    ],
)
def test_an_edited_library_module_counts_where_it_is_used(tmp_path, edited, changes):
    library = tmp_path / "vibroimpact"
    source = Path(sys.modules["vibroimpact"].__file__).parent
    subprocess.run(["cp", "-r", source, library], check=True)
    script = tmp_path / "script.py"
    script.write_text("from vibroimpact.theory.masri import lower_limit\n")

    def fingerprint():
        code = (
            f"from vibroimpact_pipeline.sources import NO_DATA, Sources; print(Sources().fingerprint({str(script)!r}))"
        )
        run = subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
        )
        return run.stdout

    before = fingerprint()
    with open(library / edited, "a") as file:
        file.write("\n# edited\n")
    assert (fingerprint() != before) is changes


def test_the_whole_engine_counts_for_compiled_code():
    script_of_engine = SOURCES.fingerprint(modules=["vibroimpact.exact.engine.simulation"])
    assert SOURCES.compiled() != script_of_engine
    assert len(SOURCES.compiled()) == 16
