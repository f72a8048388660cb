"""Two sectors of the chain of Weidemann et al.: their program in Octave and exact responses -> CSV; proofs -> JSON."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.studies.field import responses

with running(snakemake) as out:
    folder = os.environ.get("CC_PROGRAM", "")
    if not Path(folder, "analytics/AllSectorsFRS.m").is_file():
        sys.exit(f"CC_PROGRAM: {folder or 'nothing'} is not the folder of the program github.com/tobiaswdm/CC.")
    if not shutil.which("octave"):
        sys.exit("octave: not installed. It is a package of most systems, for example of Debian.")
    command = ["octave", "--no-gui", "--quiet", "--norc", snakemake.params.octave, folder, out.program]
    subprocess.run(command, check=True)
    rows = [row for r in pd.read_csv(out.program)["r"].unique().tolist() for row in responses(r)]
    tables.write(pd.DataFrame(rows).drop(columns=["enclosures", "state", "system"]), out.exact)
    Path(out.evidence).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
