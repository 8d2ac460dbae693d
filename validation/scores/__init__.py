"""Scores: definitions, statistics and intervals, shared by all kinds of experiments."""
