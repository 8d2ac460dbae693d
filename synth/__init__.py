"""Rocks of exactly known shape, seen by a known camera, with their truth."""
