"""Where a figure comes from: borne by its files, read back without loss, compared with the tree."""

import hashlib
import json
import os
import shutil
import subprocess
import sys

import pytest

from pipeline_trees import ROOT, run_module
from vibroimpact.figures.kit import style, tables
from vibroimpact_pipeline.provenance import verify as provenance
from vibroimpact_pipeline.sources import Sources

FIG10_05 = {"notebook": "closed_form", "model": "closed_form", "C_range": [0.5, 1.1]}
AWKWARD = {"method": r"all zeros of (10.24) \ by 'Newton' & \"more\" <κ> )", "digits": 15}


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def save(figures, folder, record, kinds=("png", "pdf", "svg"), name="fig10_04"):
    table = figures[name].compute and figures[name].compute()
    outputs = {kind: folder / f"{name}.{kind}" for kind in kinds}
    style.save(figures[name].draw(table), outputs, record)
    return outputs


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
def test_every_file_bears_its_record(figures, tmp_path, kind):
    path = save(figures, tmp_path, AWKWARD, [kind])[kind]
    assert provenance.embedded(path) == AWKWARD


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
def test_a_file_without_a_record_is_refused(figures, tmp_path, kind):
    path = save(figures, tmp_path, None, [kind])[kind]
    with pytest.raises(ValueError, match="bears no record"):
        provenance.embedded(path)


def test_same_figure_and_record_same_bytes(figures, tmp_path):
    """In processes that order sets of texts differently."""
    figure_tables = {"fig10_08": "fig10_08", "fig10_09": "fig10_06"}
    for name, like in figure_tables.items():
        tables.write(figures[like].compute(), tmp_path / f"{name}.csv")
    code = (
        "import json, sys\nfrom pathlib import Path\n"
        "from vibroimpact.figures import fig10_06\n"
        "from vibroimpact.figures import fig10_08\n"
        "from vibroimpact.figures.kit import style\n"
        "from vibroimpact.figures.kit import tables\n"
        "source, target, record = Path(sys.argv[1]), sys.argv[2], json.loads(sys.argv[3])\n"
        "kinds = ['pdf', 'svg']\n"
        "for name, module, kinds in (('fig10_08', fig10_08, ['png', *kinds]), ('fig10_09', fig10_06, kinds)):\n"
        "    outputs = {kind: f'{target}/{name}.{kind}' for kind in kinds}\n"
        "    style.save(module.draw(tables.read(source / f'{name}.csv')), outputs, record)"
    )
    made = []
    for seed in ("0", "1"):
        (tmp_path / seed).mkdir()
        arguments = [sys.executable, "-c", code, str(tmp_path), str(tmp_path / seed), json.dumps(AWKWARD)]
        subprocess.run(arguments, env={**os.environ, "PYTHONHASHSEED": seed}, check=True)
        made.append({path.name: digest(path) for path in (tmp_path / seed).iterdir()})
    assert made[0] == made[1]
    assert len(made[0]) == 7


@pytest.fixture
def tree(figures, tmp_path):
    """A checkout in small, with figure 10.4 and its sidecar as the pipeline leaves them."""
    root = tmp_path / "tree"
    for name in ("config/config.yaml", "environment.lock", "notebooks/closed_form.ipynb"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, root / name)
    shutil.copytree(ROOT / "src", root / "src")
    (root / "results/figures").mkdir(parents=True)
    (root / "results/input.csv").write_text("x\n1\n")
    step = {"files": ["notebooks/closed_form.ipynb"], "modules": ["vibroimpact.figures.fig10_04"]}
    fingerprint = Sources().fingerprint(root / step["files"][0], modules=step["modules"])
    record = {
        "figure": "fig10_04",
        "config": {"system.kappa": 0.65, "figures.fig10_05": FIG10_05},
        "steps": [{"method": "closed form", "digits": 15, **step, "fingerprint": fingerprint}],
        "lock": digest(root / "environment.lock"),
        "inputs": {"results/input.csv": digest(root / "results/input.csv")},
        "versions": {"python": "3", "numpy": "2", "matplotlib": "3", "freetype": "2"},
    }
    outputs = save(figures, root / "results/figures", record)
    made = {str(path.relative_to(root)): digest(path) for path in outputs.values()}
    sidecar = record | {"outputs": made, "commit": "0123abc", "tree": "clean", "seconds": 1.5}
    (root / "results/figures/fig10_04.provenance.json").write_text(json.dumps(sidecar))
    return root


