"""Inputs of a measurement: observations of arrays and of files."""
