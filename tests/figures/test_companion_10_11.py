"""The companion of figure 10.11: its gaps against flights judged one by one, and motions whose answer is known."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.figures import companion_10_11
from vibroimpact.figures.kit.tables import select

SYSTEM = vi.System(**PARAMETERS, **dict(zip(("f10_hat", "f20_hat"), FORCES["weak"], strict=True)))
START = [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5]


@pytest.fixture(scope="module")
def motion(run_of):
    return run_of(SYSTEM, START, 100, 60, 16)


def gaps_of(motion):
    return select(companion_10_11.compute(SYSTEM, *motion), "gaps", "gap")[["tau", "end"]].to_numpy()


def test_a_flight_is_outside_the_gaps_if_it_and_a_neighbour_are_resonant(motion):
    samples, events = motion  # events of the whole run, samples of its end
    hits = events[(events["module"] == 2) & (events["kind"] == "impact")]
    pairs = list(zip(hits["tau"], hits["tau"][1:], hits["wall"], hits["wall"][1:], strict=False))
    half = np.pi / SYSTEM.Omega
    resonant = [before != after and half / 2 <= end - start <= 1.5 * half for start, end, before, after in pairs]
    gaps = gaps_of(motion)
    assert 3 < len(gaps) < len(pairs)
    for place, (start, end, *_) in enumerate(pairs):
        if start < samples["tau"].iloc[0]:
            continue
        beside = resonant[max(place - 1, 0) : place] + resonant[place + 1 : place + 2]
        shaded = ((gaps[:, 0] <= start) & (end <= gaps[:, 1])).any()
        assert shaded == (not (resonant[place] and any(beside))), start
    assert (gaps[0, 0], gaps[-1, 1]) >= (samples["tau"].iloc[0], samples["tau"].iloc[-1])


@pytest.mark.parametrize(("flight", "gap"), [(0.5, None), (0.3, None), (0.8, (0.0, 10.0))])
def test_an_even_motion_is_resonant_throughout_or_never(flight, gap):
    """Wall to wall with flights of equal length, as a share of the period."""
    tau = np.arange(0.0, 10.0 + 1e-9, flight) * SYSTEM.period
    events = pd.DataFrame({"tau": tau, "module": 2, "wall": (-1.0) ** np.arange(len(tau)), "kind": "impact", "X2": 0.0})
    samples = pd.DataFrame({"tau": [0.0, 10 * SYSTEM.period], "X2": 0.0, "Y2": [-1.0, 1.0]})
    gaps = gaps_of((samples, events)) / SYSTEM.period
    np.testing.assert_allclose(gaps, np.reshape([] if gap is None else gap, (-1, 2)) if flight != 0.3 else [[9.9, 10]])


def test_gaps_are_shaded_in_both_panels_behind_the_motion_of_10_11(motion):
    table = companion_10_11.compute(SYSTEM, *motion)
    gaps = select(table, "gaps", "gap")
    for axes in companion_10_11.draw(table).axes:
        bands = [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in axes.patches]
        np.testing.assert_allclose(bands, gaps[["tau", "end"]])
        assert all(patch.get_zorder() < line.get_zorder() for patch in axes.patches for line in axes.lines)
