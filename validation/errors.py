"""Errors that end a command with one line and an exit status."""


class InputError(ValueError):
    """Unusable input: the message says what, where, what was expected and what was found."""

    exit_status = 2


class MissingPackageError(RuntimeError):
    """A package that the work needs is not installed; the message names it."""

    exit_status = 3


class WorkerError(RuntimeError):
    """Workers die at a unit again and again."""

    exit_status = 3
