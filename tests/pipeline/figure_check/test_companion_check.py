"""The figure check on companion figures, small: rounding passes, chaos included; what is wrong is caught."""

import math
import shutil
from dataclasses import asdict
from functools import lru_cache

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from absorber_sweeps import BAND, tables_of
from chapter import FORCES, PARAMETERS
from checking import LIMITS, assert_caught, build, copy_pictures
from lifetimes import LIFETIMES
from verdict_tables import verdicts_of
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.figures.companions import (
    companion_10_04,
    companion_10_05,
    companion_absorber,
    companion_asymmetric,
    companion_decay,
    companion_horizon,
    companion_ladder,
    companion_response,
    companion_stability,
)
from vibroimpact.figures.companions import companion_basins as basins
from vibroimpact.figures.companions import companion_branches as branches
from vibroimpact.figures.companions import companion_epsilon as epsilon_limit
from vibroimpact.figures.companions import companion_modulation as modulation
from vibroimpact.figures.companions import companion_regime_map as regime_map
from vibroimpact.figures.kit import tables
from vibroimpact.sweeps.asked import Asked
from vibroimpact.sweeps.grid import Grid, axis
from vibroimpact.sweeps.rows import rows
from vibroimpact.system.state import NAMES
from vibroimpact_pipeline.figure_check import compare as figure_check

SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
OBSERVATION = {"cycles": 250, "rounds": 3, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 2000}
LONG = OBSERVATION | {"retest": 10_000}
"""As in the figure: names that are tried for longer depend less on rounding."""
BRIEFLY = OBSERVATION | {"cycles": 100, "rounds": 1, "retest": 100}
START, CYCLES = [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5], 60
BRANCHES = {
    "paths": [{"along": ["f20_hat"], "range": [0.7, 1.2]}],
    "longest_step": 0.1,
    "seeds": 2,
    "attractors": {"values": 15, "starts": 5, "seed": 1},
    "observation": OBSERVATION,
    "lifetimes": LIFETIMES,
}


@lru_cache
def truth():
    weak = SYSTEMS["weak"]
    samples = proven_run(weak, START, CYCLES, sample_times=np.arange(CYCLES + 1) * weak.period).run.samples
    return pd.DataFrame(samples, columns=list(NAMES))


def all_systems(change):
    return {case: change(system) for case, system in SYSTEMS.items()}


def mapped(system):
    grid = Grid(system, [axis([name], (0.0, 1.6), cells=15) for name in ("f10_hat", "f20_hat")])
    asked = Asked(("regimes", "fixed_points"), 5, 1, observation=LONG)
    return pd.DataFrame(rows(grid, asked, range(len(grid))))


def asymmetric(systems):
    return companion_asymmetric.compute(systems, verdicts_of(systems)[1], [0.1, 1e-3], 9, 0.05, 2.5)


@lru_cache
def balls(system):
    return tables_of(system, BRIEFLY)


def response(system):
    swept = balls(system)
    return companion_response.compute(system, swept["response"], swept["clearance"], BAND)


