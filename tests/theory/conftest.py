"""Property-based tests run the same examples everywhere and are not timed: a loaded machine is no failure."""

from hypothesis import settings

settings.register_profile("reproducible", deadline=None, derandomize=True)
settings.load_profile("reproducible")
