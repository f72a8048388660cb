"""Configs with your own cases and figures, made by edits of the files in a tree."""

from collections.abc import Callable

import yaml

from pipeline_trees import Tree

SIMULATION = {"initial_state": [0.0] * 8, "transient_cycles": 300, "window_cycles": 6, "samples_per_cycle": 64}
OWN_FIGURES = {
    "strong_response": {"like": "fig10_07", "model": "slow_flow", "case": "strong", "fixed_point": "b", "periods": 3},
    "strong_motion": {"like": "fig10_08", "model": "float64", "case": "strong"},
    "still_planes": {"like": "fig10_06", "model": "slow_flow", "case": "still", "C_max": [2.5, 3.5]},
    "still_motion": {"like": "fig10_08", "model": "float64", "case": "still"},
}
"""Figures for each notebook with a case; the force of `still` is too small for fixed points and impacts."""


def renamed(config, old, new):
    """Return a config in which a case is renamed everywhere."""
    text = yaml.safe_dump(config, sort_keys=False)
    return yaml.safe_load(text.replace(f"case: {old}\n", f"case: {new}\n").replace(f"  {old}:\n", f"  {new}:\n"))


def without_case(config, case):
    """Delete a case and the entries that show it from a config, in place."""
    del config["cases"][case]
    for section in (config["figures"], config["accuracy"]["problems"]):
        for name in [name for name, scene in section.items() if scene.get("case") == case]:
            del section[name]


def edit(tree: Tree, name: str, change: Callable[[dict], dict | None]) -> None:
    """Change a config file in a tree by a function of its content."""
    config = yaml.safe_load((tree / name).read_text(encoding="utf-8"))
    (tree / name).write_text(yaml.safe_dump(change(config) or config, sort_keys=False), encoding="utf-8")


def own(config):
    """Add two cases and four figures, rename and remove a case of the chapter, and keep one test problem."""
    config = renamed(config, "unequal", "uneven")
    without_case(config, "weak")
    config["accuracy"]["problems"] = {"transient": config["accuracy"]["problems"]["transient"]}
    config["cases"]["strong"] = {"title": "A b", "f10_hat": 1.0, "f20_hat": 0.95, "simulation": SIMULATION}
    config["cases"]["still"] = {"f10_hat": 0.05, "f20_hat": 0.0, "simulation": SIMULATION}
    config["figures"] |= OWN_FIGURES
    return config


def single(config):
    """Return a config with only the case `equal`, renamed, and its figures of the chapter."""
    for case in ("unequal", "weak"):
        without_case(config, case)
    return renamed(config, "equal", "alone")
