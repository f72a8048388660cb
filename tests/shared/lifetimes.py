"""A table of mean lives for tests of what is drawn from one."""

import numpy as np
import pandas as pd

LIFETIMES = pd.DataFrame(
    {
        "path": "f20_hat",
        "p": [0.90, 0.95, 0.96, 0.98],
        "starts": 48,
        "escapes": [0, 0, 9, 40],
        "cycles": [200000, 200000, 180000, 20000],
        "life": [np.nan, np.nan, 20000.0, 500.0],
        "uncertainty": [np.nan, np.nan, 6666.0, 80.0],
        "least": [66761.6, 66761.6, np.nan, np.nan],
    }
)
"""Mean lives along the path, made up."""
