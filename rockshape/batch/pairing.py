"""Files that go with each image of a batch: labels, range, cameras, by name."""

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, takewhile
from pathlib import Path

from rockshape.errors import InputError

STEM, NAME = "{stem}", "{name}"
_SEPARATORS = "_-. "


@dataclass(frozen=True)
class Companion:
    """One kind of file that goes with images, as it was given on the command line.

    A pattern with `{stem}` or `{name}` stands for the image's; of a folder the file is meant whose
    name is the image's up to its ending and a part after `_`, `-` or `.`; a file goes with all.
    """

    option: str  # --labels, say
    given: str

    def of(self, image: Path) -> Path:
        """File that goes with an image.

        Raises: InputError where there is none, or where several could be meant.
        """
        if _is_pattern(self.given):
            path = Path(self.given.replace(STEM, image.stem).replace(NAME, image.name))
            if not path.exists():
                raise InputError(f"{image}: expected {self.option} {path}, found no such file")
            return path
        folder = Path(self.given)
        return self._in_folder(image) if folder.is_dir() else folder

    def _in_folder(self, image: Path) -> Path:
        folder, own = Path(self.given), image.resolve()
        first = bisect_left(self._names, image.stem)
        named = [
            folder / name
            for name in takewhile(
                lambda name: name.startswith(image.stem), islice(self._names, first, None)
            )
            if (folder / name).resolve() != own
        ]
        same = [path for path in named if path.stem == image.stem]
        longer = [path for path in named if path.name[len(image.stem)] in _SEPARATORS]
        files = same or longer
        if len(files) != 1:
            found = ", ".join(path.name for path in files) or "none"
            raise InputError(
                f"{image}: expected one file for {self.option} in {folder}, found {found}"
            )
        return files[0]

    @cached_property
    def _names(self) -> list[str]:
        """Names in the folder, in order: listed once for all images."""
        return sorted(path.name for path in Path(self.given).iterdir())

    def rule(self) -> str:
        """How files are paired, in words."""
        if _is_pattern(self.given):
            return f"{self.option} by the pattern {self.given}"
        if Path(self.given).is_dir():
            return f"{self.option} by name from {self.given}"
        return f"{self.option} {self.given} for all"


def paired(
    images: Sequence[Path], companions: Mapping[str, Companion]
) -> tuple[dict[Path, dict[str, Path]], dict[Path, str]]:
    """Companions of each image, by their names in `companions`; and what lacks one, told.

    A file that goes with another image is none itself, so that masks may lie beside pictures.
    """
    found: dict[Path, dict[str, Path]] = {}
    lacking: dict[Path, str] = {}
    for image in images:
        try:
            found[image] = {name: each.of(image) for name, each in companions.items()}
        except InputError as error:
            lacking[image] = str(error)
    taken = {path.resolve() for files in found.values() for path in files.values()}
    return (
        {image: files for image, files in found.items() if image.resolve() not in taken},
        {image: told for image, told in lacking.items() if image.resolve() not in taken},
    )


def _is_pattern(given: str) -> bool:
    return STEM in given or NAME in given
