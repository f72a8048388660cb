"""Sections of config/studies.yaml."""
