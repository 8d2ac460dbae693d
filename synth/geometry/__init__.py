"""Geometry: triangle meshes, minimum-volume boxes and inscribed balls."""
