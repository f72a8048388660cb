"""Read and validate the config of the pipeline, config/config.yaml, before any job runs.

Each field declares its limits and conditions. The rules receive plain values.
"""

from vibroimpact_pipeline.config.reading import ConfigError, checked, merged, read

__all__ = ["ConfigError", "checked", "merged", "read"]
