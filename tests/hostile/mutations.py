"""Damage to files: bytes, lengths and structure, drawn at random or listed."""

import io
import json
import struct
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

Rng = np.random.Generator
Mutation = Callable[[bytes, Rng], bytes]

LENGTHS = (0, 1, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFF0)
# what stands in the place of a value in JSON or TOML
VALUES: tuple[Any, ...] = (
    None, True, -1, 0, 1e308, -1e-308, 10**30, 2**63, "", "x", "\x00\x1b[31m\n", "\ud800", "a" * 3000,  # noqa: E501
    [], {}, [[]], [None], {"a": 1}, [1, "x"], float("nan"), float("inf"), [1e9] * 6, [[0] * 3] * 3,
)  # fmt: skip


def truncated(data: bytes, rng: Rng) -> bytes:
    """Cut somewhere."""
    return data[: rng.integers(0, len(data) + 1)]


def flipped(data: bytes, rng: Rng) -> bytes:
    """One to 64 bits flipped."""
    found = bytearray(data)
    for _ in range(int(2 ** rng.integers(0, 7))):
        if found:
            found[rng.integers(len(found))] ^= 1 << int(rng.integers(8))
    return bytes(found)


def lengthened(data: bytes, rng: Rng) -> bytes:
    """A field of 2, 4 or 8 bytes, most often near the start, that says another length."""
    found = bytearray(data)
    code = str(rng.choice(["<H", ">H", "<I", ">I", "<Q", ">Q"]))
    size = struct.calcsize(code)
    reach = len(found) if rng.random() < 0.3 else min(len(found), 256)
    if reach > size:
        at = int(rng.integers(reach - size))
        value = int(rng.choice(LENGTHS)) & (256**size - 1)
        found[at : at + size] = struct.pack(code, value)
    return bytes(found)


def overwritten(data: bytes, rng: Rng) -> bytes:
    """A run of bytes that is zero, 255 or random."""
    found = bytearray(data)
    if found:
        at, run = int(rng.integers(len(found))), int(rng.integers(1, 64))
        fill = rng.integers(3)
        patch = bytes(run) if fill == 0 else b"\xff" * run if fill == 1 else rng.bytes(run)
        found[at : at + run] = patch
    return bytes(found)


def spliced(data: bytes, rng: Rng) -> bytes:
    """A piece left out, doubled or moved."""
    if not data:
        return data
    one, two = sorted(int(at) for at in rng.integers(0, len(data) + 1, 2))
    way = rng.integers(3)
    if way == 0:
        return data[:one] + data[two:]
    if way == 1:
        return data[:two] + data[one:]
    return data[two:] + data[:two]


def renumbered(data: bytes, rng: Rng) -> bytes:
    """A decimal number of a text that is another one."""
    runs = [at for at in range(len(data)) if data[at : at + 1].isdigit()]
    if not runs:
        return flipped(data, rng)
    at = end = int(rng.choice(runs))
    while end < len(data) and data[end : end + 1].isdigit():
        end += 1
    words = (b"0", b"-1", b"9" * 10, b"9" * 20, b"9" * 5000, b"1e309", b"NaN", b"", b"x", b"65536")
    return data[:at] + words[int(rng.integers(len(words)))] + data[end:]


MUTATIONS: tuple[Mutation, ...] = (
    truncated, flipped, lengthened, overwritten, spliced, renumbered,
)  # fmt: skip


def damaged(data: bytes, rng: Rng) -> bytes:
    """One to three mutations."""
    for _ in range(int(rng.integers(1, 4))):
        data = MUTATIONS[int(rng.integers(len(MUTATIONS)))](data, rng)
    return data


def retyped(tree: Any, rng: Rng) -> Any:
    """Tree of dicts and lists with one value, key or item that is another, missing or too many."""
    places = list(_places(tree))
    if not places:
        return VALUES[int(rng.integers(len(VALUES)))]
    holder, key = places[int(rng.integers(len(places)))]
    way = rng.integers(6)
    if way == 0:
        del holder[key]
    elif way == 1 and isinstance(holder, dict):
        holder[f"{key}x"] = holder.pop(key)
    else:
        holder[key] = VALUES[int(rng.integers(len(VALUES)))]
    return tree


def _places(tree: Any) -> Iterator[tuple[Any, Any]]:
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in list(items):
        yield tree, key
        if isinstance(value, dict | list):
            yield from _places(value)


def retyped_json(data: bytes, rng: Rng) -> bytes:
    """JSON with another value somewhere."""
    return json.dumps(retyped(json.loads(data), rng)).encode()


def texts() -> Iterator[bytes]:
    """Contents that no text format should take, or only with care."""
    yield from (
        b"",
        b"\n",
        b"{}",
        b"[]",
        b"null",
        b"0",
        b'""',
        b"\xef\xbb\xbf{}",
        b"\xff\xfe{\x00}\x00",
    )
    yield from (b"[" * 10**5, b'{"a":' * 10**4, b"9" * 5000, b"\x00" * 100, b"a = " + b"[" * 10**4)
    yield from (b'{"fx": NaN}', b'{"fx": 1, "fx": 2}', b'{"\\ud800": 1}', b"= 1", b"[[a]]\n[a]\n")


def _header(text: str) -> bytes:
    head = text.encode().ljust(117) + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head


def arrays() -> Iterator[bytes]:
    """NumPy files of other types, shapes and sizes."""
    for dtype in ("O", "U3", "S3", "c8", "?", ">f4", "f2", "M8[s]", "i8", "u8", "V4", "f4,f4"):
        yield _header(f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': (48, 64), }}")
        with_type = np.dtype(dtype)
        if not with_type.hasobject:
            stream = io.BytesIO()
            np.save(stream, np.zeros((48, 64), with_type))
            yield stream.getvalue()
    for shape in ("()", "(0,)", "(5,)", "(10**6, 10**6)", "(1000000, 1000000)", "(-1, 3)", "(2,) * 70",  # noqa: E501
                  "(48, 64, 0)", "(48, 64, 2)", "(1, 48, 64)", "'x'", "(1e9, 2)"):  # fmt: skip
        yield _header(f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}")
    for fill in (np.nan, np.inf, -1.0, 0.0, 1e300, 1e-300):
        for shape in ((48, 64), (48, 64, 3)):
            stream = io.BytesIO()
            np.save(stream, np.full(shape, fill))
            yield stream.getvalue()
