"""Pipeline around the library: config, records of results, provenance, figure check, report and archive."""

import gc

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.environment import set_environment

set_environment(ROOT)
# With the default threshold, garbage collection takes a fifth of the import time.
gc.set_threshold(100_000, 50, 50)
