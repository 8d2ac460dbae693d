"""Format registry: the known formats of each kind of file, and the choice of one for a file.

A file's format is chosen by its suffix and its content:

1. of the formats with the file's suffix, the first whose sniffing accepts the content;
2. else the first with that suffix that does not sniff;
3. else, of all formats of the kind, the first whose sniffing accepts the content.

Formats registered in the process come first, then those of the entry points `rockshape.formats` of
other distributions, then our own, so that a special case can precede a general one.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from itertools import chain
from pathlib import Path
from typing import Any, Generic, TypeVar

from rockshape.errors import InputError
from rockshape.io.contents import describe_content
from rockshape.io.files import MAX_PIXELS, InputFile, check_writable
from rockshape.io.format import (
    CameraFormat,
    Format,
    ImageFormat,
    Kind,
    LabelFormat,
    RangeFormat,
    Sniff,
    TableFormat,
    magic,
    suffix_of,
)
from rockshape.io.guard import guard, reason_of

GROUP = "rockshape.formats"
F = TypeVar("F", bound=Format)


@dataclass(frozen=True, eq=False)
class FormatRegistry(Generic[F]):
    """Formats of one kind of file."""

    record: type[F]
    noun: str  # what a file of this kind is, for the messages
    package: str  # whose FORMATS are our own
    unfit: tuple[tuple[Sniff, str], ...] = ()  # contents that are refused, and the words for why
    registered: dict[str, F] = field(default_factory=dict)  # in this process, by name

    @property
    def kind(self) -> Kind:
        """Kind of file."""
        return self.record.kind

    @property
    def own(self) -> tuple[F, ...]:
        """Formats that come with the package."""
        formats: tuple[F, ...] = import_module(self.package).FORMATS
        return formats

    @property
    def formats(self) -> tuple[F, ...]:
        """All known formats, in the order in which they are tried."""
        added = (each for each in _from_entry_points() if isinstance(each, self.record))
        return (*self.registered.values(), *added, *self.own)

    def register(self, added: F) -> None:
        """Add a format for this process; one registered before by the same name is replaced.

        Raises: InputError where an installed format has that name.
        """
        others = [each.name for each in self.formats if each.name not in self.registered]
        if added.name in others:
            raise InputError(
                f"register_format: expected a new name for {self.noun}, found {added.name!r}, "
                f"which is known already"
            )
        self.registered[added.name] = added

    @contextmanager
    def open(
        self,
        path: Path | str,
        *,
        max_pixels: int = MAX_PIXELS,
        image_shape: tuple[int, int] | None = None,
    ) -> Iterator[tuple[InputFile, F]]:
        """Choose the format of a file; whatever a reader raises within becomes an InputError.

        Other libraries' logs and warnings are silenced within. max_pixels and image_shape bound
        what readers decode, see `InputFile.check_shape`.
        Raises: InputError where no known format fits.
        """
        readable = [each for each in self.formats if each.readable]
        names = ", ".join(dict.fromkeys(each.name for each in readable))
        file = InputFile(
            Path(path),
            expected=f"{self.noun} ({names})",
            max_pixels=max_pixels,
            image_shape=image_shape,
        )
        with guard(file.refusal):
            chosen = _choose(file, readable, self.unfit)
        file = replace(file, expected=f"{self.noun} ({chosen.name})")
        with guard(file.refusal):
            yield file, chosen

    def encode(self, path: Path | str, content: object) -> bytes:
        """Content of a file in the format that the path's suffix names; nothing is written.

        Raises: InputError for another suffix and for content that the format cannot hold.
        """
        chosen = self.for_writing(Path(path))
        try:
            return chosen.write(content)
        except Exception as error:
            raise InputError(f"{path}: {reason_of(error)}") from error

    def for_writing(self, path: Path) -> F:
        """Return the format that a path's suffix names, first of all by its first suffix.

        Raises: InputError where there is none or the file cannot be written.
        """
        writable = [each for each in self.formats if each.writable]
        suffixes = dict.fromkeys(suffix for each in writable for suffix in each.suffixes)
        check_writable(path, suffixes=suffixes)
        suffix = suffix_of(path)
        named = [each for each in writable if suffix in each.suffixes]
        return min(named, key=lambda each: each.suffixes.index(suffix))


IMAGES = FormatRegistry(ImageFormat, "an image", "rockshape.io.images")
LABELS = FormatRegistry(
    LabelFormat,
    "labels",
    "rockshape.io.labels",
    unfit=((magic(b"\xff\xd8\xff"), "JPEG, whose lossy compression changes numbers"),),
)
RANGES = FormatRegistry(RangeFormat, "range", "rockshape.io.range")
CAMERAS = FormatRegistry(CameraFormat, "a camera", "rockshape.io.cameras")
TABLES = FormatRegistry(TableFormat, "a table", "rockshape.io.tables")
REGISTRIES: tuple[FormatRegistry[Any], ...] = (IMAGES, LABELS, RANGES, CAMERAS, TABLES)


def register_format(added: Format) -> None:
    """Add a format to the registry of its kind, for this process.

    Raises: InputError where an installed format of the kind has its name.
    """
    _registry_of(added).register(added)


def known_formats(kind: Kind | None = None) -> tuple[Format, ...]:
    """Formats of a kind, or of all kinds, in the order in which they are tried."""
    registries = [each for each in REGISTRIES if kind in (None, each.kind)]
    return tuple(one for registry in registries for one in registry.formats)


def _registry_of(added: object) -> FormatRegistry[Any]:
    for registry in REGISTRIES:
        if isinstance(added, registry.record):
            return registry
    records = ", ".join(registry.record.__name__ for registry in REGISTRIES)
    raise InputError(f"format: expected one of {records}, found {type(added).__name__}")


@cache
def _from_entry_points() -> tuple[Format, ...]:
    return tuple(_load(point) for point in entry_points(group=GROUP))


def _load(point: EntryPoint) -> Format:
    """Return the format that an entry point names. Raises: InputError where it names none."""
    where = f"entry point {point.name} = {point.value} of {GROUP}"
    try:
        loaded: object = point.load()
    except Exception as error:
        raise InputError(f"{where}: expected a format, found {reason_of(error)}") from error
    if not isinstance(loaded, Format):
        raise InputError(f"{where}: expected a format, found {type(loaded).__name__}")
    return loaded


def _choose(file: InputFile, formats: Sequence[F], unfit: Sequence[tuple[Sniff, str]] = ()) -> F:
    """Return the format of a file by the three rules above, or refuse it."""
    if file.path.is_dir():
        folders = [each for each in formats if each.folder]
        if folders:
            return folders[0]
        raise file.refusal("a directory")
    suffix = suffix_of(file.path)
    named = [each for each in formats if suffix in each.suffixes]
    fitting = chain(
        (each for each in named if each.accepts(file.head)),
        (each for each in named if each.sniff is None),
        (each for each in formats if each.accepts(file.head)),
    )
    chosen = next(fitting, None)
    if chosen is not None:
        return chosen
    reasons = [reason for sniff, reason in unfit if sniff(file.head)]
    if reasons:
        raise file.refusal(reasons[0])
    found = describe_content(file.head, known_formats())
    if not named:
        found += f", and the suffix {suffix}" if suffix else ", and no suffix"
    raise file.refusal(found)
