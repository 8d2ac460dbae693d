"""Pinhole camera, resection of a camera from a range grid, and rays at a silhouette."""
