"""What the animations show: the frames of a simulated motion."""

import numpy as np
import pytest

import vibroimpact as vi
from figure_tables import system_of, tables_of_run
from vibroimpact.studies.figures import animation, nudge

EQUAL = system_of("equal")


@pytest.fixture(scope="module")
def window():
    """Samples and events of three cycles, with the system."""
    return *tables_of_run(EQUAL, [0.0] * 8, 60, 3, 40), EQUAL


def test_frames_have_every_corner_of_the_motion_and_stills_its_envelope(window):
    tables = animation.compute(*window, 2)
    motion, impacts = tables["motion"], tables["impacts"]
    assert motion["t"].is_monotonic_increasing
    assert (motion["t"].iloc[0], motion["t"].iloc[-1]) == pytest.approx((0.0, 2.0), abs=1e-9)
    assert len(impacts) == 8  # two per cycle and module
    for hit in impacts.itertuples():
        at_impact = np.interp(hit.t, motion["t"], motion[f"X{hit.module}"] - motion[f"Y{hit.module}"])
        assert at_impact == pytest.approx(hit.wall, abs=1e-9)
    for module, axes in enumerate(animation.draw(tables).axes, start=1):
        seen = motion[motion["t"] < 1 - 1e-9][f"X{module}"].agg(["max", "min"])
        assert [line.get_ydata()[0] for line in axes.lines[1:]] == pytest.approx(seen.tolist(), abs=1e-3)
    assert len(animation.draw(animation.compute(*window, 1)).axes) == animation.INSTANTS


def test_between_frames_the_ball_flies_straight(window):
    """Y moves uniformly between impacts, so that the frames follow it exactly, whatever their distance."""
    samples, events, system = window
    fine = animation.compute(samples, events, system, 2)["motion"]
    coarse = animation.compute(samples.iloc[::20], events, system, 2)["motion"]
    for name in ("Y1", "Y2"):
        np.testing.assert_allclose(np.interp(fine["t"], coarse["t"], coarse[name]), fine[name], atol=1e-9)


def test_more_cycles_than_the_window_has_are_refused(window):
    with pytest.raises(ValueError, match="cycles: 4"):
        animation.compute(*window, 4)


def test_a_nudged_motion_leaves_with_the_multiplier_and_ends_lopsided():
    tables = nudge.compute(EQUAL)
    orbit = min(
        (one for one in vi.orbits(EQUAL) if one.symmetric), key=lambda one: np.abs(one.C - [1.0957, 1.8108]).max()
    )
    assert tables["orbit"].to_numpy().tolist() == [["c", pytest.approx(abs(orbit.multipliers[0]))]]
    growth = np.diff(np.log(tables["distance"]["distance"]))
    assert tables["distance"]["distance"][0] == pytest.approx(nudge.PERTURBATION, rel=1e-6)
    np.testing.assert_allclose(growth[3:11], np.log(2.43617), atol=0.01)
    lengths = tables["flights"]["length"].to_numpy()
    np.testing.assert_allclose(lengths[:12], 0.5, atol=1e-3)
    assert (np.abs(lengths[-40:] - 0.5) > 0.05).all()
    texts = [text.get_text() for text in nudge.draw(tables).axes[0].texts]
    assert texts == ["times 2.44\nper period"]


def test_where_no_motion_that_is_called_stable_is_unstable_there_is_nothing_to_nudge():
    tables = nudge.compute(EQUAL.with_(f10_hat=0.5, f20_hat=0.5))
    assert all(len(table) == 0 for table in tables.values())
    assert len(nudge.draw(tables).axes) == 2
