"""Commands work from any directory, and with nothing in the environment that says where the library is."""

import shutil
import subprocess
import sys

import pytest

from pipeline_trees import ROOT, Tree, run_module

FIGURE = "fig10_06"
"""Drawn from the fixed points that a job before it writes: an input in the working directory."""
VERIFY = "vibroimpact_pipeline.provenance.verify"


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory):
    """A directory with a build of the checkout's pipeline, and the build's output."""
    path = tmp_path_factory.mktemp("elsewhere")
    Tree(path).snakemake("--snakefile", str(ROOT / "Snakefile"), "--directory", str(path), FIGURE)
    return path


def test_the_record_of_a_build_elsewhere_matches(elsewhere):
    status, said = run_module(elsewhere, VERIFY, f"results/figures/{FIGURE}.png")
    assert status == 0, said
    assert "results/fixed_points/equal.csv: same" in said


def test_the_same_from_the_checkout_and_with_a_changed_input(elsewhere, tmp_path):
    moved = shutil.copytree(elsewhere, tmp_path / "moved")
    asked = "--root", str(ROOT), "--directory", str(moved), str(moved / f"results/figures/{FIGURE}.png")
    assert run_module(ROOT, VERIFY, *asked)[0] == 0
    with open(moved / "results/fixed_points/equal.csv", "a") as table:
        table.write("\n")
    status, said = run_module(ROOT, VERIFY, *asked)
    assert status == 1
    assert "results/fixed_points/equal.csv: has changed" in said


def test_a_config_of_the_directory_goes_before_that_of_the_checkout(elsewhere, tmp_path):
    moved = shutil.copytree(elsewhere, tmp_path / "moved")
    (moved / "config").mkdir()
    text = (ROOT / "config/config.yaml").read_text(encoding="utf-8")
    (moved / "config/config.yaml").write_text(text.replace("kappa: 0.65", "kappa: 0.66"), encoding="utf-8")
    status, said = run_module(moved, VERIFY, f"results/figures/{FIGURE}.png")
    assert status == 1
    assert "config/config.yaml, system.kappa: is 0.66, was 0.65" in said


@pytest.mark.parametrize(
    ("module", "page"),
    [
        ("vibroimpact_pipeline.config.readme", "config/README.md"),
    ],
)
def test_a_page_is_written_into_the_checkout_from_anywhere(tree, tmp_path, module, page):
    before = (tree / page).read_text(encoding="utf-8")
    (tree / page).unlink()
    library = f"import sys; sys.path.insert(0, {str(tree / 'src')!r}); "
    code = library + f"import runpy; runpy.run_module({module!r}, run_name='__main__')"
    (tmp_path / "anywhere").mkdir()
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path / "anywhere", check=True)
    assert (tree / page).read_text(encoding="utf-8") == before
    assert list((tmp_path / "anywhere").iterdir()) == []


@pytest.mark.parametrize("script", ["benchmark", "compile"])
def test_a_command_that_compiles_does_so_for_the_checkout(tmp_path, script):
    """Without its work, which takes a minute: what it would do is asked for by name."""
    code = (
        "import runpy, sys\n"
        "import concurrent.futures, vibroimpact_pipeline.environment as environment\n"
        "def prepare(root, sources):\n"
        "    print(root)\n"
        "    sys.exit()\n"
        "environment.prepare = prepare\n"
        f"sys.argv = ['{script}']\n"
        f"runpy.run_path({str(ROOT / 'workflow/scripts' / script)!r} + '.py', run_name='__main__')"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert run.stdout == f"{ROOT}\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("others", [None, "/nowhere"], ids=["nothing", "a path of others"])
def test_jobs_use_the_library_beside_the_rules(tree, others):
    """Not the one that is installed, which is that of this checkout."""
    tree.edit("workflow/scripts/figure.py", "from importlib import import_module\n", PRINTED)
    tree.snakemake("companion_10_04", PYTHONPATH=others)
    log = (tree / "results/logs/companions/companion_10_04.log").read_text()
    assert f"library: {tree / 'src/vibroimpact/__init__.py'}\n" in log


PRINTED = """from importlib import import_module
import atexit, vibroimpact
atexit.register(lambda: print("library:", vibroimpact.__file__, flush=True))
"""
