"""Attacks on the certificate: `make attack` runs 20 000 of each, the suite a few (`--attack=N`)."""

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
    """One seed for each system attacked."""
    return range(-(-request.config.getoption("--attack") // PER_SYSTEM))


def test_no_told_miss_exceeds_the_true_one(seeds):
    """Nor is one told that was none: where it is less than the observer's, its grid skipped a turn."""
    finer = 0
    for seed in seeds[::2]:
        rng = np.random.default_rng([seed, 1])
        system = random_system(rng)
        observer = Observer(system)
        for _ in range(PER_SYSTEM):
            run = vi.simulate(system, random_start(rng), 5)
            told, seen = run.certificate.nearest_miss, observer.nearest_miss(run)
            assert told <= seen + 1e-10, (seed, run.start.tolist(), told, seen)
            finer += told < seen - 1e-7
    assert finer <= 1e-3 * PER_SYSTEM * len(seeds)


def test_no_decided_run_has_other_events_than_the_reference(seeds):
    """Runs that end, start or turn within 1e-7 of an event, or start nearly at rest on a wall."""
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
    ids=["random systems, stiff ones too", "kappa next to 1"],
)  # fmt: skip
def test_no_true_error_exceeds_the_promise(request, ratio, genes, per_attack, many):
    """With a hill climb from the worst of each 60 draws (of 12 in the suite)."""
    runs, ratios, seed = request.config.getoption("--attack"), [], 0
    (draws, steps), enough = ((60, 200), runs // per_attack) if runs > 1000 else ((12, 12), runs // (5 * per_attack))
    while len(ratios) < enough:
        ratios += climbed(np.random.default_rng([seed, 4]), draws, steps, partial(ratio, many=many), genes)
        seed += 1
    print(f"{len(ratios)} decided runs, worst ratio {max(ratios):.3g}, median {np.median(ratios):.3g}")
    assert max(ratios) < MAX_ERROR_RATIO


def test_random_hard_starts_finish_with_rows_that_follow_from_one_another(request):
    for number in range(max(request.config.getoption("--attack"), 120)):
        assert list(faults(number)) == [], number


@pytest.mark.parametrize("kind", ensembles)
def test_runs_of_an_ensemble_are_those_of_simulate(request, kind):
    """At least 60 of each kind of scene, in ensembles of up to a thousand."""
    number = max(request.config.getoption("--attack") // len(ensembles), 60)
    for first in range(0, number, 1000):
        drawn = ensembles[kind](np.random.default_rng([first + 3, len(kind)]), min(number - first, 1000))
        assert unlike_single_runs(*drawn) == [], (kind, first)
