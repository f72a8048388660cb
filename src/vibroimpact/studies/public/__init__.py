"""Studies in one call, as they are available from `import vibroimpact`."""
