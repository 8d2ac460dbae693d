"""Valid small files of each format, which the corpus and the fuzzers damage.

Formats come from the registry: one that writes makes its own seeds too, and one that has none here
is tried on the seeds of all other formats of its kind under its own suffixes.
"""

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np

from rockshape.io.format import Format
from rockshape.io.registry import known_formats
from rockshape.rock.instances import Instances
from tests.hostile.scene import image, labels
from tests.hostile.seed_files import cameras, images, ranges
from tests.hostile.seed_files import labels as label_files

FILES = {
    "image": images.files,
    "labels": label_files.files,
    "range": ranges.files,
    "camera": cameras.files,
}


class Seed(NamedTuple):
    """Content of a valid file."""

    kind: str  # of file, as the registry has it
    format: str  # its name in the registry
    suffix: str
    data: bytes


def _written() -> Iterator[Seed]:
    """Seeds of the formats that write."""
    instances = Instances.from_labels(labels().astype(np.int32))
    contents = {"image": image(), "labels": instances}
    for one in known_formats():
        if one.writable and one.readable and one.kind in contents:
            yield Seed(one.kind, one.name, one.suffixes[0], one.write(contents[one.kind]))


@cache
def seeds() -> tuple[Seed, ...]:
    """All seeds."""
    made = (Seed(kind, *file) for kind, files in FILES.items() for file in files())
    return (*made, *_written())


def seeds_of(one: Format) -> tuple[Seed, ...]:
    """Seeds of a format; those of others of its kind, under its suffix, where it has none."""
    kind = [seed for seed in seeds() if seed.kind == one.kind]
    own = [seed for seed in kind if seed.format == one.name]
    return tuple(own or (seed._replace(suffix=one.suffixes[0]) for seed in kind))


def readable_formats() -> tuple[Format, ...]:
    """Formats of the registry that are read from a file; those of folders have no suffix."""
    return tuple(one for one in known_formats() if one.readable and one.suffixes)
