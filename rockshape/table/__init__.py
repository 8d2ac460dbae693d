"""Table of rocks as files have it: what its columns mean, and where it comes from."""
