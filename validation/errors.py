"""Errors that end a command with one line and an exit status."""

from rockshape.errors import InputError, MissingPackageError, WorkerError

__all__ = ["InputError", "MissingPackageError", "Terminated", "WorkerError"]


class Terminated(KeyboardInterrupt):
    """SIGTERM to the run; it unwinds as an interrupt from the keyboard does."""

    exit_status = 143
