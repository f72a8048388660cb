"""The report: pages from results, one site and one PDF."""
