"""Load the rules of the workflow for a config in this process, and compare them with the SPECs of figures."""

from pathlib import Path

import yaml
from snakemake.api import SnakemakeApi
from snakemake.settings.types import ConfigSettings, ResourceSettings

from configs import GOOD
from pipeline_trees import ROOT
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.specs import columns, each, specs

SPECS = specs()
DATA = yaml.safe_load((ROOT / "report/data.yaml").read_text(encoding="utf-8"))


def rules(folder: Path, config: dict | None = None) -> dict:
    """Return the rules for a config by name."""
    given = folder / "config.yaml"
    given.write_text(yaml.safe_dump(config or GOOD), encoding="utf-8")
    settings = ConfigSettings(configfiles=[given], replace_workflow_config=True)
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


def published(folder: str) -> list[tuple[str, str]]:
    """Return figure and file name for each table in a reference set."""
    return [(name, file) for name in drawn(folder) for file, _ in compared_files(name, SPECS[name]).values()]


def made(found: dict, target: str) -> set[str]:
    """Return the figures on which a target depends."""
    return {Path(path).stem for path in found[target].input if path.endswith(".png")}


def assert_declared(folder: str, figure: str, file: str) -> None:
    """Check that the SPEC declares exactly the columns of a published table, and only series that the table has."""
    (name,) = (name for name, (kept_as, _) in compared_files(figure, SPECS[figure]).items() if kept_as == file)
    table, declared = read(ROOT / folder / file), columns(SPECS[figure]["tables"][name], each(DATA["shared"]))
    assert list(table) == list(declared)
    words = set(table.select_dtypes(exclude="number").iloc[:, :2].to_numpy().ravel())  # that name a series
    for entry in declared.values():
        assert not isinstance(kinds := entry.get("compared"), dict) or set(kinds) - {"others"} <= words


def without(*place: str) -> dict:
    """Return the config without an entry."""
    config = yaml.safe_load(yaml.safe_dump(GOOD))
    section = config
    for key in place[:-1]:
        section = section[key]
    del section[place[-1]]
    return config
