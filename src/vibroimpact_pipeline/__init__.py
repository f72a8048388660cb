"""What only the pipeline needs: config, fingerprints of sources, provenance, figure check, report."""

import os

from vibroimpact_pipeline.checkout import ROOT, cache_of

# Before any command of this package imports Matplotlib, which would write into the home directory.
os.environ.setdefault("MPLCONFIGDIR", str(cache_of(ROOT) / "matplotlib"))
