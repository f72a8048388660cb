"""Configs with cases and figures of one's own, as edits of the files of a tree."""

from collections.abc import Callable

import yaml

from pipeline_trees import Tree

SIMULATION = {"initial_state": [0.0] * 8, "transient_cycles": 300, "window_cycles": 6, "samples_per_cycle": 64}
OWN_FIGURES = {
    "strong_response": {
        "like": "fig10_07",
        "model": "slow_flow",
        "case": "strong",
        "fixed_point": "b",
        "periods": 3,
    },
    "strong_motion": {"like": "fig10_08", "model": "float64", "case": "strong"},
    "still_planes": {"like": "fig10_06", "model": "slow_flow", "case": "still", "C_max": [2.5, 3.5]},
    "still_motion": {"like": "fig10_08", "model": "float64", "case": "still"},
}
"""Each kind of notebook that takes a case; `still` is too weakly driven to have a fixed point or an impact."""


def renamed(config, old, new):
    """A config in which a case has another name, everywhere."""
    text = yaml.safe_dump(config, sort_keys=False)
    return yaml.safe_load(text.replace(f"case: {old}\n", f"case: {new}\n").replace(f"  {old}:\n", f"  {new}:\n"))


def without_case(config, case):
    """A config without a case and what shows it."""
    del config["cases"][case]
    for section in (config["figures"], config["accuracy"]["problems"]):
        for name in [name for name, scene in section.items() if scene.get("case") == case]:
            del section[name]


def edit(tree: Tree, name: str, change: Callable[[dict], dict | None]) -> None:
    """Change a config file of a tree by a function of it."""
    config = yaml.safe_load((tree / name).read_text(encoding="utf-8"))
    (tree / name).write_text(yaml.safe_dump(change(config) or config, sort_keys=False), encoding="utf-8")


def own(config):
    """Two cases and four figures more; one case of the chapter renamed, one gone; one problem."""
    config = renamed(config, "unequal", "uneven")
    without_case(config, "weak")
    config["accuracy"]["problems"] = {"transient": config["accuracy"]["problems"]["transient"]}
    config["cases"]["strong"] = {"title": "A b", "f10_hat": 1.0, "f20_hat": 0.95, "simulation": SIMULATION}
    config["cases"]["still"] = {"f10_hat": 0.05, "f20_hat": 0.0, "simulation": SIMULATION}
    config["figures"] |= OWN_FIGURES
    return config


def single(config):
    """The case `equal` alone, under another name, with the chapter's figures of it."""
    for case in ("unequal", "weak"):
        without_case(config, case)
    return renamed(config, "equal", "alone")
