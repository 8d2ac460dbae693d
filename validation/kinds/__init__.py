"""Kinds of experiments, a folder each, found by their `KIND`; nothing else names them."""
