"""Segmentation by range: height above the ground in units of its noise, split into rocks."""
