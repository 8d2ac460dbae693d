"""Garden experiment: a field of rocks seen frame by frame from one mast."""

from validation.kinds.multiview.spec import MultiviewExperiment


class GardenExperiment(MultiviewExperiment, frozen=True, kw_only=True, tag="garden"):
    """Frames side by side from one place, as the paper's tables 4 and 5; a rock is in some."""

    def __post_init__(self) -> None:
        """Ask for frames from one place, and for no sweep."""
        super().__post_init__()
        if self.scene.views.path != "pan":
            raise ValueError(f"scene.views.path: expected 'pan', found {self.scene.views.path!r}")
        if self.sweep is not None:
            raise ValueError("sweep: expected none in a garden")
