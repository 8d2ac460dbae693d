"""Scenes: ground, population, placement and settling of rocks."""
