"""Garden comparison: the paper's tables 4 and 5."""
