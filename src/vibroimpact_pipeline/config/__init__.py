"""The config of the pipeline, config/config.yaml: read and checked before anything runs.

Limits and conditions stand beside the fields they are about. The rules get plain values.
"""

from vibroimpact_pipeline.config.reading import ConfigError, checked, merged, read

__all__ = ["ConfigError", "checked", "merged", "read"]
