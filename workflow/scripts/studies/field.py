"""Compare two sectors of the chain of Weidemann et al.: results of their program, exact responses and proofs."""

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
        sys.exit(f"CC_PROGRAM: {folder or 'not set'}, expected the folder of the program github.com/tobiaswdm/CC")
    if not shutil.which("octave"):
        sys.exit("octave: not installed. Install Octave, for example with apt install octave.")
    command = ["octave", "--no-gui", "--quiet", "--norc", snakemake.params.octave, folder, out.program]
    subprocess.run(command, check=True)
    rows = [row for r in pd.read_csv(out.program)["r"].unique().tolist() for row in responses(r)]
    tables.write(pd.DataFrame(rows).drop(columns=["enclosures", "state", "system"]), out.exact)
    Path(out.evidence).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
