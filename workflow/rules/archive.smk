# One file to cite and to run elsewhere.

import tomllib

from vibroimpact_pipeline.git import GitRefused, committed, git

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
try:
    COMMIT = git("rev-parse", "--short=12", "HEAD", root=ROOT)
except GitRefused:
    COMMIT = None


def made_with_now(name, wildcards):
    """Params and inputs of a rule; those of the inputs that are results."""
    if not hasattr(rules, name):
        raise LookupError(name)
    made_by, given = getattr(rules, name), SimpleNamespace(**wildcards)
    params = {key: value(given) if callable(value) else value for key, value in made_by.params.items()}
    return params, [path for path in expand(made_by.input, **wildcards) if is_result(path)]


def results_of_a_commit(wildcards):
    """Results of the default build; refused, before anything is built, where they would not be those of the commit."""
    from vibroimpact_pipeline.archive import differences, made_otherwise
    from vibroimpact_pipeline.config import checked, read

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(read(ROOT / "config/config.yaml"))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(f"archive: {place} is {here}, in config/config.yaml {there}. Build without another config.")
    if others := list(made_otherwise(rules.all.input, made_with_now)):
        more = f" ({len(others) - 1} more)" if others[1:] else ""
        refuse(f"archive: {others[0]}{more}. Build first: snakemake --cores {workflow.resource_settings.cores or 1}")
    return rules.all.input


rule archive:
    input:
        results_of_a_commit,
    output:
        archive=f"results/archive/vibroimpact-{VERSION}-{COMMIT}.tar.gz",
    params:
        code=PIPELINE,
    log:
        "results/logs/archive.log",
    benchmark:
        "results/benchmarks/archive.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/archive.py"
