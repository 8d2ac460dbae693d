"""Validity of measured points, decided once, before anything is fitted to them."""