COMPUTE = {
    "companion_10_04": lambda change: companion_10_04.compute(change(SYSTEMS["equal"]).kappa, 2.5),
    "companion_10_05": lambda change: companion_10_05.compute((0.5, 2.2)),
    "companion_stability": lambda change: companion_stability.compute(
        all_systems(change), *verdicts_of(all_systems(change))
    ),
    "companion_horizon": lambda change: companion_horizon.compute(change(SYSTEMS["weak"]), START, truth(), 40),
    "companion_branches": lambda change: branches.compute(
        change(SYSTEMS["unequal"]), systems=all_systems(change), **BRANCHES
    ),
    "companion_regime_map": lambda change: regime_map.compute(mapped(change(SYSTEMS["equal"])), all_systems(change), 5),
    "companion_modulation": lambda change: modulation.compute(
        all_systems(change), starts=16, seed=2, cycles=300, blocks=15, block=10, windows=[100], observation=OBSERVATION
    ),
    "companion_basins": lambda change: basins.compute(change(SYSTEMS["unequal"]), "unequal", 15, OBSERVATION),
    "companion_response": lambda change: response(change(SYSTEMS["equal"])),
    "companion_absorber": lambda change: companion_absorber.compute(
        change(SYSTEMS["equal"]),
        **balls(change(SYSTEMS["equal"])),
        band=BAND,
        observation=BRIEFLY,
        number=2,
        seed=1,
        cycles=60,
        settle=40,
    ),
    "companion_decay": lambda change: companion_decay.compute(change(SYSTEMS["equal"]), [0.5, 50.0], 21, 0.1, BAND),
    "companion_asymmetric": lambda change: asymmetric({"equal": change(SYSTEMS["equal"])}),
    "companion_epsilon": lambda change: epsilon_limit.compute(
        all_systems(change), [0.1, 1e-3], 3, 0.05, {"case": "unequal", "label": "b"}
    ),
    "companion_ladder": lambda change: companion_ladder.compute(
        {"equal": change(SYSTEMS["equal"])}, [1, 3, 5], [0.2, 1.6], [0.2, 1.6], 2, [0.6, 0.89]
    ),
}
"""Tables of each figure, with every system as `change` leaves it."""
MODULES = {
    "companion_10_04": companion_10_04,
    "companion_10_05": companion_10_05,
    "companion_stability": companion_stability,
    "companion_horizon": companion_horizon,
    "companion_branches": branches,
    "companion_regime_map": regime_map,
    "companion_modulation": modulation,
    "companion_basins": basins,
    "companion_response": companion_response,
    "companion_absorber": companion_absorber,
    "companion_decay": companion_decay,
    "companion_asymmetric": companion_asymmetric,
    "companion_epsilon": epsilon_limit,
    "companion_ladder": companion_ladder,
}
OF_SYSTEMS = [name for name in MODULES if name != "companion_10_05"]
CHAOTIC = ["companion_horizon", "companion_branches", "companion_regime_map", "companion_modulation"]
CHAOTIC += ["companion_response", "companion_absorber"]


def unchanged(system):
    return system


def other_rounding(system):
    """Parameters some units in the last place away, as if another machine had rounded on the way."""
    random = np.random.default_rng(3)

    def near(value):
        for _ in range(random.integers(1, 5)):
            value = math.nextafter(value, random.choice([-math.inf, math.inf]))
        return value

    return system.with_(**{name: near(value) for name, value in asdict(system).items()})


def other_kappa(system):
    return system.with_(kappa=1.01 * system.kappa)


def other_force(system):
    return system.with_(f20_hat=1.005 * system.f20_hat)


def plotted(computed):
    return computed["csv"] if isinstance(computed, dict) else computed


@lru_cache
def computed(name):
    return COMPUTE[name](unchanged)


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """The folder with the reference of a figure, written when it is asked for."""
    folder = tmp_path_factory.mktemp("companions")

    @lru_cache
    def of(name):
        build(folder, name, plotted(computed(name)), MODULES[name].draw(computed(name)))
        return folder

    return of


@pytest.fixture
def verdict(reference, tmp_path):
    """The verdict on a table, and on the figure that was drawn with it: without one, the numbers alone can tell."""

    def judge(name, table, figure=None):
        before = reference(name)
        if figure:
            build(tmp_path, name, table, figure)
        else:
            tables.write(table, tmp_path / f"{name}.csv")
            shutil.copy(before / f"{name}.artists.json", tmp_path)
            copy_pictures(name, before, tmp_path)
        return figure_check.check(name, before, tmp_path, LIMITS)

    return judge


SLOW = "companion_regime_map", "companion_epsilon", "companion_branches"
THOROUGH = [pytest.param(name, marks=[pytest.mark.thorough] * (name in SLOW)) for name in MODULES]


@pytest.mark.parametrize("name", THOROUGH)
def test_the_rounding_of_another_machine_passes(verdict, name):
    """The whole figure is computed from parameters spoilt in their last digits: chaotic motions come out different."""
    made = COMPUTE[name](other_rounding)
    found = verdict(name, plotted(made), MODULES[name].draw(made))
    assert (found["status"], found["reasons"]) == ("passed", [])
    moved = [column["column"] for column in found["tables"] if column["distance"] > 1e-6]
    assert bool(moved) == (name in CHAOTIC)


