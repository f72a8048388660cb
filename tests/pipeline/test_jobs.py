"""Test `running`: a job whose code or inputs change writes no result."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from vibroimpact_pipeline import code, jobs, result_records

INPUT, OUTPUT, PAGE = Path("results/in.csv"), Path("results/out.csv"), Path("docs/page.md")
SCRIPT = Path("workflow/scripts/script.py")


@pytest.fixture
def job(tmp_path, monkeypatch):
    """Return a job with one input and one output, in a small checkout."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(code, "ROOT", tmp_path)
    monkeypatch.setattr(code, "SOURCES", tmp_path / "src")
    library = tmp_path / "src/vibroimpact"
    library.mkdir(parents=True)
    (library / "__init__.py").write_text('"""A library."""\n')
    (library / "theory.py").write_text("rho = 0.65\n")
    (library / "orbits.py").write_text("from vibroimpact.theory import rho\n")
    (library / "look.mplstyle").write_text("lines.linewidth: 1\n")
    SCRIPT.parent.mkdir(parents=True)
    SCRIPT.write_text("from vibroimpact import orbits\n")
    clear_caches()
    INPUT.parent.mkdir()
    INPUT.write_text("1")
    result_records.write_record(INPUT, {"rule": "before", "inputs": {}})
    PAGE.parent.mkdir()
    PAGE.write_text("{}")
    params = {"code": code.code_of(str(SCRIPT), str(PAGE))}
    yield SimpleNamespace(
        input=[str(INPUT), str(PAGE)], output={"csv": str(OUTPUT)}, params=params, wildcards={}, rule="rule"
    )
    clear_caches()


def clear_caches():
    code.modules.cache_clear(), code.module_files.cache_clear()


def theory():
    return code.SOURCES / "vibroimpact/theory.py"


def edit_and_restore():
    """Change a module and restore it with its old date."""
    backup = shutil.copy2(theory(), "backup.py")
    theory().write_text("rho = 0.5\n")
    os.replace(backup, theory())


def edit_a_style():
    """Data files in the folder of a module are part of the code."""
    (theory().parent / "look.mplstyle").write_text("lines.linewidth: 3\n")


def edit_a_page():
    PAGE.write_text("[]")


def edit_the_input():
    """Change the content and write a matching record, so that only the running job can detect the change."""
    INPUT.write_text("0")
    result_records.write_record(INPUT, {"rule": "before", "inputs": {}})


def test_outputs_and_records_appear_when_the_job_ends(job):
    with jobs.running(job) as out:
        Path(out.csv).write_text("2")
        assert Path(out.csv).name == OUTPUT.name
        assert not OUTPUT.exists()
    assert OUTPUT.read_text() == "2"
    record = result_records.read_record(OUTPUT)
    assert record["inputs"] == {str(INPUT): result_records.digest_of(INPUT)}
    assert (record["rule"], record["wildcards"]) == ("rule", {})
    assert not list(Path("results").glob(f"{result_records.PARTIAL}*"))


@pytest.mark.parametrize("change", [edit_and_restore, edit_a_style, edit_a_page, edit_the_input])
def test_a_job_writes_no_output_if_code_or_inputs_change_while_it_runs(job, change):
    with pytest.raises(SystemExit, match="changed while this job ran"), jobs.running(job) as out:
        (Path(out.csv).write_text("2"), change())
    assert not OUTPUT.exists()
    assert not list(Path("results").glob(f"{result_records.PARTIAL}*"))


CHANGES = [edit_a_style, edit_a_page, result_records.record_of(INPUT).unlink]
CHANGES += [lambda: theory().write_text("rho = 0.5\n"), lambda: INPUT.write_text("0")]


@pytest.mark.parametrize("change", CHANGES)
def test_a_job_does_not_start_if_code_or_inputs_have_changed(job, change):
    change()
    with pytest.raises(SystemExit, match="rerun"), jobs.running(job):
        pytest.fail("the job has started")


def test_comments_unused_modules_and_backups_of_editors_do_not_change_the_fingerprint(job):
    theory().write_text('"""Theory."""\n\n\n# of the chapter\nrho = 0.65\n')
    others = ".ipynb_checkpoints/theory-checkpoint.py", ".theory.py.swp", "__pycache__/theory.pyc", "another.py"
    for path in (theory().parent / name for name in others):
        path.parent.mkdir(exist_ok=True)
        path.write_text("rho = 0.5\n")
    clear_caches()
    assert code.code_of(str(SCRIPT), str(PAGE)) == job.params["code"]


def test_a_job_that_does_not_write_its_output_fails(job):
    with pytest.raises(FileNotFoundError), jobs.running(job):
        pass


def test_a_job_ends_with_the_process_that_started_it():
    """SIGKILL gives the parent no chance to stop the job. The job holds the output of the parent open while it runs."""
    child = "import time, types; from vibroimpact_pipeline.jobs import running\n"
    child += "job = types.SimpleNamespace(params={}, input=[], output={}, rule='any', wildcards={})\n"
    child += "with running(job): print('started', flush=True); time.sleep(600)"
    parent = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {child!r}])"
    process = subprocess.Popen([sys.executable, "-c", parent], stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"started\n"
    process.kill()
    process.communicate(timeout=60)  # returns when the last process that holds the output has ended
