"""Corpus of malformed inputs over every command, key and format, the same for the same seed."""

import json
import tomllib
from collections.abc import Iterator, Sequence
from itertools import cycle, islice
from typing import NamedTuple

import msgspec
import numpy as np

from rockshape.point_grid.range_kinds import KINDS
from synth.spec import SceneSpec
from tests.hostile import mutations
from tests.hostile.scene import CAMERA, image
from tests.hostile.seed_files.encoding import as_json, pillow
from tests.hostile.seed_files.ranges import BASELINE_M
from tests.hostile.seeds import readable_formats, seeds, seeds_of

SIZE = 1600
SHARES = {
    "file": 0.42,
    "pair": 0.04,
    "folder": 0.04,
    "content": 0.12,
    "option": 0.12,
    "suite": 0.1,
    "spec": 0.1,
    "run": 0.06,
}
SUITE = b"""name = "one"
title = "One"
[[experiment]]
kind = "shapes"
name = "shapes"
title = "Shapes"
seed = 12000
drawings = 1
series = ["roundness"]
methods = ["paper"]
[[gate]]
score = "shapes.roundness.angularity_2d_deg.tau"
at_least = 0.5
reason = "order"
"""
# {…} are files of a case: outputs, which hold something, and a file where a folder is expected
OUTPUTS = ("out.csv", "found.png", "over.png", "page.html")
MEASURE = ("measure", "{scene.png}", "--out", "{out.csv}", "--labels-out", "{found.png}",
           "--overlay", "{over.png}", "--report", "{page.html}")  # fmt: skip
WITH = {
    "image": ("--labels", "{labels.png}"),
    "labels": (),
    "range": ("--labels", "{labels.png}", "--camera", "{camera.json}"),
    "camera": ("--labels", "{labels.png}", "--range", "{range.npy}"),
}
COMMANDS = {
    "measure": ("measure", "{scene.png}", "--labels", "{labels.png}", "--out", "{out.csv}"),
    "synth scene": ("synth", "scene", "{blocked}"),
    "synth shapes": ("synth", "shapes", "--out", "{blocked}"),
    "validate run": ("validate", "run", "--suite", "{suite.toml}", "--out", "{blocked}"),
    "validate compare": ("validate", "compare", "{run}", "{run}"),
    "formats": ("formats",),
}
GROUND_DISPARITY_PX = 4  # of the plane 2 m away with the baseline of 0.1 m
WORDS = ("", " ", "-1", "0", "nan", "inf", "1e999", "9" * 400, "x" * 3000, "\x1b[31m\n\x00"[:6], "é≥",  # noqa: E501
         "\udcff", "{absent}", "{folder}", "{scene.png}", "/dev/zero", "/dev/null", "a=b", "a:b",
         "os:abort", "../..", "--", "-", "%s%n", "{labels.png}", "1,2", "{}")  # fmt: skip


class Case(NamedTuple):
    """One run: its arguments, and the files that it finds beside the usual ones."""

    command: str
    kind: str
    argv: tuple[str, ...]
    files: dict[str, bytes]  # by name
    name: str  # what was done


def cases(seed: int = 0, count: int = SIZE) -> Iterator[Case]:
    """So many cases, each kind's share of them."""
    makers = {"file": _files, "pair": _pairs, "folder": _folders, "content": _contents,
              "option": _options, "suite": _suites, "spec": _specs, "run": _runs}  # fmt: skip
    for index, (kind, share) in enumerate(SHARES.items()):
        rng = np.random.default_rng([seed, index])
        yield from islice(makers[kind](rng), round(share * count))


def _measured(kind: str, suffix: str, data: bytes, name: str) -> Case:
    """`measure` of the usual scene with one file in the place of the usual one."""
    file = f"hostile{suffix}"
    argv = [*MEASURE, *WITH[kind]]
    if kind == "image":
        argv[1] = f"{{{file}}}"
    else:
        argv += [f"--{kind}", f"{{{file}}}"]
    return Case("measure", kind, tuple(argv), {file: data}, name)


