"""The pipeline around the library: config, records of results, provenance, figure check, report, archive."""

from vibroimpact_pipeline.code import INSTALLED, ROOT
from vibroimpact_pipeline.environment import set_environment

set_environment(None if INSTALLED else ROOT)
