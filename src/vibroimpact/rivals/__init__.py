"""Other integrators behind one small protocol."""
