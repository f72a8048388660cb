"""The command line: the commands and their tables, the pictures beside them, the parser."""
