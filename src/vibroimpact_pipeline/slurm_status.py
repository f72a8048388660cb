"""How the Slurm plugin of Snakemake hears of its jobs where it is told to ask the scheduler, not the accounts."""


def ask_the_scheduler_alone(settings) -> None:
    """Keep the plugin from asking for accounts where the scheduler was named as the one to ask.

    Version 2.8.0 takes a scheduler that does not answer for one that soon forgets its jobs, turns to `sacct`, which
    without accounting fails each time, and does not turn back.

    Args:
        settings: those of the executor plugin.
    """
    if settings.status_command != "squeue":
        return
    import snakemake_executor_plugin_slurm as plugin

    available = plugin.is_query_tool_available
    plugin.is_query_tool_available = lambda tool: tool != "sacct" and available(tool)
