"""Errors of input, machine and reproduction; each carries the command's exit status."""


class SpecError(ValueError):
    """Unusable input: the message is one line that says what, where, expected and found."""

    exit_status = 2


class MissingBackendError(RuntimeError):
    """A renderer that this machine lacks: the message names the package to install."""

    exit_status = 3


class ReplayError(RuntimeError):
    """A dataset made again that is not the same: the message names the first differing file."""

    exit_status = 1


class RenderError(RuntimeError):
    """A rendering process that failed, died or took too long: the message says which."""

    exit_status = 3
