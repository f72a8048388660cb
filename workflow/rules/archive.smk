# Archive of a build: one citable file with all sources, from which the build can be repeated elsewhere.

import tomllib

from vibroimpact_pipeline.git import GitRefused, committed, git

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
try:
    COMMIT = git("rev-parse", "--short=12", "HEAD", root=ROOT)
except GitRefused:
    COMMIT = None


def results_of_a_commit(wildcards):
    """Return the results of figures and studies; exit before any job runs unless checkout and config are committed."""
    from vibroimpact_pipeline.archive import differences

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(merged([(file, read(ROOT / file)) for file in CONFIG_FILES]))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(f"archive: {place} is {here}, but {there} in {' and '.join(CONFIG_FILES)}. Build without --config.")
    return [*rules.all.input, *(rules.studies.input if STUDIES else ())]


rule archive:
    input:
        results_of_a_commit,
    output:
        archive=f"results/archive/vibroimpact-{VERSION}-{COMMIT}.tar.gz",
    params:
        code=code("archive", "development.lock"),
    log:
        "results/logs/archive.log",
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/archive.py"
