"""The command line: one sub-command per file, each with its options and the table it computes; plots beside them."""
