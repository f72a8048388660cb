"""Studies in one call, as `import vibroimpact` offers them."""
