"""Companion figures of the regimes, small: numbers in their tables, line styles, nothing told by colour."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from absorber_sweeps import BAND, tables_of
from chapter import FORCES, PARAMETERS
from verdict_tables import verdicts_of
from vibroimpact.absorbers.references import fixed_balls, without_balls
from vibroimpact.absorbers.tuning import compared
from vibroimpact.figures import (
    companion_absorber,
    companion_asymmetric,
    companion_decay,
    companion_ladder,
    companion_response,
)
from vibroimpact.figures import companion_basins as basins
from vibroimpact.figures import companion_branches as branches
from vibroimpact.figures import companion_epsilon as epsilon_limit
from vibroimpact.figures import companion_modulation as modulation
from vibroimpact.figures import companion_regime_map as regime_map
from vibroimpact.figures.kit import style
from vibroimpact.regimes.classification import REGIMES, starts
from vibroimpact.sweeps.grid import Grid, axis
from vibroimpact.sweeps.rows import rows as rows_of
from vibroimpact.sweeps.spec import Spec

OBSERVATION = {"cycles": 200, "rounds": 2, "window": 24, "nearness": 0.02, "blocks": 6, "block": 20, "retest": 1000}
SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
EQUAL = {"equal": SYSTEMS["equal"]}
MODULES = {
    "branches": branches,
    "regime_map": regime_map,
    "modulation": modulation,
    "basins": basins,
    "epsilon": epsilon_limit,
    "asymmetric": companion_asymmetric,
    "ladder": companion_ladder,
    "absorber": companion_absorber,
    "response": companion_response,
    "decay": companion_decay,
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
        "decay": companion_decay.compute(SYSTEMS["equal"], [0.5, 50.0], 9, 0.1, balls["band"]),
        "modulation": modulation.compute(
            SYSTEMS, starts=3, seed=2, cycles=200, blocks=20, block=10, windows=[100, 200], observation=OBSERVATION
        ),
        "basins": basins.compute(SYSTEMS["unequal"], "unequal", points=9, observation=OBSERVATION),
        "asymmetric": companion_asymmetric.compute(
            EQUAL, verdicts_of(EQUAL)[1], kappa=0.65, epsilon=[0.1, 1e-3], values=9, fit_below=0.05, C_max=2.5
        ),
        "ladder": companion_ladder.compute(EQUAL, [1, 3, 5], [0.0, 1.6], [0.0, 1.6], 2, [0.6, 0.89]),
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
    table = tables["branches"]["csv"]
    simulated = table[(table["series"] == "attractor") & (table["label"] == "asymmetric")]
    stable = table[(table["series"] == "asymmetric orbit") & table["stable"].eq(True)].sort_values("p")
    assert len(simulated)
    for module in ("C1", "C2"):
        np.testing.assert_allclose(simulated[module], np.interp(simulated["p"], stable["p"], stable[module]), atol=0.02)


def test_windows_show_what_converges(tables):
    windows = tables["modulation"]["windows"]
    assert set(windows["cycles"]) == {100, 200}
    assert set(windows["quantity"]) == {"amplitude variation", "depth from extremes"}
    measures = tables["modulation"]["measures"]
    rest = measures[(measures["start"] == "rest") & (measures["quantity"] == "largest Lyapunov exponent")]
    assert rest["uncertainty"].notna().all()


def test_spectra_say_the_same_as_the_measures_and_add_up(tables):
    """The largest exponent, the eight of the periodic case against what damping and impacts say, its dimension 0."""
    spectra, measures = tables["modulation"]["spectra"], tables["modulation"]["measures"]
    values = spectra.pivot(index=["case", "start", "regime"], columns="quantity", values="mean")
    largest = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(["case", "start", "regime"])[
        "mean"
    ]
    assert values["exponent 1"].sort_index().equals(largest.sort_index().rename("exponent 1"))
    np.testing.assert_allclose(values["sum of exponents"], values["contraction"], atol=1e-6)
    eight = values.loc["equal"].filter(like="exponent ").sum(axis=1)
    np.testing.assert_allclose(eight, values.loc["equal"]["contraction"], atol=1e-9)
    assert (values.loc["equal"]["Kaplan-Yorke dimension"] == 0).all()
    assert 5 < values.loc["weak", "spread"]["Kaplan-Yorke dimension"].item() < 6.5


def test_the_map_has_every_point_and_shows_those_without_a_value(tables, figures):
    cells = tables["regime_map"].query("series == 'cell'")
    assert cells["f10_hat"].tolist() == np.repeat(cells["f20_hat"][:6], 6).tolist()
    assert cells["label"].isna().tolist() == [number == 7 for number in range(36)]
    assert figures["regime_map"].axes[0].patch.get_hatch() == "xxx"
    table = tables["regime_map"]
    gone = (table["f10_hat"] == cells["f10_hat"][7]) & (table["series"] == "cell")
    assert regime_map.draw(table[~gone]).axes[0].patch.get_hatch() is None


def test_a_cell_shows_what_most_starts_other_than_rest_end_in(tables):
    cells = tables["regime_map"].query("series == 'cell'").dropna(subset="label")
    for cell in cells.to_dict("records"):
        ended = {name: round(3 * cell[name]) - (cell["label"] == name) for name in REGIMES}
        assert sum(ended.values()) == 2
        assert ended[cell["regime"]] == max(ended.values())
        assert cell["coexisting"] == sum(count > 0 for name, count in ended.items() if name != "unsettled")
    assert set(cells["coexisting"]) >= {1, 2}


def test_on_a_border_the_theory_s_number_of_fixed_points_changes(tables):
    """Within the last halving, to the side or upwards; where it crosses the way between two cells."""
    table = tables["regime_map"]
    centres = np.unique(table.query("series == 'cell'")["f10_hat"])
    pieces = table[table["series"] == "fixed points"]
    assert (pieces.groupby("label").size() == 2).all()
    step = 0.2 / 2**regime_map.HALVINGS
    aside = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)]

    def count(f10, f20):
        return len(vi.fixed_points(SYSTEMS["equal"].with_(f10_hat=f10, f20_hat=f20)))

    crossings = [place for place in pieces[["f10_hat", "f20_hat"]].to_numpy() if np.isin(place, centres).any()]
    assert len(crossings) > 10
    for f10, f20 in crossings[::5]:
        assert len({count(f10 + dx, f20 + dy) for dx, dy in aside}) > 1


def test_measures_have_uncertainties_over_starts(tables):
    measures = tables["modulation"]["measures"]
    assert set(measures["case"]) == set(FORCES)
    spread = measures[(measures["start"] == "spread") & (measures["quantity"] != "burst length")]
    assert spread["uncertainty"].notna().all()
    rest = measures[(measures["case"] == "weak") & (measures["start"] == "rest")]
    assert set(rest["regime"]) == {"one ball idle"}
    shares = measures[measures["quantity"] == "share of starts"].groupby("case")["mean"].sum()
    np.testing.assert_allclose(shares, 1)
    exponents = measures[measures["quantity"] == "largest Lyapunov exponent"].set_index(["case", "start"])["mean"]
    assert exponents["equal", "spread"] < 0 < exponents["weak", "spread"]


def test_basins_name_every_start_and_the_orbit_in_its_own(tables):
    table, shares = tables["basins"]["csv"], tables["basins"]["shares"]
    assert (table["series"] == "start").sum() == 81
    assert shares["share"].sum() == pytest.approx(1)
    orbit = table[table["series"] == "orbit"].iloc[0]
    starts = table[table["series"] == "start"]
    nearest = starts.iloc[np.hypot(starts["W1"] - orbit["W1"], starts["W2"] - orbit["W2"]).argmin()]
    assert nearest["label"] == orbit["label"]


def test_basins_show_the_mirror_image_and_their_table_has_what_all_starts_share(tables, figures):
    """The mirror image against the twin that the search for orbits finds."""
    table = tables["basins"]["csv"].set_index("series")
    stable = [o for o in vi.orbits(SYSTEMS["unequal"]) if not o.symmetric and np.abs(o.multipliers).max() < 1]
    twins = np.array([[o.state[0] - o.state[1], o.state[2] - o.state[3]] for o in stable])
    shown = table.loc[["orbit", "mirror image"], ["W1", "W2"]].to_numpy(float)
    np.testing.assert_allclose(shown[shown[:, 0].argsort()], twins[twins[:, 0].argsort()], atol=1e-8)
    (own,) = [o for o in stable if abs(o.state[0] - table.loc["shared", "X1"]) < 1e-9]
    np.testing.assert_allclose(
        table.loc["shared", basins.SHARED].to_numpy(float), own.state[[0, 2, 4, 5, 6, 7]], atol=1e-12
    )
    (axes,) = figures["basins"].axes
    assert axes.get_title("left") == "unequal"


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


def test_linear_systems_decay_in_the_same_time_after_any_impulse_and_balls_in_their_own(tables):
    table = tables["decay"]
    for module in (1, 2):
        mine = table[table["panel"] == f"module {module}"].set_index("series")
        assert mine.loc["without balls", "cycles"].nunique() == 1
        balls, shortest = mine.loc["balls"], mine.loc["shortest"]
        assert shortest["cycles"] <= balls["cycles"].min() < mine.loc["without balls", "cycles"].iloc[0]
        assert balls["cycles"].iloc[0] == pytest.approx(mine.loc["without balls", "cycles"].iloc[0], rel=1e-9)
