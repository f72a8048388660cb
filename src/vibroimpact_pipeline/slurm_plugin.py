"""Where the Slurm plugin of Snakemake (2.8.0) does not do what its options say."""


def heed_options(settings) -> None:
    """Keep the plugin from asking for accounts where it was told that there are none.

    It takes a scheduler that does not answer for one that soon forgets its jobs, turns to `sacct`, which without
    accounting fails each time, and does not turn back. And it looks for an account whatever `no_account` says.

    Args:
        settings: those of the executor plugin.
    """
    import snakemake_executor_plugin_slurm as plugin

    if settings.status_command == "squeue":
        available = plugin.is_query_tool_available
        plugin.is_query_tool_available = lambda tool: tool != "sacct" and available(tool)
    if settings.no_account:
        named = plugin.Executor.get_account_arg
        plugin.Executor.get_account_arg = lambda self, job: (
            named(self, job) if job.resources.get("slurm_account") else iter([""])
        )
