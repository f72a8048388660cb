"""Small companion figures of the regimes: numbers in tables, line styles, colours and marks."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from studies.absorber_sweeps import BAND, tables_of
from vibroimpact.studies.figures import companion_absorber
from vibroimpact.studies.figures import companion_branches as branches
from vibroimpact.studies.figures import companion_regime_map as regime_map
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS, MARKS
from vibroimpact.studies.regimes.classification import REGIMES, starts
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.rows import rows as rows_of
from vibroimpact.studies.sweeps.spec import Spec

OBSERVATION = {"cycles": 200, "rounds": 2, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 1000}
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}


def swept():
    """Return the table of a small map of regimes, in which one point is not observed."""
    axes = [axis([name], (0.2, 1.4), cells=6) for name in ("f10_hat", "f20_hat")]
    grid, spec = Grid(SYSTEMS["equal"], axes), Spec(("regimes", "fixed_points"), 3, 1, observation=OBSERVATION)
    table = pd.DataFrame(rows_of(grid, spec, range(len(grid))))
    table.loc[7, [*REGIMES, "from_rest", "fixed_points", "stable_points"]] = np.nan
    return table


@pytest.fixture(scope="module")
def map_of_regimes():
    """Return the tables of the regime map."""
    return regime_map.compute(swept(), SYSTEMS["equal"], SYSTEMS, 3)


@pytest.fixture(scope="module")
def branched():
    """Return the tables of the figure of branches, for a path in f20_hat."""
    attractors = {"values": 3, "starts": 3, "seed": 1}
    paths = [{"along": ["f20_hat"], "range": [0.7, 1.2]}]
    return branches.compute(SYSTEMS["unequal"], paths, 0.1, 2, attractors, OBSERVATION, SYSTEMS)


def test_bold_lines_end_at_special_points_and_cover_the_stable_nodes(branched):
    table = branched["csv"].query("admissible == True")
    special = set(branched["special_points"][["p", "C2"]].itertuples(index=False, name=None))
    for axes, theory in zip(branches.draw(branched).axes, (True, False), strict=True):
        bold = [line.get_xydata() for line in axes.lines if line.get_linestyle() == "-" and line.get_linewidth() > 1.5]
        assert {tuple(line[k]) for line in bold for k in (0, -1) if 0.7 < line[k, 0] < 1.2} <= special
        stable = table[((table["series"] == "fixed point") == theory) & table["stable"].eq(True)]
        assert np.unique(np.concatenate(bold), axis=0).tolist() == np.unique(stable[["p", "C2"]], axis=0).tolist()


def test_simulated_attractors_lie_on_the_stable_branch(branched):
    table, simulated = branched["csv"], branched["attractors"].query("label == 'asymmetric'")
    stable = table[(table["series"] == "asymmetric orbit") & table["stable"].eq(True)].sort_values("p")
    assert len(simulated)
    for module in ("C1", "C2"):
        np.testing.assert_allclose(simulated[module], np.interp(simulated["p"], stable["p"], stable[module]), atol=0.02)


def test_the_map_has_every_point_and_shows_those_without_a_value(map_of_regimes):
    cells = map_of_regimes["csv"]
    assert cells["f10_hat"].tolist() == np.repeat(cells["f20_hat"][:6], 6).tolist()
    assert cells["label"].isna().tolist() == [number == 7 for number in range(36)]
    whole = map_of_regimes | {"csv": cells[cells["f10_hat"] != cells["f10_hat"][7]]}
    hatches = [regime_map.draw(tables).axes[0].patch.get_hatch() for tables in (map_of_regimes, whole)]
    assert hatches == ["xxx", None]


def test_a_cell_shows_the_regime_of_most_starts_other_than_rest(map_of_regimes):
    cells = map_of_regimes["csv"].dropna(subset="label")
    for cell in cells.to_dict("records"):
        ended = {name: round(3 * cell[name]) - (cell["label"] == name) for name in REGIMES}
        assert sum(ended.values()) == 2
        assert ended[cell["regime"]] == max(ended.values())
        assert cell["coexisting"] == sum(count > 0 for name, count in ended.items() if name != "unsettled")
    assert set(cells["coexisting"]) >= {1, 2}


def test_the_number_of_fixed_points_changes_at_a_border(map_of_regimes):
    """The test compares points one bisection step apart, where a border crosses the line between two cell centres."""
    centres = np.unique(map_of_regimes["csv"]["f10_hat"])
    pieces = map_of_regimes["borders"].query("series == 'fixed points'")
    assert (pieces.groupby("piece").size() == 2).all()
    step = 0.2 / 2**regime_map.HALVINGS
    aside = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)]

    def count(f10, f20):
        return len(vi.fixed_points(SYSTEMS["equal"].with_(f10_hat=f10, f20_hat=f20)))

    crossings = [place for place in pieces[["f10_hat", "f20_hat"]].to_numpy() if np.isin(place, centres).any()]
    assert len(crossings) > 10
    for f10, f20 in crossings[::5]:
        assert len({count(f10 + dx, f20 + dy) for dx, dy in aside}) > 1


def test_a_rare_regime_has_its_own_colour_and_mark(map_of_regimes):
    """One cell of a chaotic map is set to hopping, which the legend then contains."""
    cells = map_of_regimes["csv"].assign(regime="chaotic")
    cells.loc[3, "regime"] = "hopping"
    figure = regime_map.draw(map_of_regimes | {"csv": cells})
    mesh = figure.axes[0].collections[0]
    painted = mesh.to_rgba(mesh.get_array())[..., :3].reshape(6, 6, 3)
    expected = np.full((6, 6, 3), to_rgb(COLOURS["chaotic"]))
    expected[3, 0] = to_rgb(COLOURS["hopping"])  # indices: f20_hat, f10_hat; the table varies f20_hat first
    np.testing.assert_allclose(painted, expected)
    (mark,) = (line for line in figure.axes[0].lines if line.get_marker() == MARKS["hopping"])
    assert mark.get_xydata().tolist() == cells[["f10_hat", "f20_hat"]].iloc[[3]].to_numpy().tolist()
    assert "hopping" in {text.get_text() for text in figure.legends[0].get_texts()}


def test_lowest_peaks_are_measured_again_with_a_standard_error():
    """Runs of the same starts are evaluated cycle by cycle for each frequency; the error is a jackknife over starts."""
    balls = {"band": BAND, "seed": 1, "cycles": 60, "settle": 40}
    balls |= tables_of(SYSTEMS["equal"], OBSERVATION)
    summary = companion_absorber.compute(SYSTEMS["equal"], **balls)["summary"]
    lowest = summary.query("quantity == 'lowest peak'")
    assert lowest["kappa"].tolist() == sorted(balls["design"]["kappa"].unique())
    states = starts(companion_absorber.REMEASURED_STARTS, balls["seed"] + 1)
    for place in lowest.itertuples():
        mine = balls["design"].query("kappa == @place.kappa")
        few = (mine["peak"] / mine["f10_hat"]).nsmallest(companion_absorber.REMEASURED_PEAKS).index
        assert place.f10_hat in mine["f10_hat"][few].tolist()
        there = SYSTEMS["equal"].with_(kappa=place.kappa, f10_hat=place.f10_hat, f20_hat=place.f20_hat)
        runs = []
        for value in np.linspace(-1.0, 1.0, 9):
            system = there.with_(sigma_e_hat=value)
            seen = vi.ensemble(system, states, balls["cycles"], settle=balls["settle"], by_cycle=True)["largest"]
            runs.append(seen.max(axis=-1).T / (0.1 * place.f10_hat))
        runs = np.array(runs)  # frequencies, cycles, starts
        assert place.value == pytest.approx(np.percentile(runs, 99, axis=(1, 2)).max(), rel=1e-9)
        others = [np.percentile(np.delete(runs, k, axis=2), 99, axis=(1, 2)).max() for k in range(len(states))]
        assert place.spread**2 == pytest.approx(7 / 8 * np.sum((others - np.mean(others)) ** 2), rel=1e-6, abs=1e-12)
    best = summary.query("who == 'balls, best kappa'").iloc[0]
    assert best["value"] == lowest["value"].min()


@pytest.mark.parametrize(
    ("peaks", "level"),
    [
        ([9.0, 8.5, 9.2, 12.0], (0.3, 8.5, 9.2)),
        ([8.0, 12.0, 8.1, 8.2], (0.1, 8.0, 8.0)),
        ([9.7, 8.0, 8.0, 8.0], (np.nan, np.nan, np.nan)),
    ],
)
def test_a_plateau_ends_where_a_lowest_peak_is_a_fifth_higher(peaks, level):
    places = [{"kappa": kappa, "value": value} for kappa, value in zip((0.1, 0.2, 0.3, 0.4), peaks, strict=True)]
    np.testing.assert_equal(companion_absorber.plateau(places), level)
