"""Figures beyond the chapter."""
