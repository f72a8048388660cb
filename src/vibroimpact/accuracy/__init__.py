"""Reference solutions, and error and cost of each method against them."""
