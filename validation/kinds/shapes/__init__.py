"""Shape experiments: drawn series of known outlines."""
