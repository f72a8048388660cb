# One file to cite and to run elsewhere.

import tomllib

from vibroimpact_pipeline.git import git


def results_of_a_commit(wildcards):
    """Return the results of both builds; refuse a changed checkout before anything is built."""
    try:
        committed(ROOT)
    except ValueError as error:
        refuse(str(error))
    return [*rules.all.input, *(rules.studies.input if STUDIES else ())]


VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
COMMIT = git("rev-parse", "--short=12", "HEAD", root=ROOT)


rule archive:
    input:
        results_of_a_commit,
    output:
        archive=f"results/archive/vibroimpact-{VERSION}-{COMMIT}.tar.gz",
    params:
        code=code("archive"),
    log:
        "results/logs/archive.log",
    benchmark:
        "results/benchmarks/archive.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/archive.py"
