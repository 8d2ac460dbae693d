"""Order of rocks by a value, with the probability of each place."""

from rockshape.ranking.order import rank

__all__ = ["rank"]
