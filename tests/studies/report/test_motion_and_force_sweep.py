"""What the animation and the control show: the frames of a simulated motion, fixed points along a force."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.studies.figures import animation, force_sweep, nudge
from vibroimpact.system.state import KINDS
from vibroimpact.theory.manifold import B_of_C, rho

SYSTEM = {
    **PARAMETERS,
    "f10_hat": 1.0,
}
COORDINATES = ["X1", "Y1", "X2", "Y2"]


@pytest.fixture(scope="module")
def window():
    """Samples and events of three cycles, with the system."""
    system = vi.System(**SYSTEM, f20_hat=1.0)
    times = np.linspace(60, 63, 121) * system.period
    run = vi.simulate(system, [0.0] * 8, 63, sample_times=times)
    events = run.events[run.events["tau"] >= times[0]]
    table = pd.DataFrame({name: events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in events["kind"]]
    table[COORDINATES] = events["state"][:, :4]
    samples = pd.DataFrame(np.column_stack([times, run.samples[:, :4]]), columns=["tau", *COORDINATES])
    return samples, table, system


def test_frames_have_every_corner_of_the_motion(window):
    samples, events, system = window
    tables = animation.compute(samples, events, system, 2)
    motion, impacts = tables["motion"], tables["impacts"]
    assert motion["t"].is_monotonic_increasing
    assert (motion["t"].iloc[0], motion["t"].iloc[-1]) == pytest.approx((0.0, 2.0), abs=1e-9)
    assert len(impacts) == 8  # two per cycle and module
    for hit in impacts.itertuples():
        at_impact = np.interp(hit.t, motion["t"], motion[f"X{hit.module}"] - motion[f"Y{hit.module}"])
        assert at_impact == pytest.approx(hit.wall, abs=1e-9)


def test_between_frames_the_ball_flies_straight(window):
    """Y moves uniformly between impacts, so that the frames follow it exactly, whatever their distance."""
    samples, events, system = window
    fine = animation.compute(samples, events, system, 2)["motion"]
    coarse = animation.compute(samples.iloc[::20], events, system, 2)["motion"]
    for name in ("Y1", "Y2"):
        np.testing.assert_allclose(np.interp(fine["t"], coarse["t"], coarse[name]), fine[name], atol=1e-9)


def test_a_still_of_several_cycles_is_an_envelope_of_both_boxes(window):
    tables = animation.compute(*window, 2)
    for module, axes in enumerate(animation.draw(tables).axes, start=1):
        motion, highest, lowest = axes.lines
        X = tables["motion"].set_index("t")[f"X{module}"]
        assert len(motion.get_xdata()) == len(X)
        for cycle in (0, 1):
            seen = X.loc[cycle : cycle + 1 - 1e-9]
            assert highest.get_ydata()[cycle] == pytest.approx(seen.max(), abs=1e-3)
            assert lowest.get_ydata()[cycle] == pytest.approx(seen.min(), abs=1e-3)
    assert len(animation.draw(animation.compute(*window, 1)).axes) == animation.INSTANTS


def test_more_cycles_than_the_window_has_are_refused(window):
    with pytest.raises(ValueError, match="cycles: 4"):
        animation.compute(*window, 4)


def test_the_still_shows_instants_of_one_cycle(window):
    figure = animation.draw(animation.compute(*window, 1))
    texts = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert texts == [f"t = {n / animation.INSTANTS:.2f} T" for n in range(animation.INSTANTS)]


def test_a_nudged_motion_leaves_with_the_multiplier_and_ends_lopsided():
    system = vi.System(**SYSTEM, f20_hat=1.0)
    tables = nudge.compute(system)
    orbit = min(
        (one for one in vi.orbits(system) if one.symmetric), key=lambda one: np.abs(one.C - [1.0957, 1.8108]).max()
    )
    assert tables["orbit"].to_numpy().tolist() == [["c", pytest.approx(abs(orbit.multipliers[0]))]]
    growth = np.diff(np.log(tables["distance"]["distance"]))
    assert tables["distance"]["distance"][0] == pytest.approx(nudge.PUSH, rel=1e-6)
    np.testing.assert_allclose(growth[3:11], np.log(2.43617), atol=0.01)
    lengths = tables["flights"]["length"].to_numpy()
    np.testing.assert_allclose(lengths[:12], 0.5, atol=1e-3)
    assert (np.abs(lengths[-40:] - 0.5) > 0.05).all()
    texts = [text.get_text() for text in nudge.draw(tables).axes[0].texts]
    assert texts == ["times 2.44\nper period"]


def test_where_no_motion_that_is_called_stable_is_unstable_there_is_nothing_to_nudge():
    tables = nudge.compute(vi.System(**SYSTEM | {"f10_hat": 0.5}, f20_hat=0.5))
    assert all(len(table) == 0 for table in tables.values())
    assert len(nudge.draw(tables).axes) == 2


@pytest.fixture(scope="module")
def swept():
    return force_sweep.compute(vi.System(**SYSTEM, f20_hat=1.0), (0.6, 1.3), 71, 2.5)


def test_travelling_points_are_all_points_and_on_the_manifold(swept):
    points = swept["csv"]
    for value, count in ((0.6, 1), (0.89, 3), (1.0, 3)):
        assert (points["value"] == value).sum() == count
    for module in (1, 2):
        np.testing.assert_allclose(points[f"B{module}"], B_of_C(points[f"C{module}"].to_numpy(), rho(0.65)), rtol=1e-12)


def test_a_track_moves_without_jumps_and_keeps_to_one_point(swept):
    """Away from the fold at 0.69778, where two points appear and move with the square root."""
    points = swept["csv"]
    points = points[points["value"] > 0.72]
    assert points["track"].nunique() == 3
    for _, track in points.groupby("track"):
        assert track["value"].is_unique
        steps = np.abs(np.diff(track[["C1", "C2"]].to_numpy(), axis=0))
        assert steps.max() < 0.06


def test_the_asymmetric_orbits_are_followed_to_where_they_lose_their_stability(swept):
    """At 0.817, a Neimark-Sacker bifurcation: there a pair leaves the unit circle. At 1 they are those of a search."""
    pair = swept["orbits"].query("track == @force_sweep.PAIR")
    modulus = np.hypot(pair["real"], pair["imag"]).groupby(pair["value"]).max()
    assert modulus.index.tolist() == swept["csv"]["value"].unique().tolist()
    assert ((modulus < 1) == (modulus.index > 0.817)).all()
    crossing = pair[(pair["value"] == 0.81) & (np.hypot(pair["real"], pair["imag"]) > 1)]
    assert (crossing["imag"].abs() > 0.1).tolist() == [True, True]
    system = vi.System(**SYSTEM, f20_hat=1.0)
    stable = [orbit for orbit in orbits(system) if orbit.admissible and abs(orbit.multipliers[0]) < 1]
    (found,) = pair.query("value == 1")[["C1", "C2"]].drop_duplicates().to_numpy()
    for orbit in stable:
        np.testing.assert_allclose(found, orbit.C, atol=1e-10)
    assert len(stable) == 2


def test_multipliers_of_the_orbits_of_the_points_decide_on_their_verdict(swept):
    rows = swept["orbits"].query("track != @force_sweep.PAIR")
    modulus = np.hypot(rows["real"], rows["imag"]).groupby([rows["value"], rows["track"]]).max()
    verdicts = swept["csv"].set_index(["value", "track"])["exact"]
    assert ((modulus < 1) == (verdicts[modulus.index] == "stable")).all()


def test_a_point_that_is_new_starts_a_track_of_its_own():
    names, count = force_sweep._continued(
        [1, 2], np.array([[0.0, 0.0], [1.0, 1.0]]), np.array([[1.1, 1.0], [5.0, 5.0], [0, 0]]), 2
    )
    assert (names, count) == ([2, 3, 1], 3)


def test_the_picture_of_the_travel_names_every_curve_once_and_with_its_own_letter(swept):
    figure = force_sweep.draw(swept)
    points = swept["csv"]
    for axes in figure.axes:
        shown = [text.get_text() for text in axes.texts]
        assert sorted(shown) == ["a", "b", "c"]
    assert points["track"].nunique() == 3
    (key,) = figure.legends
    assert {f"fixed point {letter}" for letter in "abc"} <= {text.get_text() for text in key.get_texts()}
