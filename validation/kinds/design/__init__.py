"""The designed experiment: which cause moves a rock's value from view to view, and how much."""
