"""Segmentation experiment: rocks on the ground, found in several ways."""

from typing import Annotated, Any

from msgspec import Meta

from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.kinds.segmentation.sources import source_of, split_series
from validation.suite.scene import check_scene_is_single
from validation.suite.scenes_experiment import ScenesExperiment


class SegmentationExperiment(ScenesExperiment, frozen=True, kw_only=True, tag="segmentation"):
    """Rocks on the ground, segmented in several ways: variants of ours beside plain baselines.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i. A rock counts where
    it is so wide, so visible and wholly in the frame; from noisy range also only where it is so
    high in standard deviations of its depth, not too far, and half of it has range.
    """

    series: Annotated[tuple[str, ...], Meta(min_length=1)]  # a way and the range it is given
    min_iou: Annotated[float, Meta(ge=0.5, le=1)] = 0.5
    min_width_px: Annotated[int, Meta(ge=1)] = 12
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.5
    min_height_sigma: Annotated[float, Meta(ge=0)] = 4.0
    max_depth_m: Annotated[float, Meta(gt=0)] = 8.0
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # scenes shown in the report

    def __post_init__(self) -> None:
        """Leave one place for seed and number of scenes, and ask for range that the scene has."""
        super().__post_init__()
        check_scene_is_single(self.scene)
        for series in self.series:
            way, source = split_series(series)
            if not way:
                raise ValueError(
                    f"series: expected a way and its range, robust-exact say, found {series!r}"
                )
            if source_of(series).is_sensed and source != self.scene.noise.kind:
                raise ValueError(
                    f"series: {series!r} needs scene.noise.kind {source!r}, "
                    f"found {self.scene.noise.kind!r}"
                )

    def dependencies(self, _series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on."""
        plain = self.plain(without=("title", "scenes", "pictured"))
        return plain | {"pictured": scene < self.pictured}

    def check(self) -> None:
        """Check that every way is known, and is given range where it looks at range alone.

        Raises:
            InputError: one that is not.
        """
        # brings SciPy and scikit-image, which a parser needs not
        from validation.kinds.segmentation.ways import fits_source, known_ways  # noqa: PLC0415

        for series in self.series:
            way, source = split_series(series)
            if way not in known_ways():
                raise InputError(f"series: {expected_one_of(way, known_ways())}")
            if not fits_source(way, source_of(series)):
                raise InputError(f"series: expected other range for {way}, found {source!r}")
