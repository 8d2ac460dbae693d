"""Measured rocks as other programs take them: a layer of a map, a model in space."""
