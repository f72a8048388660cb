"""How the inner loops are compiled: cached on disk, without the interpreter's lock and its checks of division.

What a step of a run is computed by is rounded as it is written, so that the run has the same bits alone and in a lane
beside others (`lanes`). What is `compiled`, and unfolded into it, may round product and sum as one.

What runs at every event becomes part of the loop: handing over a motion and its Taylor polynomials (some 30 numbers)
would cost more than what is computed from them. What is called from one place is mostly put there before anything is
compiled (`unfolded`), which spares compiling it twice; the rest is compiled once and then inlined. Each says how it
rounds, whether it is inlined, and whether it counts, since Numba takes what is left open from the caller that is
compiled first.

Only what is `compiled` makes arrays or gives them back, and what is `unfolded` into it alone. All else works in memory
that is given, and counts no references to it: a count is a locked operation and a call, for which all numbers at hand
are put away.
"""

from functools import partial

from vibroimpact.exact.engine.code_cache import kept

_alike = partial(kept, error_model="numpy", nogil=True, no_cfunc_wrapper=True)
_given_memory = partial(_alike, _nrt=False, fastmath=False)
compiled = _alike(fastmath={"contract"}, forceinline=False, _nrt=True)
in_place = _given_memory(forceinline=False, no_cpython_wrapper=True)
inlined = _given_memory(forceinline=True)
unfolded = _given_memory(forceinline=True, inline="always")
