"""Find all fixed points of the slow flow: polynomials from the balance of harmonics, and their real zeros."""
