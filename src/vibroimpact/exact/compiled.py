"""How the inner loops are compiled: cached on disk, without the interpreter's lock and its checks of division."""

from numba import njit

compiled = njit(cache=True, error_model="numpy", nogil=True)
