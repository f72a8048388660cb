"""Parameters of section 10.4: PARAMETERS are common to all cases, CASES contains the forces of each case."""

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
CASES = {
    "equal": {"f10_hat": 1.0, "f20_hat": 1.0},
    "unequal": {"f10_hat": 1.0, "f20_hat": 0.89},
    "weak": {"f10_hat": 0.5, "f20_hat": 0.5},
}
