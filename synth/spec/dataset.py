"""Parameters of a dataset as a whole: folders, split and labels for training."""

from typing import Annotated, Literal

from msgspec import UNSET, Meta, Struct, UnsetType

LayoutName = Literal["scenes", "bop"]
HoleValue = Literal["0", "65535", "-9999", "inf", "nan"]


class DatasetSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Dataset: how its folders are laid out, and how its scenes are split for training."""

    layout: LayoutName = "scenes"  # bop: split folders, shared rocks, models centred on their boxes
    split: Annotated[float, Meta(gt=0, lt=1)] | None = None  # share of the scenes for training
    yolo: bool = False  # also images and label files as YOLO reads them; needs a split
    # Also range in metres, with this number where nothing was measured; not written to manifests
    # unless it is given.
    hole_value: HoleValue | UnsetType = UNSET

    def __post_init__(self) -> None:
        """Require a split for YOLO, whose data.yaml names a training and a validation set."""
        if self.yolo and self.split is None:
            raise ValueError("yolo: expected a split of the scenes (dataset.split), found none")

    @property
    def shared_rocks(self) -> bool:
        """Whether all scenes show the same rocks, as BOP's object ids ask for."""
        return self.layout == "bop"

    def training_scenes(self, scenes: int) -> int:
        """Number of scenes for training, the first ones; 0 without a split."""
        return 0 if self.split is None else round(self.split * scenes)
