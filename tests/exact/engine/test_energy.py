"""In the energy balance of a run, work equals dissipation, impact losses and change of stored energy."""

import numpy as np

import vibroimpact as vi
from hard_starts import example
from stored_energy import stored_energy
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import IMPACT

PARTS = ("ground", "coupling", "impacts", "stored")
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(24)


def total(energies, name):
    """Return a field of energies (n,) for both modules together."""
    return energies[name].reshape(len(energies), -1).sum(axis=1)


def scale(run):
    """Return the largest energy in the sums over a run; the parts of a stiff coupling almost cancel."""
    system, states = run.system, np.vstack([run.start, *run.events["state"], run.final])
    places, speeds = np.abs(states[:, [0, 2]]).max(), np.abs(states[:, [4, 6]]).max()
    spent = np.abs(run.energy.work).sum() + stored_energy(system, states).max()
    return spent + system.alpha12 * places**2 + system.gamma12 * speeds**2 * run.cycles * system.period


def test_the_energy_balance_closes_to_rounding_in_every_cycle():
    kinds = np.zeros(3, int)
    for number in range(200):
        system, start, tau0 = example(number)
        system = system.with_(epsilon=1e-7) if number % 10 == 0 else system
        run = vi.simulate(system, start, 3, tau0)
        energy, rows = run.energy, run.energy.per_cycle
        kinds += np.bincount(run.events["kind"], minlength=3)
        assert abs(energy.residual) <= 1e-13 * scale(run), number
        residuals = total(rows, "work") - sum(total(rows, name) for name in PARTS)
        assert np.abs(residuals).max() <= 1e-13 * scale(run), number
        assert min(*energy.ground, energy.coupling, *energy.impacts) >= 0, number
    assert (kinds > 500).all()


def test_parts_of_the_balance_equal_quadrature_of_the_reference_in_every_cycle():
    """Gauss's rule applies to reference samples in every flight of a run with chatter, sticking and release."""
    system = vi.System(
        epsilon=0.25, kappa=0.3, alpha12_hat=1.0, gamma1_hat=0.5, gamma2_hat=0.25, gamma12_hat=1.0, sigma20_hat=0.5,
        sigma_e_hat=0.5, f10_hat=1.5, f20_hat=-0.75,
    )  # fmt: skip
    cycles, start = 6, [0.5, 0.25, 0.25, 0.0, 0.0, 0.5, 0.0, -0.25]
    ends = system.period * np.arange(cycles + 1)
    events = reference_run(system, start, cycles, 40).events
    assert set(events["kind"]) == set(vi.KINDS)
    cuts = np.unique([*ends, *events["tau"]])
    cuts = cuts[np.diff(cuts, append=np.inf) > 1e-13]
    half = np.diff(cuts)[:, None] / 2
    times, weights = cuts[:-1, None] + half * (1 + POINTS), half * WEIGHTS
    sampled = np.unique([*times.ravel(), *ends[:-1]])
    samples = reference_run(system, start, cycles, 40, sample_times=sampled).samples
    speeds = samples[np.searchsorted(sampled, times)][..., [4, 6]]
    cycle = np.searchsorted(ends, cuts[:-1], side="right") - 1

    def over_cycles(values, owner=cycle):
        return np.bincount(owner, values, minlength=cycles)

    force, damping = np.sin(system.Omega * times), (system.gamma1, system.gamma2)
    run = vi.simulate(system, start, cycles)
    rows = run.energy.per_cycle
    stored = stored_energy(system, np.vstack([samples[np.searchsorted(sampled, ends[:-1])], run.final]))
    expected = {"stored": np.diff(stored)}
    expected["coupling"] = over_cycles((weights * system.gamma12 * (speeds[..., 0] - speeds[..., 1]) ** 2).sum(axis=1))
    for i in range(2):
        hits = events[(events["kind"] == IMPACT) & (events["module"] == i + 1)]
        rebound = hits["state"][:, 4 + 2 * i] - hits["state"][:, 5 + 2 * i]
        lost = 0.5 * system.epsilon / (1 + system.epsilon) * (system.kappa**-2 - 1) * rebound**2
        expected["impacts", i] = over_cycles(lost, np.searchsorted(ends, hits["tau"], side="right") - 1)
        expected["work", i] = over_cycles((weights * system.forcing[i] * force * speeds[..., i]).sum(axis=1))
        expected["ground", i] = over_cycles((weights * damping[i] * speeds[..., i] ** 2).sum(axis=1))
    for key, values in expected.items():
        name, place = (key, ()) if isinstance(key, str) else (key[0], key[1:])
        np.testing.assert_allclose(rows[name][:, *place], values, rtol=1e-11, atol=1e-13, err_msg=str(key))
        np.testing.assert_allclose(np.asarray(getattr(run.energy, name))[place], values.sum(), atol=1e-12)


def test_an_impact_at_the_start_of_a_run_of_no_length_counts(case):
    """The loss of the impact equals the decrease of the stored energy."""
    energy = vi.simulate(case, [1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0], 0).energy
    lost = 0.5 * case.epsilon / (1 + case.epsilon) * (1 - case.kappa**2) * 4.0
    np.testing.assert_allclose([energy.impacts[0], energy.stored], [lost, -lost], rtol=1e-12)
    assert energy.per_cycle.shape == (0,)
    assert not energy.work.any()
