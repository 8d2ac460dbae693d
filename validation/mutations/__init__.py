"""Errors put in on purpose, to prove that the gates bite."""

from validation.mutations.bench import Bench, Caught, prepare_bench
from validation.mutations.catalogue import MUTATIONS

__all__ = ["MUTATIONS", "Bench", "Caught", "prepare_bench"]
