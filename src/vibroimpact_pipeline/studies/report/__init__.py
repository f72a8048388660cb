"""Build the report from results: a website and a PDF."""
