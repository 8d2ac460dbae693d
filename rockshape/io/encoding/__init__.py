"""Encoding of masks for files that hold outlines."""
