"""Batches: many images measured into one table, resumed where they were cut off."""
