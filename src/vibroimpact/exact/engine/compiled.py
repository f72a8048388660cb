"""How the inner loops are compiled: cached on disk, without the interpreter's lock and its checks of division,
product and sum rounded as one where the processor can (no sum is reordered).

What runs at every event becomes part of the loop: handing over a motion and its Taylor polynomials (some 30 numbers)
would cost more than what is computed from them. What is called from one place is mostly put there before anything is
compiled (`unfolded`), which spares compiling it twice; the rest is compiled once and then inlined. Each
says whether it is inlined, since Numba takes what is left open from the caller that happens to be compiled first.
"""

from functools import partial

from vibroimpact.exact.engine.code_cache import kept

_alike = partial(kept, error_model="numpy", nogil=True, no_cfunc_wrapper=True)
_counts_nothing = partial(_alike, _nrt=False)
compiled = _alike(fastmath={"contract"}, forceinline=False)
loop = _counts_nothing(fastmath={"contract"}, forceinline=False, no_cpython_wrapper=True)
inlined = _counts_nothing(fastmath={"contract"}, forceinline=True)
unfolded = _counts_nothing(fastmath={"contract"}, forceinline=True, inline="always")
literal = _counts_nothing(forceinline=True)
"""Inlined, every operation rounded as it is written: for sums that catch their own rounding."""
