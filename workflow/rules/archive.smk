# One file to cite and to run elsewhere.

import tomllib
from types import SimpleNamespace

from vibroimpact_pipeline.git import GitRefused, git
from vibroimpact_pipeline.result_records import is_result


def made_with_now(name, wildcards):
    """Params and inputs of a rule; those of the inputs that are results."""
    if not hasattr(rules, name):
        raise LookupError(name)
    made_by, given = getattr(rules, name), SimpleNamespace(**wildcards)
    params = {key: value(given) if callable(value) else value for key, value in made_by.params.items()}
    return params, [path for path in expand(made_by.input, **wildcards) if is_result(path)]


def results_of_a_commit(wildcards):
    """Results of both builds; refused, before anything is built, where they would not be those of the commit."""
    from vibroimpact_pipeline.archive import differences, made_otherwise
    from vibroimpact_pipeline.config import checked, merged, read

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(merged([(file, read(ROOT / file)) for file in COMMITTED_CONFIG]))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(
            f"archive: {place} is {here}, in {' and '.join(COMMITTED_CONFIG)} {there}. Build without another config."
        )
    targets = [*rules.all.input, *(rules.studies.input if STUDIES else ())]
    if others := list(made_otherwise(targets, made_with_now)):
        more = f" ({len(others) - 1} more)" if others[1:] else ""
        refuse(f"archive: {others[0]}{more}. Build first: make figures{' studies' if STUDIES else ''}")
    return targets


COMMITTED_CONFIG = [f"config/{name}.yaml" for name in ("config", "studies")[: 1 + STUDIES]]
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
try:
    COMMIT = git("rev-parse", "--short=12", "HEAD", root=ROOT)
except GitRefused:
    COMMIT = None


rule archive:
    input:
        results_of_a_commit,
    output:
        archive=f"results/archive/vibroimpact-{VERSION}-{COMMIT}.tar.gz",
    params:
        code=code("archive", "development.lock"),
    log:
        "results/logs/archive.log",
    benchmark:
        "results/benchmarks/archive.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/archive.py"
