"""The config of the pipeline: config/config.yaml, read and checked before anything runs.

One section per file; limits and conditions stand beside the fields they are about. The rules get plain values.
"""

from vibroimpact_pipeline.config.check import case_parameters, checked, with_key
from vibroimpact_pipeline.config.reading import ConfigError, read

__all__ = ["ConfigError", "case_parameters", "checked", "read", "with_key"]
