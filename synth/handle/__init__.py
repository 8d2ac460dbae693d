"""Handles of scenes and shapes for scripts and notebooks: rendered in worker processes."""
