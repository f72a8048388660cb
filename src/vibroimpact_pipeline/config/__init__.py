"""The config of the pipeline: config/config.yaml, read, checked before anything runs, and described.

One section per file; limits and conditions stand beside the fields they are about. The rules are handed the plain
values, as they stand in the file.
"""

from vibroimpact_pipeline.config.check import case_parameters, checked, complaints, problems
from vibroimpact_pipeline.config.overrides import combined, typed
from vibroimpact_pipeline.config.text import parse, read

__all__ = ["case_parameters", "checked", "combined", "complaints", "parse", "problems", "read", "typed"]
