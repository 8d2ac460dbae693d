"""Sensors and rock families as others write them: one file each, outside the packages."""
