"""Segmentation by the image alone: star-shaped proposals, scored and selected."""
