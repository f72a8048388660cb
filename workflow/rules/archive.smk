# Archive a build with all sources in one citable file, to repeat the build elsewhere.

import tomllib

from vibroimpact_pipeline.git import GitRefused, git

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
    script:
        "../scripts/archive.py"
