"""Training of the network that finds rocks in photographs, from made pictures alone."""
