"""The figures against their reference set: numbers, artists, pictures."""
