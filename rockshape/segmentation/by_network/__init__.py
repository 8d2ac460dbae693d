"""Rocks found in a photograph by a small network that made pictures alone have taught."""
