"""Read and validate the config of the pipeline before any job runs."""

from vibroimpact_pipeline.config.reading import ConfigError, checked, merged, read

__all__ = ["ConfigError", "checked", "merged", "read"]