def _files(rng: np.random.Generator) -> Iterator[Case]:
    """Damaged files of each readable format in turn."""
    for one in cycle(readable_formats()):
        seeds = seeds_of(one)
        seed = seeds[int(rng.integers(len(seeds)))]
        as_json = seed.data.startswith((b"{", b"[")) and rng.random() < 0.5
        damage = mutations.retyped_json if as_json else mutations.damaged
        case = _measured(one.kind, seed.suffix, damage(seed.data, rng), f"{one.name} damaged")
        if one.kind == "range" and rng.random() < 0.4:
            case = case._replace(argv=(*case.argv, "--range-kind", str(rng.choice(KINDS))))
        yield case


def _pairs(rng: np.random.Generator) -> Iterator[Case]:
    """Stereo pairs of which the right picture or the camera is damaged."""
    pictures = [seed for seed in seeds() if seed.kind == "image"]
    stereo = [seed for seed in seeds() if seed.kind == "camera"]
    for kind, files in cycle((("right", pictures), ("camera", stereo))):
        seed = files[int(rng.integers(len(files)))]
        as_json = seed.data.startswith(b"{") and rng.random() < 0.5
        damage = mutations.retyped_json if as_json else mutations.damaged
        file = f"hostile{seed.suffix}"
        right, camera = ("{right.png}", "{stereo.json}")
        pair = (f"{{{file}}}", camera) if kind == "right" else (right, f"{{{file}}}")
        argv = (*MEASURE, "--labels", "{labels.png}", "--right", pair[0], "--camera", pair[1])
        yield Case("measure", "pair", argv, {file: damage(seed.data, rng)}, f"{kind} damaged")


def _folders(rng: np.random.Generator) -> Iterator[Case]:
    """Folders of masks with one that is damaged or of another kind."""
    files = [seed for seed in seeds() if seed.kind != "camera"]
    while True:
        seed = files[int(rng.integers(len(files)))]
        name = f"masks/{rng.choice(['rock_3', 'rock_02', 'rock', '9' * 30])}{seed.suffix}"
        argv = (*MEASURE, "--instances", "{masks}")
        yield Case("measure", "folder", argv, {name: mutations.damaged(seed.data, rng)}, name)


def _contents(rng: np.random.Generator) -> Iterator[Case]:
    """Contents of other formats, odd arrays and texts under each format's suffix."""
    odd = [
        *mutations.texts(),
        *mutations.arrays(),
        b"\x89PNG\r\n\x1a\n",
        b"II*\x00",
        b"PK\x03\x04",
        b"\x80\x04",
    ]
    others = [seed.data for one in readable_formats() for seed in seeds_of(one)]
    while True:
        for one in readable_formats():
            data = odd if rng.random() < 0.6 else others
            suffix = str(rng.choice(one.suffixes))
            yield _measured(one.kind, suffix, data[int(rng.integers(len(data)))], f"{one.name} odd")


def _options(rng: np.random.Generator) -> Iterator[Case]:
    """Each option of each command with words that it does not expect."""
    named = [
        (command, option)
        for command in COMMANDS
        for option in ("", "--nope", *_options_of(command))
    ]
    order = rng.permutation(len(named))
    for index in cycle(order):
        command, option = named[int(index)]
        word = WORDS[int(rng.integers(len(WORDS)))]
        argv = (*COMMANDS[command], *([option] if option else []), word)
        yield Case(command, "option", argv, {}, f"{option} {word[:20]!r}")


def _options_of(command: str) -> Sequence[str]:
    """Options as the command's help has them."""
    from rockshape.cli import build_parser

    parser = build_parser(command.split(maxsplit=1)[0])
    for word in command.split():
        subparsers = next(
            a for a in parser._actions if hasattr(a, "choices") and isinstance(a.choices, dict)
        )
        parser = subparsers.choices[word]
    options = [name for action in parser._actions for name in action.option_strings]
    return [
        name for name in options if name.startswith("--") and name not in ("--help", "--version")
    ]


