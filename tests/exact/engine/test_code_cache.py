"""Compiled code on disk is reused until a source that it may depend on changes; `vibroimpact.compile` compiles all."""

import shutil

from compiled_code import LIBRARY, compiled_late
from programs import run_program

FOLDERS = """
from vibroimpact.exact.engine.compiled import PACKAGE, code_folder

print(code_folder(PACKAGE / "integrators").name, code_folder(PACKAGE / "exact/engine").name)
"""


def folders(library):
    """Return the names of the cache folders of integrators and engine in a copy of the library."""
    return run_program(FOLDERS, PYTHONPATH=str(library.parent), XDG_CACHE_HOME=str(library.parent)).stdout.split()


def test_the_cache_folder_depends_on_all_sources_that_the_code_may_depend_on(tmp_path):
    """Numba itself checks the file of a function only, not the files of the functions that it calls."""
    copy = shutil.copytree(LIBRARY, tmp_path / "vibroimpact", ignore=shutil.ignore_patterns("__pycache__"))
    before = folders(copy)
    assert folders(copy) == before
    (copy / "integrators/modal.py").open("a").write("# used by integrators only\n")
    assert [a == b for a, b in zip(folders(copy), before, strict=True)] == [False, True]
    between = folders(copy)
    (copy / "exact/engine/contact.py").open("a").write("# used by the engine and by all its callers\n")
    assert [a == b for a, b in zip(folders(copy), between, strict=True)] == [False, False]


CALLS = """run = vi.simulate(system, start, 3, sample_times=[0.5, 1.0])
rest = vi.simulate(system, run.final, 2, run.end)
_ = run.certificate, run.jacobian, run.energy.per_cycle, run.errors([1.0]), run.section(), rest.events, rest.jacobian
vi.simulate_many(system, [start, start], 2)
for one in (system, undamped(system), system.with_(sigma20_hat=1e5)):
    vi.ensemble(one, [start, start], 3, settle=1, energy=True, by_cycle=True)
    vi.ensemble(one, start, 3, tau0=run.end)
"""


def test_runs_and_ensembles_compile_nothing_after_vibroimpact_compile():
    """This includes undamped and stiff systems, which do not run in lanes."""
    assert compiled_late(CALLS) == []


UNCOMPILED = """
import vibroimpact as vi
from chapter import system_of
for run in (vi.simulate, vi.simulate_many, vi.ensemble):
    try:
        run(system_of("equal"), [0] * 8 if run is vi.simulate else [[0] * 8], 1)
    except RuntimeError as error:
        print(error)
"""


def test_runs_and_ensembles_without_compilation_are_an_error():
    message = "the simulation requires compiled code; unset NUMBA_DISABLE_JIT\n"
    assert run_program(UNCOMPILED, NUMBA_DISABLE_JIT="1").stdout == 3 * message
