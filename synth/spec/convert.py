"""Specifications converted from plain tables."""

from typing import TypeVar

import msgspec

from synth.errors import SpecError
from synth.spec.complaint import complaint

Spec = TypeVar("Spec", bound=msgspec.Struct)


def convert_table(table: object, kind: type[Spec], *, where: str) -> Spec:
    """Specification of a kind, converted and checked; `where` begins the complaint.

    Raises:
        SpecError: a key or value that is not allowed; the message names it.
    """
    try:
        return msgspec.convert(table, kind)
    except UnicodeEncodeError as error:  # of lone surrogates, which JSON can hold
        raise SpecError(f"{where}: expected text, found {error}") from error
    except msgspec.ValidationError as error:
        raise SpecError(f"{where}: {complaint(table, kind)}") from error
