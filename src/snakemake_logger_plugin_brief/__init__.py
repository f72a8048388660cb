"""What a user sees of a build: a Snakemake logger plugin, found by its name and turned on by the profile.

Snakemake's own output goes to its log, .snakemake/log/, as ever.
"""

from snakemake_logger_plugin_brief.given import LogHandlerSettings
from snakemake_logger_plugin_brief.handler import LogHandler
from snakemake_logger_plugin_brief.user import settle

__all__ = ["LogHandler", "LogHandlerSettings"]

settle()  # Snakemake loads its plugins before all else that depends on the surroundings, whether or not it uses them
