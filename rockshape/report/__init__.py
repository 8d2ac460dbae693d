"""Overlay picture and HTML page of a measurement."""
