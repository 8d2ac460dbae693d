"""Range of an image by its meaning: what is no measurement, units, and a point for each pixel."""
