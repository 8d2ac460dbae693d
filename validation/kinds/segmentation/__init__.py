"""Segmentation held against true masks: variants and baselines on the same scenes."""
