"""What the pipeline adds to sweeps: tiles as files, and the page."""
