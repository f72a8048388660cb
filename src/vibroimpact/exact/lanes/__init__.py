"""Many runs at once, eight in the lanes of vector instructions; `ensemble.ensemble` is the entry point."""
