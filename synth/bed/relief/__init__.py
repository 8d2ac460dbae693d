"""Relief of beds: bodies of grains, ground, and grains packed on it."""
