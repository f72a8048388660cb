"""How the inner loops are compiled: cached on disk, without the interpreter's lock and its checks of division,
product and sum rounded as one where the processor can (no sum is reordered).

What runs at every event is inlined: handing over a motion and its Taylor polynomials (some 30 numbers) would cost more
than what is computed from them. What runs rarely is not, so that it does not get in the way.
"""

from vibroimpact.exact.engine.code_cache import kept

compiled = kept(error_model="numpy", nogil=True, fastmath={"contract"})
inlined = kept(error_model="numpy", nogil=True, fastmath={"contract"}, forceinline=True)
literal = kept(error_model="numpy", nogil=True, forceinline=True)
"""Inlined, every operation rounded as it is written: for sums that catch their own rounding."""
