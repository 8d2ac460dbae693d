"""Complaints about plain tables that do not fit a struct: key, what was expected, what was found.

The tables are compared with the struct's own fields, key by key; no text of msgspec's is parsed.
"""

import re
from collections.abc import Iterable, Mapping
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import msgspec
from msgspec import inspect

from synth.spec.wording import expected_one_of, unknown_name

_PLAIN: Mapping[type, str] = {
    inspect.BoolType: "true or false",
    inspect.NoneType: "none",
    inspect.StructType: "a table",
    inspect.DictType: "a table",
}
_BOUNDS = (("gt", "above"), ("ge", "at least"), ("lt", "below"), ("le", "at most"))


def complaint(table: object, kind: Any, *, path: str = "") -> str:
    """First complaint about plain tables that cannot be converted to a struct.

    `path` is the place of the tables themselves, where they are part of a larger file.

    An unknown key reads `unknown key 'cuont' in [rocks]; did you mean 'count'?`, anything else
    `rocks.count: expected …, found …`. A struct's own `__post_init__` raises ValueError with a
    text that begins with the key that it is about.
    """
    found = _complaint(table, kind, path)
    return f"expected {describe(inspect.type_info(kind))}" if found is None else found


def describe(info: inspect.Type) -> str:
    """Description of what a type accepts: `an integer from 1 to 500`."""
    match info:
        case inspect.IntType() | inspect.FloatType():
            number = "an integer" if isinstance(info, inspect.IntType) else "a number"
            words = f"{number}{_limits(info)}"
        case inspect.StrType():
            words = "text" if info.pattern is None else f"text that matches {info.pattern}"
        case inspect.LiteralType():
            words = f"one of {', '.join(str(value) for value in info.values)}"
        case inspect.UnionType():
            words = " or ".join(dict.fromkeys(describe(each) for each in info.types))
        case inspect.TupleType():
            kinds = dict.fromkeys(describe(each) for each in info.item_types)
            words = f"a list of {len(info.item_types)} ({', '.join(kinds)})"
        case inspect.VarTupleType() | inspect.ListType():
            words = f"a list of {_length(info)}({describe(info.item_type)})"
        case _:
            words = _PLAIN.get(type(info), type(info).__name__.removesuffix("Type").lower())
    return words


def _complaint(value: Any, hint: Any, path: str) -> str | None:
    """Complaint about the value of a key, None if it fits its type."""
    info = inspect.type_info(hint)
    structs = [
        each
        for each in (info.types if isinstance(info, inspect.UnionType) else (info,))
        if isinstance(each, inspect.StructType)
    ]
    if structs and isinstance(value, Mapping):
        return _of_table(value, structs, path)
    for index, (item, kind) in enumerate(_items(value, hint)):
        found = _complaint(item, kind, f"{path}[{index}]")
        if found is not None:
            return found
    try:
        msgspec.convert(value, hint)
    except msgspec.ValidationError:
        where = f"{path}: " if path else ""
        if isinstance(info, inspect.LiteralType) and isinstance(value, str):
            return f"{where}{expected_one_of(value, [str(each) for each in info.values])}"
        return f"{where}expected {describe(info)}, found {value!r}"
    return None


def _of_table(table: Mapping[str, Any], structs: list[inspect.StructType], path: str) -> str | None:
    """Complaint about a table that is one of several structs, told apart by their tag."""
    tag_field = structs[0].tag_field
    by_tag = {str(each.tag): each for each in structs}
    info = structs[0]
    if tag_field is not None and len(structs) > 1:
        tag = str(table.get(tag_field))
        if tag not in by_tag:
            return f"{_dotted(path, tag_field)}: {expected_one_of(tag, by_tag)}"
        info = by_tag[tag]
    names = {field.encode_name: field.name for field in info.fields}
    tags = () if tag_field is None else (tag_field,)
    if info.forbid_unknown_fields:
        for key in table:
            if key not in names and key not in tags:
                return unknown_name("key", key, [*tags, *names], place=path)
    hints = get_type_hints(info.cls, include_extras=True)
    for field in info.fields:
        if field.encode_name in table:
            here = _dotted(path, field.encode_name)
            found = _complaint(table[field.encode_name], hints[field.name], here)
            if found is not None:
                return found
        elif field.required:
            here = _dotted(path, field.encode_name)
            return f"{here}: expected {describe(inspect.type_info(hints[field.name]))}, found none"
    return _own_complaint(table, info.cls, names, path)


def _own_complaint(
    table: Mapping[str, Any], kind: type, names: Iterable[str], path: str
) -> str | None:
    """Complaint of a struct's own check about a table whose every key fits."""
    try:
        msgspec.convert(table, kind)
    except msgspec.ValidationError as error:
        text = str(error if error.__cause__ is None else error.__cause__)
        key = re.match(r"\w*", text)
        about_key = key is not None and key[0] in set(names)
        return _dotted(path, text) if about_key or not path else f"{path}: {text}"
    return None


def _items(value: Any, hint: Any) -> list[tuple[Any, Any]]:
    """Items of a list, each with its type; nothing where the number is wrong."""
    while get_origin(hint) is Annotated:
        hint = get_args(hint)[0]
    if get_origin(hint) not in (tuple, list) or not isinstance(value, list | tuple):
        return []
    kinds = get_args(hint)
    if get_origin(hint) is list or kinds[-1] is Ellipsis:
        return [(item, kinds[0]) for item in value]
    return list(zip(value, kinds, strict=True)) if len(value) == len(kinds) else []


def _dotted(path: str, rest: str) -> str:
    return f"{path}.{rest}" if path else rest


def _limits(info: inspect.IntType | inspect.FloatType) -> str:
    if info.ge is not None and info.le is not None:
        return f" from {_number(info.ge)} to {_number(info.le)}"
    given = [(words, getattr(info, name)) for name, words in _BOUNDS]
    parts = [f"{words} {_number(value)}" for words, value in given if value is not None]
    return f" {' and '.join(parts)}" if parts else ""


def _length(info: inspect.VarTupleType | inspect.ListType) -> str:
    least = "" if info.min_length is None else f"at least {info.min_length} "
    return least + ("" if info.max_length is None else f"at most {info.max_length} ")


def _number(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:g}"
