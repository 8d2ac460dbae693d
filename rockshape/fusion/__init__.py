"""Fusion of several views: poses refined, rocks matched between views, one row a rock."""
