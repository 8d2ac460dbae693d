"""Errors that end a command with one line and an exit status."""

from rockshape.errors import InputError

__all__ = ["InputError", "MissingPackageError", "Terminated", "WorkerError"]


class MissingPackageError(RuntimeError):
    """A package that the work needs is not installed; the message names it."""

    exit_status = 3


class WorkerError(RuntimeError):
    """Workers die at a unit again and again."""

    exit_status = 3


class Terminated(KeyboardInterrupt):
    """SIGTERM to the run; it unwinds as an interrupt from the keyboard does."""

    exit_status = 143
