"""Build the report, a website and a PDF, from results."""
