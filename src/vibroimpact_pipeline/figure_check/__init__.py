"""Figure check: compare the tables and pictures of a build with the reference set."""
