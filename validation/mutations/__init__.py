"""Errors put in on purpose, to prove that the gates bite."""

from validation.mutations.bench import Bench, Caught, made_views, part_of, prepare_bench
from validation.mutations.paper import PAPER
from validation.mutations.robust import ROBUST

MUTATIONS = {"paper": PAPER, "robust": ROBUST}  # by the method they are errors of

__all__ = ["MUTATIONS", "Bench", "Caught", "made_views", "part_of", "prepare_bench"]
