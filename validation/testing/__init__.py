"""Assertions for tests of shape measures, in anyone's own test suite."""

from validation.testing.consistency import assert_consistent
from validation.testing.ranks import assert_ranks

__all__ = ["assert_consistent", "assert_ranks"]
