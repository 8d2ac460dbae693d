"""Uncertainty of the robust values: standard deviation and 90 % interval of each, for each rock."""

from rockshape.uncertainty.error_model import ErrorModel, ErrorModels, read_error_models
from rockshape.uncertainty.estimate import COVERAGE, Uncertainty, estimates, uncertainty_columns
from rockshape.uncertainty.observables import Observables, observe

__all__ = [
    "COVERAGE",
    "ErrorModel",
    "ErrorModels",
    "Observables",
    "Uncertainty",
    "estimates",
    "observe",
    "read_error_models",
    "uncertainty_columns",
]
