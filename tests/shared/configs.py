"""Config of the checkout, and edited copies of this config."""

import copy
import re
from pathlib import Path

import yaml
from hypothesis import strategies as st

from pipeline_trees import ROOT
from vibroimpact_pipeline.config import ConfigError, checked, read

TEXT = (ROOT / "config/config.yaml").read_text(encoding="utf-8")
GOOD = {key: entry for path in sorted((ROOT / "config").glob("*.yaml")) for key, entry in read(path).items()}
LAUGHS = "a0: &a0 [ha, ha]\n" + "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12))


def malformed(path: Path) -> list[list[str]]:
    """Return the edits in a list of malformed configs, and the keys that errors must name."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split(" -> ") for line in lines if not line.startswith("#")]


TABLE = malformed(Path(__file__).with_name("malformed_configs.txt"))
UNDAMPED = "system.gamma1_hat = 0 & system.gamma2_hat = 0 & system.gamma12_hat = 0"
UNFORCED = "cases.weak.f10_hat = 0 & cases.weak.f20_hat = 0"
SMALL = "simulation: {initial_state: [1, 0, -1, 0, 0, 0, 0, 0], "
SMALL += "transient_cycles: 0, window_cycles: 1, samples_per_cycle: 8}"
SOFT = f"cases.soft = {{f10_hat: 1, f20_hat: 0.9, kappa: 0.5, epsilon: 0.05, {SMALL}}}"
"""Edit that adds a case with parameters of its own."""
UNUSUAL = [
    "system.epsilon = 0.000001",
    "system.kappa = 0.001",
    "system.kappa = '0.4' & cases.weak.simulation.initial_state[0] = 1e-3 & accuracy.problems.transient.cycles = '61'",
    "system.alpha12_hat = 0 & system.gamma12_hat = 0",
    UNDAMPED,
    "system.sigma_e_hat = 1000",
    UNFORCED,
    f"{UNFORCED} & system.alpha12_hat = 0 & system.gamma12_hat = 0 & cases.weak.f10_hat = 1",
    f"cases.all = {{f10_hat: 1, f20_hat: -1, {SMALL}}}",
    "cases.weak.simulation.digits = ... & figures.fig10_10.periods = 3",
    "figures.fig10_10 = ... & figures.fig10_11 = ...",
    "figures = {mine: {like: fig10_08, model: float64, case: equal}}",
    "cases.weak = ... & default_case = unequal",
    f"cases = {{my-own: {{f10_hat: 0.7, f20_hat: 0.4, {SMALL}}}}} & figures.mine = {{like: fig10_08, model: float64}}",
    "cases.weak.epsilon = 0.05 & cases.weak.kappa = '0.5'",
    "figures.case = {like: fig10_08, model: float64, case: weak}",
    "figures.conditions = {like: fig10_08, model: float64}",
]
"""Edits for `edited` that give unusual but valid configs, in contrast to TABLE."""


def edited(edits: str) -> dict:
    """Return the valid config after edits "place = YAML", which are joined by " & "; the value ... deletes an entry."""
    config = copy.deepcopy(GOOD)
    for edit in edits.split(" & "):
        place, _, value = edit.partition(" =")
        *above, key = [int(part[1:]) if part[0] == "[" else part for part in re.findall(r"\[\d+|[^.\[\]]+", place)]
        inside = config
        for part in above:
            inside = inside[part]
        if value.strip() == "...":
            del inside[key]
        else:
            inside[key] = yaml.safe_load(value)
    return config


def problems(config: dict) -> dict[str, str]:
    """Return the problems of a config by key, and check that each is one printable line."""
    try:
        checked(config)
    except ConfigError as refusal:
        lines = str(refusal).split("\n")
        assert all(line.isprintable() and len(line) < 1000 for line in lines), lines
        return dict(line.removeprefix("--config: ").split(": ", 1) for line in lines if not line.startswith("... and"))
    return {}


def places(value, above=()):
    """Yield the key paths of all values in a config, including mappings and lists."""
    yield above
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        yield from places(item, (*above, key))


def at(config, place):
    for part in place:
        config = config[part]
    return config


def with_another_number(*sections) -> st.SearchStrategy[dict]:
    """Return a strategy of configs in which one number of the given sections is multiplied by some factor."""

    def changed(place, factor):
        config, before = copy.deepcopy(GOOD), at(GOOD, place)
        after = before * factor
        at(config, place[:-1])[place[-1]] = round(after) if isinstance(before, int) else after
        return config

    numbers = [place for place in places(GOOD) if isinstance(at(GOOD, place), int | float) and place[0] in sections]
    factors = st.sampled_from([-1, 0, 0.5, 1.5, 2, 10, 1e-3, 1e6]) | st.floats(-3, 3)
    return st.builds(changed, st.sampled_from(numbers), factors)
