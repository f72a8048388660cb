"""Files of the checkout and all results of the default build -> one archive to cite and to run elsewhere."""

from datetime import datetime
from pathlib import Path

import yaml

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.archive import codecheck, tarball
from vibroimpact_pipeline.archive.checkout_state import state
from vibroimpact_pipeline.archive.citation import citation
from vibroimpact_pipeline.archive.content import content
from vibroimpact_pipeline.archive.crate import METADATA, crate
from vibroimpact_pipeline.archive.descriptions import Descriptions
from vibroimpact_pipeline.archive.figures import check_environment, figures
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.data_dictionary import DATA


def main(root: Path, results: list[str], texts: dict[str, dict], output) -> None:
    """Write the archive.

    Args:
        root: the checkout, in which the build works.
        results: those of the default build, paths from the root.
        texts: what is said of each figure.
        output: the archive.
    """
    sources, cited, made = state(root), citation(root), figures(results)
    check_environment(made, root)
    members = content(root, sources.files, results)
    members[codecheck.CODECHECK] = codecheck.page(made, texts, cited).encode()
    said = Descriptions(texts, yaml.safe_load((root / DATA).read_text(encoding="utf-8")))
    members[METADATA] = crate(members, sources, cited, made, said)
    folder, time = Path(output).name.removesuffix(".tar.gz"), int(datetime.fromisoformat(sources.date).timestamp())
    with replacing(output) as partial:
        tarball.write(partial, folder, members, time)
    print(f"{output}: {len(members)} files of commit {sources.commit}")
    for name in sources.modified:
        print(f"{name}: not as committed")
    for name in sources.unknown:
        print(f"{name}: left out, since git does not know it")


if "snakemake" in globals():
    with running(snakemake):
        main(root_of(snakemake), sorted(set(snakemake.input)), snakemake.params.texts, snakemake.output[0])
