"""Kinds of experiments, a folder each."""
