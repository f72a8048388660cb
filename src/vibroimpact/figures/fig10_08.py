"""Figure 10.8: the simulated motion of the second module."""

from vibroimpact.figures.plotting.simulated import compute, draw

SPEC = {
    "title": "Simulated steady state for equal forces",
    "notebook": "simulation",
    "caption": r"Fig. 10.8. Simulated steady state for :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = "
        "{f20_hat}`: a, displacement of the second box; b, relative displacement of its ball.",
    "alt": "Two panels over some forcing periods: a, the displacement X2 of the second box, close to a sine; b, the "
        "relative displacement W2 of its ball, which swings from wall to wall with a corner at each impact.",
    "own": {
        "title": "Simulated motion of case {case}",
        "caption": r"Simulated motion of case *{case}*, :math:`\hat f_{10} = {f10_hat}`, :math:`\hat f_{20} = "
            "{f20_hat}`: a, displacement of the second box; b, relative displacement of its ball.",
        "alt": "Two panels over the window of the simulation of case {case}: a, the displacement X2 of the second box; "
            "b, the relative displacement W2 of its ball between the walls, with a corner at each impact.",
    },
    "equations": [r"W_i^{\prime +} = -\kappa\,W_i^{\prime -}, \qquad X_i^{\prime +} + \varepsilon Y_i^{\prime +} = "
        r"X_i^{\prime -} + \varepsilon Y_i^{\prime -}"],
    "method": "simulated motion of the second module, with a corner at each event",
    "columns": {
        "panel": {"values": ["a", "b"]}, "series": {"values": ["X_2", "W_2"]}, "tau": {"compared": "trajectory"},
        "cycle": {"meaning": r"time in forcing periods, $\tau/T$", "unit": "forcing periods", "compared": "trajectory"},
        "value": {"meaning": "$X_2$ or $W_2 = X_2 - Y_2$, named in `series`; the points include the events of module 2",
            "unit": "dimensionless", "compared": "trajectory"},
    },
}  # fmt: skip

__all__ = ["compute", "draw"]
