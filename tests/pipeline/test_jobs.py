"""The frame of a job: nothing is replaced by a job whose code, inputs or build are not what they were."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from vibroimpact_pipeline import code, jobs, results

INPUT, OUTPUT = Path("results/in.csv"), Path("results/out.csv")


@pytest.fixture
def job(tmp_path, monkeypatch):
    """A job of a small checkout, with one input and one output."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(code, "ROOT", tmp_path)
    library = tmp_path / code.PARTS["library"]
    library.mkdir(parents=True)
    (library / "theory.py").write_text("rho = 0.65\n")
    INPUT.parent.mkdir()
    INPUT.write_text("1")
    results.write_record(INPUT, {"rule": "before", "params": "", "inputs": {}})
    params = {"code": {"library": code.fingerprint_now("library")}}
    return SimpleNamespace(
        log=[], input=[str(INPUT)], output={"csv": str(OUTPUT)}, params=params, wildcards={}, rule="rule"
    )


def theory():
    return code.ROOT / code.PARTS["library"] / "theory.py"


def edit():
    theory().write_text("rho = 0.5\n")


def edit_and_put_back():
    aside = shutil.copy2(theory(), "aside.py")
    edit()
    os.replace(aside, theory())


def add_a_module():
    (theory().parent / "another.py").write_text("")


def another_build():
    jobs.TOKEN.parent.mkdir(exist_ok=True)
    jobs.TOKEN.write_text("another")


def test_outputs_and_their_records_are_put_in_place_together(job):
    with jobs.running(job) as out:
        Path(out.csv).write_text("2")
        assert Path(out.csv).name == OUTPUT.name
        assert not OUTPUT.exists()
    assert OUTPUT.read_text() == "2"
    assert results.read_record(OUTPUT)["inputs"] == {str(INPUT): results.digest_of(INPUT)}
    assert not list(Path("results").glob(f"{results.PARTIAL}*"))


@pytest.mark.parametrize("change", [edit, edit_and_put_back, add_a_module, another_build])
def test_what_changes_while_a_job_runs_keeps_its_outputs_out(job, change):
    with pytest.raises(SystemExit, match=r"changed|another build"), jobs.running(job) as out:
        (Path(out.csv).write_text("2"), change())
    assert not OUTPUT.exists()
    assert not list(Path("results").glob(f"{results.PARTIAL}*"))


@pytest.mark.parametrize("change", [edit, add_a_module, lambda: INPUT.write_text("0"), results.record_of(INPUT).unlink])
def test_a_job_does_not_start_with_other_code_or_inputs(job, change):
    change()
    with pytest.raises(SystemExit, match="Build again"), jobs.running(job):
        pytest.fail("the job has started")


def test_a_job_that_waited_in_a_queue_until_the_next_build_does_not_start(job, monkeypatch):
    monkeypatch.setenv(jobs.BUILD, "the build before")
    another_build()
    with pytest.raises(SystemExit, match="another build has begun"), jobs.running(job):
        pytest.fail("the job has started")
    monkeypatch.setenv(jobs.BUILD, "another")
    with jobs.running(job) as out:
        Path(out.csv).write_text("2")
    assert OUTPUT.exists()


def test_an_output_that_was_not_written_fails_the_job(job):
    with pytest.raises(FileNotFoundError), jobs.running(job):
        pass


def test_a_job_ends_with_the_process_that_started_it(tmp_path):
    """Killed outright, the parent tells nobody."""
    child = "import time; from vibroimpact_pipeline.jobs import end_with_parent; end_with_parent();"
    child += "open('child', 'w').write(str(__import__('os').getpid())); time.sleep(600)"
    parent = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {child!r}])"
    process = subprocess.Popen([sys.executable, "-c", parent], cwd=tmp_path)
    written = tmp_path / "child"
    while not (written.exists() and written.read_text()):
        time.sleep(0.02)
        assert process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.wait()
    number = int(written.read_text())
    while _lives(number):
        time.sleep(0.02)


def _lives(number):
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
