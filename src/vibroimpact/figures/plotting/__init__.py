"""Style, tables, shared drawings and files of all figures."""