def _toml(table: object) -> bytes:
    """TOML of plain tables, each key in one line; what TOML lacks, null say, is written as it is."""  # noqa: E501
    if not isinstance(table, dict):
        return _value(table).encode()
    return "".join(
        f"{json.dumps(key)} = {_value(value)}\n" for key, value in table.items()
    ).encode()


def _value(value: object) -> str:
    if isinstance(value, dict):
        pairs = (f"{json.dumps(key)} = {_value(each)}" for key, each in value.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value).replace("NaN", "nan").replace("Infinity", "inf")


def _suites(rng: np.random.Generator) -> Iterator[Case]:
    """Damaged suites and gates."""
    while True:
        data = SUITE
        if rng.random() < 0.6:
            data = _toml(mutations.retyped(tomllib.loads(SUITE.decode()), rng))
        else:
            data = mutations.damaged(data, rng) if rng.random() < 0.7 else _odd_text(rng)
        argv = ("validate", "run", "--suite", "{hostile.toml}", "--out", "{blocked}")
        if rng.random() < 0.2:
            argv = (*COMMANDS["validate run"], "--gates", "{hostile.toml}")
        yield Case("validate run", "suite", argv, {"hostile.toml": data}, "suite")


def _odd_text(rng: np.random.Generator) -> bytes:
    odd = list(mutations.texts())
    return odd[int(rng.integers(len(odd)))]


def _specs(rng: np.random.Generator) -> Iterator[Case]:
    """Damaged scene specs and manifests; the folder to write to is a file."""
    whole = {
        "spec": msgspec.to_builtins(SceneSpec()),
        "seed": 0,
        "backend": "embree",
        "files": {"a": "b"},
    }
    while True:
        if rng.random() < 0.6:
            argv: tuple[str, ...] = ("synth", "scene", "--spec", "{hostile.toml}", "{blocked}")
            spec = msgspec.to_builtins(SceneSpec())
            data = _toml(mutations.retyped(spec, rng)) if rng.random() < 0.8 else _odd_text(rng)
            yield Case("synth scene", "spec", argv, {"hostile.toml": data}, "spec")
        else:
            argv = ("synth", "scene", "--replay", "{hostile.json}", "{blocked}")
            data = msgspec.json.encode(whole)
            data = (
                mutations.retyped_json(data, rng)
                if rng.random() < 0.7
                else mutations.damaged(data, rng)
            )
            yield Case("synth scene", "manifest", argv, {"hostile.json": data}, "manifest")


def _runs(rng: np.random.Generator) -> Iterator[Case]:
    """Damaged runs; {bad run} is a copy of the run with other files."""
    while True:
        table = rng.random() < 0.5
        name = "results.parquet" if table else "scores.json"
        pair = ("{run}", "{bad run}") if rng.random() < 0.5 else ("{bad run}", "{run}")
        # the content is made where the run is: only then is it known
        mark = f"{int(rng.integers(2**31))}".encode()
        yield Case(
            "validate compare",
            "run",
            ("validate", "compare", *pair),
            {f"bad run/{name}": mark},
            name,
        )


def damaged_run(name: str, data: bytes, mark: bytes) -> bytes:
    """Content of a damaged run's file, drawn by the case's mark."""
    rng = np.random.default_rng(int(mark))
    if name.endswith(".json") and rng.random() < 0.6:
        return mutations.retyped_json(data, rng)
    return mutations.damaged(data, rng)


def usual_files() -> dict[str, bytes]:
    """Files that every case finds."""

    def first(kind: str, suffix: str) -> bytes:
        return next(each.data for each in seeds() if (each.kind, each.suffix) == (kind, suffix))

    return dict.fromkeys(OUTPUTS, b"old") | {
        "scene.png": first("image", ".png"),
        "labels.png": first("labels", ".png"),
        "range.npy": first("range", ".npy"),
        "camera.json": first("camera", ".json"),
        "right.png": pillow(np.roll(image(), -GROUND_DISPARITY_PX, axis=1), "PNG"),
        "stereo.json": as_json({**CAMERA, "baseline_m": BASELINE_M}),
        "suite.toml": SUITE,
        "blocked": b"a file where a folder is expected",
    }
