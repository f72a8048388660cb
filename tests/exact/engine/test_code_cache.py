"""Compiled code on disk: used again as long as no source that may be compiled into it has changed; what is compiled
beforehand.
"""

import shutil
import subprocess
import sys

from compiled_code import LIBRARY, compiled_late

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
