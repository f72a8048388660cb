"""Stress tests of the certificate with random runs: 20 000 of each kind in `make attack`, few in the suite."""

from functools import partial

import numpy as np
import pytest

import one_box
import vibroimpact as vi
from attacks import (
    GENES,
    MAX_ERROR_RATIO,
    Observer,
    attacks,
    climbed,
    ensembles,
    error_ratio,
    random_start,
    random_system,
    same_events,
    truth,
    unlike_single_runs,
)
from hard_starts import faults
from vibroimpact.accuracy.reference.roots import Undecidable

PER_SYSTEM = 10


@pytest.fixture
def seeds(request):
    """Return one seed for each system."""
    return range(-(-request.config.getoption("--attack") // PER_SYSTEM))


def test_the_reported_nearest_miss_never_exceeds_the_true_one(seeds):
    """The observer's nearest miss is larger only if its grid skips a turn, which is rare."""
    smaller = 0
    for seed in seeds[::2]:
        rng = np.random.default_rng([seed, 1])
        system = random_system(rng)
        observer = Observer(system)
        for _ in range(PER_SYSTEM):
            run = vi.simulate(system, random_start(rng), 5)
            reported, observed = run.certificate.nearest_miss, observer.nearest_miss(run)
            assert reported <= observed + 1e-10, (seed, run.start.tolist(), reported, observed)
            smaller += reported < observed - 1e-7
    assert smaller <= 1e-3 * PER_SYSTEM * len(seeds)


def test_decided_runs_have_the_events_of_the_reference(seeds):
    """The runs end, start or turn within 1e-7 of an event, or start nearly at rest on a wall."""
    decided, worst = 0, 0.0
    for seed in seeds:
        for attack in attacks(np.random.default_rng([seed, 2]), PER_SYSTEM):
            run = vi.simulate(attack.system, attack.start, 1, attack.tau0)
            if not run.certificate.decided:
                continue
            try:
                reference = truth(attack)
            except Undecidable:
                reference = truth(attack, 120)
            decided += 1
            assert same_events(run.events, reference.events), (seed, attack)
            worst = max(worst, np.abs(run.final - reference.final).max() / run.certificate.error)
    assert decided > 5 * len(seeds)
    assert worst < MAX_ERROR_RATIO


@pytest.mark.parametrize("many", [False, True], ids=["single runs", "ensembles"])
@pytest.mark.parametrize(
    ("ratio", "genes", "per_attack"), [(error_ratio, GENES, 1), (one_box.error_ratio, one_box.GENES, 10)],
    ids=["random and stiff systems", "kappa next to 1"],
)  # fmt: skip
def test_the_true_error_is_below_the_promised_multiple_of_the_estimate(request, ratio, genes, per_attack, many):
    """A hill climb starts from the worst of each 60 random draws (12 in the suite)."""
    runs, ratios, seed = request.config.getoption("--attack"), [], 0
    (draws, steps), number = ((60, 200), runs // per_attack) if runs > 1000 else ((12, 12), runs // (5 * per_attack))
    while len(ratios) < number:
        ratios += climbed(np.random.default_rng([seed, 4]), draws, steps, partial(ratio, many=many), genes)
        seed += 1
    print(f"{len(ratios)} decided runs, worst ratio {max(ratios):.3g}, median {np.median(ratios):.3g}")
    assert max(ratios) < MAX_ERROR_RATIO


def test_random_hard_starts_finish_with_rows_that_agree_with_the_flow_between_them(request):
    for number in range(max(request.config.getoption("--attack"), 120)):
        assert list(faults(number)) == [], number


@pytest.mark.parametrize("kind", ensembles)
def test_ensembles_agree_with_single_runs(request, kind):
    """At least 60 runs of each kind, in ensembles of up to a thousand."""
    number = max(request.config.getoption("--attack") // len(ensembles), 60)
    for first in range(0, number, 1000):
        drawn = ensembles[kind](np.random.default_rng([first + 3, len(kind)]), min(number - first, 1000))
        assert unlike_single_runs(*drawn) == [], (kind, first)
