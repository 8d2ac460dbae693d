"""Outlines of rocks: tracing, resampling, diameters, descriptors and Wadell roundness."""
