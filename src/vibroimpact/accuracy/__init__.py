"""Reference solutions, and what each method achieves against them."""
