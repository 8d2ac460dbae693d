"""Errors put in on purpose, to prove that the gates bite."""

from validation.selfcheck.mutations.bench import Bench, Caught, part_of, prepare_bench
from validation.selfcheck.mutations.paper import PAPER
from validation.selfcheck.mutations.robust import ROBUST

MUTATIONS = {"paper": PAPER, "robust": ROBUST}  # by the method they are errors of

__all__ = ["MUTATIONS", "Bench", "Caught", "part_of", "prepare_bench"]
