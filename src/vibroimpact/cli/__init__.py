"""Command-line interface: the parser, the commands, and their tables and plots."""
