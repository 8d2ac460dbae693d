"""Ellipse fits: direct least squares, an arc, and area moments."""
