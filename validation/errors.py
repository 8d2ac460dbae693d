"""Errors that end a command with one line and an exit status."""


class InputError(ValueError):
    """Unusable input: the message says what, where, what was expected and what was found."""

    exit_status = 2
