"""Outlines snapped to image edges."""
