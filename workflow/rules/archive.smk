# One file to cite and to run elsewhere: the checkout with the results of the default build, described as an RO-Crate.

import tomllib

from vibroimpact_pipeline.archive.obstacles import obstacles
from vibroimpact_pipeline.git import git

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
COMMIT = git("rev-parse", "--short=12", "HEAD", root=ROOT) or "no-commit"


def archived(wildcards):
    """All results of the default build; asked for only where an archive is to be made."""
    overrides = [str(file) for file in CONFIG_FILES if file != CONFIG_FILE]
    overrides += ["--config"] * bool(workflow.config_settings.config)
    if found := obstacles(ROOT, Path.cwd(), overrides):
        refuse(found)
    return rules.all.input


# Made anew each time it is asked for: Snakemake does not know all that goes in.
rule archive:
    input:
        archived,
    output:
        f"results/archive/vibroimpact-{VERSION}-{COMMIT}.tar.gz",
    params:
        texts=config["figure_texts"],
        asked=time.time_ns(),
        code=code("workflow/scripts/archive.py"),
    log:
        "results/logs/archive.log",
    benchmark:
        "results/benchmarks/archive.tsv"
    script:
        "../scripts/archive.py"
