"""Counts in words, for what commands tell on the standard error."""


def counted(count: int, noun: str) -> str:
    """Count with its noun, whose plural ends in s."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
