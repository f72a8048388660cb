"""Load the rules of the workflow for a config in this process, and compare them with the SPECs of figures."""

from pathlib import Path

import yaml
from snakemake.api import SnakemakeApi
from snakemake.settings.types import ConfigSettings, ResourceSettings

from configs import GOOD
from pipeline_trees import ROOT
from vibroimpact_pipeline.specs import specs

SPECS = specs()


def rules(folder: Path, config: dict | None = None) -> dict:
    """Return the rules for a config by name."""
    path = folder / "config.yaml"
    path.write_text(yaml.safe_dump(config or GOOD), encoding="utf-8")
    settings = ConfigSettings(configfiles=[path], replace_workflow_config=True)
    with SnakemakeApi() as api:
        workflow = api.workflow(
            resource_settings=ResourceSettings(cores=1),
            config_settings=settings,
            snakefile=ROOT / "Snakefile",
            workdir=folder,
        )
        return {rule.name: rule for rule in workflow._workflow.rules}


def drawn(folder: str) -> list[str]:
    """Return the names of the figures in a reference set."""
    return sorted(path.stem for path in (ROOT / folder).glob("*.png"))


def made(found: dict, target: str) -> set[str]:
    """Return the figures on which a target depends."""
    return {Path(path).stem for path in found[target].input if path.endswith(".png")}


def without(*place: str) -> dict:
    """Return the config without an entry."""
    config = yaml.safe_load(yaml.safe_dump(GOOD))
    section = config
    for key in place[:-1]:
        section = section[key]
    del section[place[-1]]
    return config
