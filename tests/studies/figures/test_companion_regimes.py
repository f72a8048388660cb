"""Companion figures of the regimes, small: numbers in their tables, line styles, nothing told by colour."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from figure_tables import lightness
from studies.absorber_sweeps import BAND, tables_of
from verdict_tables import verdicts_of
from vibroimpact.figures.plotting import style
from vibroimpact.studies.absorbers.references import fixed_balls, without_balls
from vibroimpact.studies.absorbers.tuning import compared
from vibroimpact.studies.figures import companion_absorber, companion_asymmetric, companion_response
from vibroimpact.studies.figures import companion_basins as basins
from vibroimpact.studies.figures import companion_branches as branches
from vibroimpact.studies.figures import companion_epsilon as epsilon_limit
from vibroimpact.studies.figures import companion_regime_map as regime_map
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS, MARKS
from vibroimpact.studies.regimes.classification import REGIMES, starts
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.rows import rows as rows_of
from vibroimpact.studies.sweeps.spec import Spec
from vibroimpact.system.state import NAMES

OBSERVATION = {"cycles": 200, "rounds": 2, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 1000}
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
EQUAL = {"equal": SYSTEMS["equal"]}
MODULES = {
    "branches": branches,
    "regime_map": regime_map,
    "basins": basins,
    "epsilon": epsilon_limit,
    "asymmetric": companion_asymmetric,
    "absorber": companion_absorber,
    "response": companion_response,
}


def swept():
    """A small map of regimes, one of its points not observed."""
    axes = [axis([name], (0.2, 1.4), cells=6) for name in ("f10_hat", "f20_hat")]
    grid, spec = Grid(SYSTEMS["equal"], axes), Spec(("regimes", "fixed_points"), 3, 1, observation=OBSERVATION)
    table = pd.DataFrame(rows_of(grid, spec, range(len(grid))))
    table.loc[7, [*REGIMES, "from_rest", "fixed_points", "stable_points"]] = np.nan
    return table


@pytest.fixture(scope="module")
def balls():
    spec = {"band": BAND, "observation": OBSERVATION, "starts": 2, "seed": 1, "cycles": 60, "settle": 40}
    return tables_of(SYSTEMS["equal"], OBSERVATION) | spec


@pytest.fixture(scope="module")
def tables(balls):
    return {
        "branches": branches.compute(
            SYSTEMS["unequal"],
            paths=[{"along": ["f20_hat"], "range": [0.7, 1.2]}],
            longest_step=0.1,
            seeds=2,
            attractors={"values": 3, "starts": 3, "seed": 1},
            observation=OBSERVATION,
            systems=SYSTEMS,
        ),
        "regime_map": regime_map.compute(swept(), SYSTEMS["equal"], SYSTEMS, 3),
        "absorber": companion_absorber.compute(SYSTEMS["equal"], **balls),
        "response": companion_response.compute(SYSTEMS["equal"], balls["response"], balls["clearance"], balls["band"]),
        "basins": basins.compute(SYSTEMS["unequal"], "unequal", points=9, observation=OBSERVATION),
        "asymmetric": companion_asymmetric.compute(
            EQUAL, verdicts_of(EQUAL)[1], kappa=0.65, epsilon=[0.1, 1e-3], values=9, fit_below=0.05, C_max=2.5
        ),
        "epsilon": epsilon_limit.compute(
            SYSTEMS, epsilon=[0.1, 1e-4], values=5, fit_below=0.05, mixed={"case": "unequal", "label": "b"}
        ),
    }


@pytest.fixture(scope="module")
def figures(tables, tmp_path_factory):
    """Each drawn of its tables as they come back from their files."""
    folder = tmp_path_factory.mktemp("figures")
    for name, module in MODULES.items():
        computed = tables[name] if isinstance(tables[name], dict) else {"csv": tables[name]}
        style.write_and_draw(module, tables[name], {key: folder / f"{name}.{key}.csv" for key in computed})
    drawn = {name: module.draw(tables[name]) for name, module in MODULES.items()}
    for figure in drawn.values():
        figure.draw_without_rendering()
    return drawn


def test_folds_ends_and_losses_of_stability_are_marked_and_no_other_special_point(tables, figures):
    """A loss of stability is where a bold line ends within the axes."""
    special = tables["branches"]["special_points"]
    for axes, theory in zip(figures["branches"].axes, (True, False), strict=False):
        bold = [line.get_xydata() for line in axes.lines if line.get_linestyle() == "-" and line.get_linewidth() > 1.5]
        ends = {tuple(line[k]) for line in bold for k in (0, -1)}
        mine = special[(special["family"] == "fixed point") == theory].query("0.7 <= p <= 1.2 and admissible")
        turning = mine[mine["kind"].isin(branches.ENDS)][["p", "C2"]].itertuples(index=False, name=None)
        marks = [line for line in axes.lines if line.get_label() in branches.MARKERS]
        marked = {tuple(place) for line in marks for place in line.get_xydata()}
        assert {place for place in ends if 0.7 < place[0] < 1.2} | set(turning) == marked
        assert len(marked) < len(mine)


def test_simulated_attractors_lie_on_the_stable_branch(tables):
    table, simulated = tables["branches"]["csv"], tables["branches"]["attractors"].query("label == 'asymmetric'")
    stable = table[(table["series"] == "asymmetric orbit") & table["stable"].eq(True)].sort_values("p")
    assert len(simulated)
    for module in ("C1", "C2"):
        np.testing.assert_allclose(simulated[module], np.interp(simulated["p"], stable["p"], stable[module]), atol=0.02)


def test_the_map_has_every_point_and_shows_those_without_a_value(tables, figures):
    cells = tables["regime_map"]["csv"]
    assert cells["f10_hat"].tolist() == np.repeat(cells["f20_hat"][:6], 6).tolist()
    assert cells["label"].isna().tolist() == [number == 7 for number in range(36)]
    assert figures["regime_map"].axes[0].patch.get_hatch() == "xxx"
    gone = tables["regime_map"] | {"csv": cells[cells["f10_hat"] != cells["f10_hat"][7]]}
    assert regime_map.draw(gone).axes[0].patch.get_hatch() is None


def test_a_cell_shows_what_most_starts_other_than_rest_end_in(tables):
    cells = tables["regime_map"]["csv"].dropna(subset="label")
    for cell in cells.to_dict("records"):
        ended = {name: round(3 * cell[name]) - (cell["label"] == name) for name in REGIMES}
        assert sum(ended.values()) == 2
        assert ended[cell["regime"]] == max(ended.values())
        assert cell["coexisting"] == sum(count > 0 for name, count in ended.items() if name != "unsettled")
    assert set(cells["coexisting"]) >= {1, 2}


def test_on_a_border_the_theory_s_number_of_fixed_points_changes(tables):
    """Within the last halving, to the side or upwards; where it crosses the way between two cells."""
    centres = np.unique(tables["regime_map"]["csv"]["f10_hat"])
    pieces = tables["regime_map"]["borders"].query("series == 'fixed points'")
    assert (pieces.groupby("piece").size() == 2).all()
    step = 0.2 / 2**regime_map.HALVINGS
    aside = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)]

    def count(f10, f20):
        return len(vi.fixed_points(SYSTEMS["equal"].with_(f10_hat=f10, f20_hat=f20)))

    crossings = [place for place in pieces[["f10_hat", "f20_hat"]].to_numpy() if np.isin(place, centres).any()]
    assert len(crossings) > 10
    for f10, f20 in crossings[::5]:
        assert len({count(f10 + dx, f20 + dy) for dx, dy in aside}) > 1


def test_basins_name_every_start_and_the_orbit_in_its_own(tables):
    starts, shares = tables["basins"]["csv"], tables["basins"]["shares"]
    assert len(starts) == 81
    assert shares["share"].sum() == pytest.approx(1)
    orbit = tables["basins"]["orbits"].iloc[0]
    distances = np.hypot(starts["W1"] - orbit["X1"] + orbit["Y1"], starts["W2"] - orbit["X2"] + orbit["Y2"])
    assert starts["label"].iloc[distances.argmin()] == "asymmetric"


def test_basins_show_the_orbit_and_its_mirror_image(tables, figures):
    """Against the twins that the search for orbits finds, in the figure too."""
    shown = tables["basins"]["orbits"][[*NAMES]].to_numpy(float)
    stable = [o.state for o in vi.orbits(SYSTEMS["unequal"]) if not o.symmetric and np.abs(o.multipliers).max() < 1]
    for state in stable:
        assert np.abs(shown - state).max(axis=1).min() < 1e-8
    (axes,) = figures["basins"].axes
    marks = [line.get_xydata()[0] for line in axes.lines]
    np.testing.assert_allclose(marks, shown[:, [0, 2]] - shown[:, [1, 3]], rtol=1e-12)
    assert axes.get_title("left").endswith("case unequal")


def test_hopping_is_not_painted_as_chaos(tables):
    """Each regime in its own colour and, where it is rare, under its own mark; the key has both."""
    cells = tables["regime_map"]["csv"]
    given = cells.assign(regime=["hopping" if number == 3 else "chaotic" for number in range(len(cells))])
    figure = regime_map.draw(tables["regime_map"] | {"csv": given})
    mesh = figure.axes[0].collections[0]
    painted = mesh.to_rgba(mesh.get_array())[..., :3].reshape(-1, 3)
    assert len(np.unique(painted, axis=0)) == 2
    painted = painted.reshape(6, 6, 3)  # f20_hat, f10_hat; rows of the table the other way
    np.testing.assert_allclose(painted[3, 0], to_rgb(COLOURS["hopping"]))
    np.testing.assert_allclose(painted[0, 3], to_rgb(COLOURS["chaotic"]))
    (mark,) = (line for line in figure.axes[0].lines if line.get_marker() == MARKS["hopping"])
    assert mark.get_xydata().tolist() == cells[["f10_hat", "f20_hat"]].iloc[[3]].to_numpy().tolist()
    assert "hopping" in {text.get_text() for text in figure.legends[0].get_texts()}


def test_neighbours_in_a_map_differ_in_grey_print():
    """Asymmetric responses beside modulated ones, and the others that fill patches."""
    large = ["symmetric", "chaotic", "asymmetric", "strongly modulated", "other periodic"]
    shades = [lightness(COLOURS[name]) for name in large]
    assert np.diff(shades).min() > 10
    assert shades[3] - shades[2] > 15
    assert abs(lightness(COLOURS["asymmetric"]) - lightness(COLOURS["asymmetric, mirrored"])) > 15


@pytest.mark.parametrize("forces", [(0.0, 0.0), (0.5, 0.5)])
def test_the_limit_of_small_epsilon_is_drawn_without_points_and_without_the_mixed_one(forces):
    system = SYSTEMS["weak"].with_(f10_hat=forces[0], f20_hat=forces[1])
    found = epsilon_limit.compute({"weak": system}, (0.01, 0.001), 3, fit_below=0.1)
    assert len(found["orders"]) == 4 * len(vi.fixed_points(system))
    epsilon_limit.draw(found)
    with pytest.raises(ValueError, match=r"mixed\.label: .*'c'"):
        epsilon_limit.compute({"weak": system}, (0.01, 0.001), 3, 0.1, mixed={"case": "weak", "label": "c"})


def test_orders_are_one_or_two_with_two_terms_and_the_mixed_point_is_left_out(tables):
    orders = tables["epsilon"]["orders"]
    assert (orders["panel"] == "two terms").any()
    np.testing.assert_allclose(orders["order"], np.where(orders["panel"] == "two terms", 2, 1), atol=0.05)
    assert not ((orders["case"] == "unequal") & (orders["label"] == "b")).any()
    assert "unequal, b" not in set(tables["epsilon"]["csv"]["series"])


def test_the_optimum_of_the_balls_is_where_a_sweep_is_lowest_and_its_margin_where_it_is_nearly_as_low(balls, tables):
    summary = tables["absorber"]["summary"].query("quantity == 'peak'").set_index("who")
    for who, name in (("balls", "clearance"), ("balls, best kappa", "design")):
        swept = balls[name].assign(ratio=lambda rows: rows["peak"] / (0.1 * rows["f10_hat"]))
        best = summary.loc[who]
        assert best["swept"] == pytest.approx(swept["ratio"].min(), rel=1e-12)
        there = np.isclose(1 / (0.1 * swept["f10_hat"]), best["clearance"])
        there &= swept.get("kappa", 0.65) == best["kappa"]
        assert swept["ratio"][there].item() == swept["ratio"].min()
        column = swept[swept.get("kappa", pd.Series(0.65, swept.index)) == best["kappa"]]
        clearances = 1 / (0.1 * column["f10_hat"])
        within = clearances.between(best["narrowest"] * 0.999, best["widest"] * 1.001)
        assert (column["ratio"][within] <= 1.25 * best["swept"]).all()
        for beside in (
            clearances[clearances < best["narrowest"] * 0.999].max(),
            clearances[clearances > best["widest"] * 1.001].min(),
        ):
            assert not (column["ratio"][clearances == beside] <= 1.25 * best["swept"]).any()


def test_lowest_peaks_are_measured_again_at_their_places_with_a_standard_error(balls, tables):
    """Against runs of the same starts, frequency by frequency and cycle by cycle; the error by leaving starts out."""
    lowest = tables["absorber"]["summary"].query("quantity == 'lowest peak'")
    assert lowest["kappa"].tolist() == sorted(balls["design"]["kappa"].unique())
    states = starts(companion_absorber.FRESH, balls["seed"] + 1)
    for place in lowest.itertuples():
        mine = balls["design"].query("kappa == @place.kappa")
        few = (mine["peak"] / mine["f10_hat"]).nsmallest(companion_absorber.FEW).index
        assert place.f10_hat in mine["f10_hat"][few].tolist()
        there = SYSTEMS["equal"].with_(kappa=place.kappa, f10_hat=place.f10_hat, f20_hat=place.f20_hat)
        runs = []
        for value in np.linspace(-1.0, 1.0, 9):
            system = there.with_(sigma_e_hat=value)
            seen = vi.ensemble(system, states, balls["cycles"], settle=balls["settle"], by_cycle=True)["largest"]
            runs.append(seen.max(axis=-1).T / (0.1 * place.f10_hat))
        runs = np.array(runs)  # frequencies, cycles, starts
        assert place.value == pytest.approx(np.percentile(runs, 99, axis=(1, 2)).max(), rel=1e-9)
        assert place.largest == pytest.approx(runs.max(), rel=1e-9)
        others = [np.percentile(np.delete(runs, k, axis=2), 99, axis=(1, 2)).max() for k in range(len(states))]
        assert place.spread**2 == pytest.approx(7 / 8 * np.sum((others - np.mean(others)) ** 2), rel=1e-6, abs=1e-12)
    best = tables["absorber"]["summary"].query("who == 'balls, best kappa'").iloc[0]
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


def test_the_room_that_absorbers_and_balls_need_is_told(tables):
    """The largest |X_i - Y_i| of matched absorbers, over the band, by a fine grid of frequencies; of balls |W_i| <= 1,
    the clearance.
    """
    summary, band = tables["absorber"]["summary"].query("quantity == 'stroke'").set_index("who"), (0.9, 1.1)
    frequencies = np.linspace(*band, 5001)
    for who in ("absorbers of the textbook", "best absorbers"):
        linear = compared(SYSTEMS["equal"], band)[who]
        assert summary["value"][who] == pytest.approx(linear.strokes(frequencies).max() / 0.1, rel=1e-6)
    peaks = tables["absorber"]["summary"].query("quantity == 'peak'").set_index("who")
    for who in ("balls", "balls, best kappa"):
        assert summary["value"][who] == pytest.approx(1 / (0.1 * peaks["f10_hat"][who]), rel=1e-12)


def test_balls_are_held_against_each_linear_system_where_both_were_looked_at(balls, tables):
    summary = tables["absorber"]["summary"]
    for (f10, f20), rows in balls["response"].groupby(["f10_hat", "f20_hat"]):
        for who, build in (("without balls", without_balls), ("balls fixed", fixed_balls)):
            times = []
            for row in rows.itertuples():
                system = SYSTEMS["equal"].with_(f10_hat=f10, f20_hat=f20, sigma_e_hat=row.sigma_e_hat)
                times.append(max(row.largest_X1, row.largest_X2) / build(system).amplitudes(system.Omega).max())
            said = summary[(summary["who"] == who) & (summary["f10_hat"] == f10)].set_index("quantity")["value"]
            assert said["frequencies won"] == np.mean(np.array(times) < 1)
            assert (said["least"], said["greatest"]) == pytest.approx((min(times), max(times)), rel=1e-9)


def test_what_impacts_take_is_told_for_every_source_and_pair_of_forces(balls, tables):
    shares = tables["response"]["shares"].set_index(["source", "f10_hat"])
    assert {source for source, _ in shares.index} == {"balls", "theory", "symmetric orbits"}
    for force, rows in balls["response"].groupby("f10_hat"):
        found, expected = shares.loc[("balls", force)], rows["impact_share"]
        assert found["points"] == 5
        assert found[["least", "middle", "greatest"]].tolist() == np.quantile(expected, [0, 0.5, 1]).tolist()
    assert shares["least"].gt(0).all()
    assert shares["greatest"].lt(1).all()


def test_an_impulse_is_told_for_balls_after_the_best_one_and_for_each_linear_system(balls, tables):
    """That of the balls is below all times of a coarse search, and reached within one; linear ones do not ask how large
    the impulse is.
    """
    cycles = tables["absorber"]["summary"].query("quantity == 'decay'").set_index("who")["value"]
    times = [
        vi.decay_time(SYSTEMS["equal"], impulse) / SYSTEMS["equal"].period for impulse in np.geomspace(0.5, 50, 81)
    ]
    assert min(times) - 0.5 < cycles["balls"] <= min(times)
    assert cycles["without balls"] == pytest.approx(times[0], rel=1e-9)  # no ball meets a wall
    linear = compared(SYSTEMS["equal"], (0.9, 1.1))
    for name, one in linear.items():
        assert cycles[name] == pytest.approx(one.decay_time(1, 0.1) / SYSTEMS["equal"].period, rel=1e-9)
