"""What `rockshape measure` was asked for of one image."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rockshape.errors import InputError
from rockshape.method import find_method, methods
from rockshape.point_grid.range_kinds import RangeKind
from rockshape.point_grid.units import parse_length
from rockshape.rock.level_ground import LevelGround
from rockshape.rock.pieces import Pieces


@dataclass(frozen=True)
class MeasureOptions:
    """What `rockshape measure` was asked for; None where a file was not named."""

    image: Path
    range: Path | None
    range_kind: RangeKind | None
    range_unit: str | None
    right: Path | None
    camera: Path | None
    camera_view: str | None
    labels: Path | None
    instances: Path | None
    pieces: Pieces
    ignore: Path | None
    max_pixels: int
    find: str | None
    method: str
    descriptors: bool
    sizes: bool
    scale: str | None
    camera_height: str | None
    tilt: float | None
    flags: bool
    uncertainty: bool
    out: Path | None
    labels_out: Path | None
    overlay: Path | None
    report: Path | None
    map: Path | None
    model: Path | None
    json: bool
    quiet: bool

    @property
    def given_labels(self) -> Path | None:
        """Labels that were given one way or the other. Raises: InputError for both."""
        if self.labels is not None and self.instances is not None:
            raise InputError("--instances: expected it without --labels, found both")
        return self.instances if self.labels is None else self.labels

    @property
    def level_ground(self) -> LevelGround | None:
        """Level ground that was told. Raises: InputError for a height or a tilt alone."""
        if self.camera_height is None and self.tilt is None:
            return None
        if self.camera_height is None or self.tilt is None:
            alone = "--tilt" if self.camera_height is None else "--camera-height"
            raise InputError(f"{alone}: expected --camera-height and --tilt together, found one")
        height_m = parse_length(self.camera_height, what="--camera-height", example="1.5m")
        return LevelGround(height_m, self.tilt)

    def check_uncertainty(self) -> None:
        """Raises: InputError if it is asked of a method that does not estimate it."""
        if self.uncertainty and not find_method(self.method).estimated:
            able = ", ".join(name for name, method in methods().items() if method.estimated)
            raise InputError(
                f"--uncertainty: expected a method that estimates it ({able}), found {self.method}"
            )

    def choices(self) -> dict[str, Any]:
        """What was chosen beside the files, by the options' names."""
        names = (
            "range_kind", "range_unit", "camera_view", "pieces", "max_pixels", "find", "method",
            "descriptors", "sizes", "scale", "camera_height", "tilt", "flags", "uncertainty",
        )  # fmt: skip
        return {name: getattr(self, name) for name in names}

    def inputs(self) -> dict[str, Path]:
        """Files that are read, by what they are."""
        files = {
            "image": self.image,
            "labels": self.given_labels,
            "range": self.range,
            "right": self.right,
            "camera": self.camera,
            "ignore": self.ignore,
        }
        return {role: path for role, path in files.items() if path is not None}
