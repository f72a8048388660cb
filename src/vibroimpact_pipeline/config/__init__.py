"""Read and validate the config of the pipeline, config/config.yaml, before any job runs.

Each field of the models declares its limits and conditions. Rules receive the values as dictionaries and lists.
"""

from vibroimpact_pipeline.config.reading import ConfigError, checked, merged, read

__all__ = ["ConfigError", "checked", "merged", "read"]
