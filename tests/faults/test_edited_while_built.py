"""Code that is changed while a build goes on, and put back before it ends: nothing made of it is called right."""

import fcntl
import os
import shutil
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from job import running
from pipeline_trees import run_module
from vibroimpact_pipeline.integrity import code, compiled
from vibroimpact_pipeline.integrity.stamps import stamps
from vibroimpact_pipeline.sources import Sources

EDITED = "src/vibroimpact/theory/manifold.py"
FIGURE = "companion_10_04"
OF_THE_TREE = {"PYTHONPATH": None, "NUMBA_CACHE_DIR": None}
"""The library and the compiled code of the tree, not those of the tests."""


def wait_for(path, build):
    """Until a build has written a file, however long that takes it."""
    while not path.exists():
        assert build.poll() is None, f"{path} did not appear: {build.communicate()[0]}"
        time.sleep(0.02)


def held(name, mark, go):
    """A line that writes a mark, and goes on as soon as there is the file `go`."""
    wait = f"[__import__('time').sleep(0.02) for _ in iter(lambda: __import__('os').path.exists({str(go)!r}), True)]"
    return f"open({str(mark)!r}, 'w').close(); {wait}\n{name}"


@pytest.fixture
def slow(tree, tmp_path):
    """The project; a companion figure waits before it loads the module that draws it, and after it has drawn."""
    load, last = (
        "    figure = import_module(module)\n",
        "    write_and_draw(figure, figure.compute(**given), outputs, provenance)\n",
    )
    script = (tree / "workflow/scripts/figure.py").read_text()
    assert load in script
    assert last in script
    before, after = ("    " + held("", tmp_path / name, tmp_path / f"go {name}") for name in ("before", "after"))
    (tree / "workflow/scripts/figure.py").write_text(script.replace(load, before + load).replace(last, last + after))
    return tree


def test_code_that_was_changed_and_put_back_while_a_figure_was_made(slow, tmp_path):
    folder = slow / f".cache/numba/{Sources().compiled()}"
    folder.mkdir(parents=True)
    right = shutil.copy2(slow / EDITED, tmp_path / "right.py")
    build = slow.start(FIGURE, **OF_THE_TREE)
    wait_for(tmp_path / "before", build)
    slow.edit(EDITED, "def rho(", "def rho(kappa):\n    return 0.5\n\n\ndef another_rho(")
    (tmp_path / "go before").touch()
    wait_for(tmp_path / "after", build)
    shutil.copy2(right, slow / EDITED)  # with its old time
    (tmp_path / "go after").touch()
    said = build.communicate()[0]
    assert build.returncode != 0, said
    assert f"{EDITED}: changed while this was built. Build again." in said
    assert not list((slow / "results").rglob(f"{FIGURE}.p*"))
    assert not folder.exists()


def test_an_edit_while_a_build_waits_for_another_counts(tree):
    """What a build takes its fingerprints and the folder of compiled code from is read when it is its turn."""
    (tree / ".cache").mkdir()
    with open(tree / ".cache/build.lock", "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        build = tree.start(FIGURE, **OF_THE_TREE)
        assert any("Waiting for another build" in line for line in build.stdout)
        tree.edit(EDITED, "def rho(", "# edited\ndef rho(")
    said = build.communicate()[0]
    assert build.returncode == 0, said
    status, said = run_module(tree.path, "vibroimpact_pipeline.provenance.verify", f"results/figures/{FIGURE}.png")
    assert status == 0, said


@pytest.fixture
def job(tmp_path, monkeypatch):
    """A job of a build that knows its code: one file."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "elsewhere"))
    Path("theory.py").write_text("rho = 0.65\n")
    code.write_down({"print": ["theory.py"]}, stamps(["theory.py"]))
    about = {"log": [], "input": [], "output": [], "wildcards": {}, "scriptdir": "workflow/scripts"}
    return SimpleNamespace(params={"code": "print"}, **about)


def same_text(path):
    path.write_text(path.read_text())


def older_version(path):
    """As a file that was put aside comes back."""
    aside = shutil.copy2(path, "aside.py")
    os.replace(aside, path)


CHANGES = [same_text, older_version, Path.unlink]


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_before_the_job_starts(job, change):
    change(Path("theory.py"))
    with pytest.raises(SystemExit, match=r"theory\.py: changed while this was built"), running(job):
        pytest.fail("the job has started")


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_while_the_job_runs(job, change):
    with pytest.raises(SystemExit, match=r"theory\.py: changed while this was built"), running(job):
        change(Path("theory.py"))


def test_a_change_is_told_even_if_the_job_fails_of_it(job):
    def import_half_written():
        Path("theory.py").write_text("rho =")
        compile(Path("theory.py").read_text(), "theory.py", "exec")

    with pytest.raises(SystemExit, match=r"theory\.py: changed while this was built"), running(job):
        import_half_written()


def test_code_that_the_build_did_not_begin_with(job):
    """A job of a cluster reads the rules anew, and so finds a new fingerprint."""
    job.params["code"] = "another print"
    with pytest.raises(SystemExit, match="does not list the code of this job"), running(job):
        pytest.fail("the job has started")


def test_a_figure_is_made_by_the_last_step_of_its_record(job):
    job.params = {"provenance": {"steps": [{"fingerprint": "of an input"}, {"fingerprint": "print"}]}}
    with running(job):
        pass


def test_compiled_code_of_others_is_left(job):
    Path("elsewhere").mkdir()
    with pytest.raises(SystemExit), running(job):
        same_text(Path("theory.py"))
    assert Path("elsewhere").exists()


@pytest.fixture
def own_folder(job, monkeypatch):
    """Where this job keeps compiled code, in the working directory."""
    folder = Path.cwd() / ".cache/numba/print"
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder))
    return folder


def killed(job):
    """What a job leaves behind that compiles something and is killed."""
    process = os.fork()
    if not process:
        with running(job):
            Path(os.environ["NUMBA_CACHE_DIR"], "one.nbi").write_text("compiled")
            os._exit(9)
    assert os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 9


@pytest.mark.parametrize("change", [same_text, older_version])
def test_code_compiled_by_a_job_that_was_killed_is_dropped_if_its_sources_have_been_changed(job, own_folder, change):
    killed(job)
    compiled.drop_untrusted(Path.cwd())
    assert (own_folder / "one.nbi").exists()
    change(Path("theory.py"))
    compiled.drop_untrusted(Path.cwd())
    assert not own_folder.exists()


def test_a_job_that_ends_leaves_its_compiled_code_alone(job, own_folder):
    with running(job):
        (own_folder / "one.nbi").write_text("compiled")
    assert [path.name for path in own_folder.iterdir()] == ["one.nbi"]