@pytest.mark.parametrize("name", OF_SYSTEMS)
def test_kappa_off_by_one_per_cent_is_caught(verdict, name):
    assert_caught(verdict(name, plotted(COMPUTE[name](other_kappa))), f"{name}.csv: ")


@pytest.mark.parametrize(
    "name",
    ["companion_stability", "companion_horizon", "companion_regime_map", "companion_basins", "companion_epsilon"],
)
def test_f20_off_by_half_a_per_cent_is_caught(verdict, name):
    assert_caught(verdict(name, plotted(COMPUTE[name](other_force))), f"{name}.csv: ")


def edited(name, change):
    """The name of a figure, and its table after a change."""
    return name, change(plotted(computed(name)).copy())


def test_a_dropped_branch_is_caught(verdict):
    table = plotted(computed("companion_branches"))
    last = table.loc[table["series"] == "symmetric orbit", "branch"].max()
    left = table[(table["series"] != "symmetric orbit") | (table["branch"] != last)]
    assert_caught(verdict("companion_branches", left), "a, symmetric orbit")
    assert 0 < len(left) < len(table)


def test_a_verdict_turned_round_is_caught(verdict):
    def turned(table):
        return table.replace({"floquet": {"stable": "unstable"}})

    found = verdict(*edited("companion_stability", turned))
    assert_caught(found, "rows instead of")


def test_mirrored_basins_are_caught(verdict):
    names = {"asymmetric": "asymmetric, mirrored", "asymmetric, mirrored": "asymmetric"}
    table = plotted(computed("companion_basins")).copy()
    starts = table["series"] == "start"
    table.loc[starts, "label"] = table.loc[starts, "label"].replace(names)
    assert_caught(verdict("companion_basins", table), "label is off by ")


def test_lost_bursts_are_caught(verdict):
    """Those of one module that are shorter than most."""

    def fewer(table):
        mine = table.index[table["series"] == "weak, module 1"]
        return table.drop(mine[: len(mine) // 2])

    found = verdict(*edited("companion_modulation", fewer))
    assert_caught(found, "length is off by ")


def test_exponents_in_a_wrong_unit_are_caught(verdict):
    def per_radian(table):
        return table.assign(exponent=table["exponent"] / (2 * np.pi))

    found = verdict(*edited("companion_modulation", per_radian))
    assert_caught(found, "exponent is off by ")


def test_a_cheaper_rung_in_the_map_is_caught(verdict):
    """One place of it, said to be right with the next rung below."""

    def cheaper(table):
        (place,) = table.index[(table["panel"] == "plane") & (table["label"] == "two terms")][:1]
        return table.assign(label=table["label"].where(table.index != place, "leading order"))

    assert_caught(verdict(*edited("companion_ladder", cheaper)), "label is off by ")


def test_lost_digits_are_caught(verdict):
    """A run in single precision leaves the truth with errors 10^9 times those of double precision."""

    def single(table):
        measured = table["series"] == "measured"
        return table.assign(error=table["error"].where(~measured, (table["error"] * 1e9).clip(upper=1.0)))

    assert_caught(verdict(*edited("companion_horizon", single)), "error is off by ")


def test_another_style_of_simulated_artists_is_caught(verdict, reference, monkeypatch):
    """Their places are not compared, all else is."""
    reference("companion_branches")
    made = computed("companion_branches")
    monkeypatch.setitem(branches.DOTS[branches.VARYING], "marker", "x")
    assert_caught(verdict("companion_branches", plotted(made), branches.draw(made)), "marker: x instead of .")


def test_another_scale_of_grey_is_caught(verdict, reference, monkeypatch):
    reference("companion_basins")
    made = computed("companion_basins")
    monkeypatch.setitem(basins.SHADES, "strongly modulated", "0.9")
    assert_caught(
        verdict("companion_basins", plotted(made), basins.draw(made)), "faces 1: #e6e6e6ff instead of #ffffffff"
    )
