"""docs/validation.md names every key of every kind of experiment with its default."""

import msgspec
import pytest

from tests.synth.test_docs import ROOT, names, rows
from validation.suite.experiment import Experiment
from validation.suite.registry import installed_kinds

PAGE = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
KEYS = PAGE.split("### Keys of an experiment\n")[1].split("### ")[0]
COMMON = {*Experiment.__struct_fields__}


def _documented(kind: str) -> dict[str, str]:
    """Default of each key in the table below the line that names the kind."""
    tables = KEYS.split("\nOf ")[1:]
    (text,) = (each for each in tables if f"`{kind}`" in each.split(":\n")[0])
    table = text.split("\n\n")[1]
    return {key: default for keys, default, *_ in rows(table) for key in names(keys)}


def test_the_keys_of_all_kinds_are_told() -> None:
    table = KEYS.split("\nOf ")[1]
    told = {name for cells in rows(table) for name in names(cells[0])}
    assert told == {"kind", "like", *COMMON}


def _default(field: msgspec.structs.FieldInfo) -> str:
    """Default as the page writes it."""
    value = field.default
    if value is msgspec.NODEFAULT:
        return "required" if field.default_factory is msgspec.NODEFAULT else "all defaults"
    if isinstance(value, msgspec.Struct):
        return "all defaults"
    if isinstance(value, tuple):
        return f"[{', '.join(f'`{each}`' for each in value)}]"
    return {str: f"`{value}`", type(None): "none"}.get(type(value), str(value))


@pytest.mark.parametrize("kind", sorted(installed_kinds()))
def test_every_key_of_a_kind_is_told_with_its_default(kind: str) -> None:
    fields = msgspec.structs.fields(installed_kinds()[kind].spec)
    own = {each.name: _default(each) for each in fields if each.name not in COMMON}
    assert _documented(kind) == own
