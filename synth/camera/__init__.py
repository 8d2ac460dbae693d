"""Cameras: presets, poses, projection and trajectories."""