def ask(tree, *arguments, file="results/figures/fig10_04.png"):
    """Exit status and output of the command, with the library of the tree."""
    return run_module(tree, "vibroimpact_pipeline.provenance.verify", file, *arguments)


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
def test_an_unchanged_tree_matches(tree, kind):
    status, said = ask(tree, file=f"results/figures/fig10_04.{kind}")
    assert status == 0, said
    assert "closed form (15 digits)" in said
    assert "commit: 0123abc, clean tree" in said
    assert "run time: 1.5 s" in said
    assert said.endswith("The file matches the tree.\n")


@pytest.mark.parametrize(
    ("name", "old", "new", "expected"),
    [
        ("config/config.yaml", "kappa: 0.65", "kappa: 0.66", "system.kappa: is 0.66, was 0.65"),
        ("config/config.yaml", "C_range: [0.5, 1.1]", "C_range: [0.4, 1.1]", "figures.fig10_05: is {"),
        ("environment.lock", "numpy", "numpi", "environment.lock: has changed"),
        ("results/input.csv", "1", "2", "results/input.csv: has changed"),
        ("notebooks/closed_form.ipynb", "closed form", "open form", "notebooks/closed_form.ipynb: or library"),
        ("src/vibroimpact/theory/manifold.py", '"""', '"""A', "notebooks/closed_form.ipynb: or library code"),
    ],
)
def test_a_changed_tree_does_not_match(tree, name, old, new, expected):
    text = (tree / name).read_text()
    assert old in text
    (tree / name).write_text(text.replace(old, new, 1))
    status, said = ask(tree)
    assert status == 1
    assert expected in said
    assert said.endswith("1 difference(s): the tree has changed since.\n")


def test_what_the_figure_does_not_use_may_change(tree):
    for name in ("src/vibroimpact/exact/engine/simulation.py", "src/vibroimpact_pipeline/figure_check/accept.py"):
        with open(tree / name, "a") as file:
            file.write("\n# edited\n")
    config = (tree / "config/config.yaml").read_text()
    (tree / "config/config.yaml").write_text(config.replace("f20_hat: 0.89", "f20_hat: 0.9"))
    assert ask(tree)[0] == 0


def test_a_file_changed_by_hand_does_not_match(tree):
    svg = tree / "results/figures/fig10_04.svg"
    svg.write_text(svg.read_text().replace("</svg>", "<!-- by hand --></svg>"))
    status, said = ask(tree, file="results/figures/fig10_04.svg")
    assert status == 1
    assert "the file itself: has changed" in said


def test_without_its_sidecar_a_file_still_tells_but_for_commit_and_time(tree):
    (tree / "results/figures/fig10_04.provenance.json").unlink()
    status, said = ask(tree)
    assert status == 0
    assert "commit" not in said
    assert "run time" not in said


def test_made_outside_a_checkout_the_commit_is_said_not_to_be_known(tree):
    path = tree / "results/figures/fig10_04.provenance.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"commit": None, "tree": None}))
    status, said = ask(tree)
    assert status == 0
    assert "commit: not known, made without git\n" in said


def test_a_record_can_be_had_as_json(tree):
    status, said = ask(tree, "--json")
    assert status == 0
    assert json.loads(said)["config"]["system.kappa"] == 0.65


@pytest.mark.parametrize("file", ["results/figures/nothing.png", "results/input.csv", "environment.lock"])
def test_a_file_that_does_not_tell_has_a_status_of_its_own(tree, file):
    status, said = ask(tree, file=file)
    assert status == 2
    assert "Traceback" not in said


def test_the_library_of_another_tree_is_no_judge(tree):
    with pytest.raises(ValueError, match="does not belong"):
        provenance.differences({"config": {}, "inputs": {}, "steps": [], "lock": ""}, tree)


def test_help_says_what_the_exit_status_means(tree):
    status, said = ask(tree, "--help")
    assert status == 0
    assert "Exit status" in said
