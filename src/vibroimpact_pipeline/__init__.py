"""What only the pipeline needs: config, fingerprints of sources, provenance, figure check, report."""
