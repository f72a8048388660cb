"""Checks of inputs and outputs of the pipeline."""
