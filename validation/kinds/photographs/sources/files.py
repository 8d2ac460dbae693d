"""Picture files and their masks, by path."""

from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, Self

import msgspec
from msgspec import Meta, Struct

from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.kinds.photographs.sources.masked_picture import MaskedPicture, PictureSource

Text = Annotated[str, Meta(min_length=1)]


class PictureFile(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A picture, its mask and what the mask's values mean."""

    image: Text  # paths
    mask: Text
    kind: Text = "instances"  # of masks


class Files(PictureSource, frozen=True, kw_only=True, tag="files"):
    """Picture files of one's own."""

    files: Annotated[tuple[PictureFile, ...], Meta(min_length=1)]

    @property
    def count(self) -> int:
        """Number of files."""
        return len(self.files)

    @property
    def has_instances(self) -> bool:
        """Whether rocks are told apart in any file."""
        from validation.kinds.photographs.sources.masks import MASK_KINDS  # noqa: PLC0415

        return any(MASK_KINDS[file.kind].has_instances for file in self.files)

    def name(self, number: int) -> str:
        """File's name without its suffix."""
        return Path(self.files[number].image).stem

    def picture(self, _seed: int, number: int, /) -> MaskedPicture:
        """Picture and mask, read."""
        from validation.kinds.photographs.sources.masks import (  # noqa: PLC0415 (brings SciPy)
            MASK_KINDS,
            read_masked_picture,
        )

        file = self.files[number]
        return read_masked_picture(Path(file.image), Path(file.mask), MASK_KINDS[file.kind])

    def dependencies(self, number: int, /) -> dict[str, Any]:
        """Contents of both files, and what the mask's values mean."""
        file = self.files[number]
        return {
            "from": "files",
            "image": _digest(file.image),
            "mask": _digest(file.mask),
            "kind": file.kind,
        }

    def first(self, count: int) -> Self:
        """Source with at most so many files."""
        return msgspec.structs.replace(self, files=self.files[:count])

    def check(self) -> None:
        """Check the kinds of masks and that the files are there."""
        from validation.kinds.photographs.sources.masks import MASK_KINDS  # noqa: PLC0415

        for index, file in enumerate(self.files):
            if file.kind not in MASK_KINDS:
                what = expected_one_of(file.kind, MASK_KINDS)
                raise InputError(f"pictures.files[{index}].kind: {what}")
            for path in (file.image, file.mask):
                if not Path(path).is_file():
                    raise InputError(f"pictures.files[{index}]: expected a file {path}, found none")


def _digest(path: str) -> str:
    try:
        return sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise InputError(f"{path}: expected a picture or mask, found {error.strerror}") from error
