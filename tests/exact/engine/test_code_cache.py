"""Compiled code on disk: used again as long as no source that may be compiled into it has changed; what is compiled
beforehand.
"""

import shutil
import subprocess
import sys

from compiled_code import LIBRARY, compiled_late
from vibroimpact.exact.engine import compiled

FUNCTION = """
from vibroimpact.exact.engine.compiled import code_folder, disk_cached
from vibroimpact.exact.engine.compiled import PACKAGE

print(code_folder(PACKAGE / "integrators").name, code_folder(PACKAGE / "exact/engine").name)
"""


def folders(library):
    """Names of the cache folders of a copy of the library: of the integrators and of the engine."""
    run = subprocess.run(
        [sys.executable, "-c", FUNCTION],
        env={"PYTHONPATH": str(library.parent), "XDG_CACHE_HOME": str(library.parent)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return run.stdout.split()


def test_code_is_kept_by_the_content_of_all_that_it_may_be_compiled_from(tmp_path):
    """Numba itself looks at the file of a function alone, not at those of the functions that it calls."""
    copy = shutil.copytree(LIBRARY, tmp_path / "vibroimpact", ignore=shutil.ignore_patterns("__pycache__"))
    before = folders(copy)
    assert folders(copy) == before
    (copy / "integrators/modal.py").open("a").write("# of the integrators alone\n")
    assert [a == b for a, b in zip(folders(copy), before, strict=True)] == [False, True]
    between = folders(copy)
    (copy / "exact/engine/contact.py").open("a").write("# of the engine, and of all that calls it\n")
    assert [a == b for a, b in zip(folders(copy), between, strict=True)] == [False, False]


def test_code_beside_a_library_that_is_read_only_is_copied_once(tmp_path, monkeypatch):
    """Numba would pass over a folder that it cannot write to, and compile everything again."""
    beside, own = tmp_path / "library", tmp_path / "own"
    monkeypatch.setattr(compiled, "LIBRARY_CACHE", beside)
    monkeypatch.setattr(compiled, "_writable", lambda: own)
    monkeypatch.setattr(compiled.config, "CACHE_DIR", "")
    own.mkdir()
    folder = compiled.code_folder.__wrapped__(LIBRARY / "exact/engine")
    assert not any(own.iterdir())  # nothing was compiled
    code = beside / folder.name / "engine_0"
    code.mkdir(parents=True)
    (code / "a.nbi").write_bytes(b"index")
    (code / "a.1.nbc").write_bytes(b"code")
    for path in (code / "a.nbi", code / "a.1.nbc", code):
        path.chmod(0o555 if path == code else 0o444)
    assert compiled.code_folder.__wrapped__(LIBRARY / "exact/engine") == folder
    copied = folder / "engine_0"
    assert {path.name: path.read_bytes() for path in copied.iterdir()} == {"a.nbi": b"index", "a.1.nbc": b"code"}
    assert all(path.stat().st_mode & 0o200 for path in (folder, copied, *copied.iterdir()))
    (copied / "b.nbi").write_bytes(b"more")
    assert compiled.code_folder.__wrapped__(LIBRARY / "exact/engine") == folder
    assert len([*copied.iterdir()]) == 3
    assert [*own.iterdir()] == [folder]
    code.chmod(0o755)


CALLS = """run = vi.simulate(system, start, 3, sample_times=[0.5, 1.0])
rest = vi.simulate(system, run.final, 2, run.end)
_ = run.certificate, run.jacobian, run.energy.per_cycle, run.errors([1.0]), run.section(), rest.events, rest.jacobian
vi.simulate_many(system, [start, start], 2)
for one in (system, undamped(system), system.with_(sigma20_hat=1e5)):
    vi.ensemble(one, [start, start], 3, settle=1, energy=True, by_cycle=True)
    vi.ensemble(one, start, 3, tau0=run.end)
"""


def test_what_runs_and_ensembles_need_is_compiled_beforehand():
    """Else the first user would wait for it. Undamped and stiff systems have no lanes of their own."""
    assert compiled_late(CALLS) == []
