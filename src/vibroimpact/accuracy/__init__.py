"""Reference solutions, and error and cost of each method relative to them."""
