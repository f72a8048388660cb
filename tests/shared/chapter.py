"""Numbers printed in section 10.4; `tests/pipeline/test_cases.py` compares the config with them."""

import vibroimpact as vi

PARAMETERS = {
    "epsilon": 0.1,
    "kappa": 0.65,
    "alpha12_hat": 1.0,
    "gamma1_hat": 0.2,
    "gamma2_hat": 0.2,
    "gamma12_hat": 0.2,
    "sigma20_hat": 0.5,
    "sigma_e_hat": 0.2,
}
FORCES = {"equal": (1.0, 1.0), "unequal": (1.0, 0.89), "weak": (0.5, 0.5)}


def system_of(case, **changes):
    """Return the system of a case of the chapter, with changes of its parameters."""
    f10_hat, f20_hat = FORCES[case]
    return vi.System(**PARAMETERS | {"f10_hat": f10_hat, "f20_hat": f20_hat} | changes)
