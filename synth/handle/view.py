"""View of a scene: image, depth, labels, camera and truth."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from synth.arrays import ColourImage, DepthImage, Image, LabelImage, NormalImage
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.handle.html import figure_html

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class View:
    """One rendered view; its arrays are what a reader of the dataset would have."""

    image: Image | ColourImage  # (rows, cols), in colour (rows, cols, 3); with the sensor's noise
    depth_m: DepthImage  # (rows, cols), as measured; NaN in holes
    exact_depth_m: DepthImage  # (rows, cols), without the sensor's errors
    normals: NormalImage | None  # (rows, cols, 3), where the specification asks for them
    labels: LabelImage  # (rows, cols), the value of a rock's `id` in `truth`, 0 elsewhere
    not_rock: NDArray[np.uint8]  # (rows, cols), class of the thing seen, 0 elsewhere
    camera: RenderCamera  # as reported: with the errors of calibration, if the spec has them
    pose: Pose  # likewise
    exact_camera: RenderCamera
    exact_pose: Pose
    truth: "pd.DataFrame"  # one row a rock
    pictures: Mapping[str, Image]  # further images of the sensor, by name
    number: int  # of the view in its scene
    noise: str  # name of the sensor

    def plot(self) -> "Figure":
        """Figure of the image with the rocks' labels, and of the depth."""
        from matplotlib.figure import Figure  # noqa: PLC0415 - half a second that few need

        figure = Figure(figsize=(10, 4.5), layout="constrained")
        left, right = figure.subplots(1, 2)
        left.imshow(self.image if self.image.dtype == np.uint8 else self.image >> 8, cmap="gray")
        rock = np.ma.masked_equal(self.labels, 0)
        left.imshow(rock % 20, cmap="tab20", alpha=0.35, interpolation="nearest")
        left.set_title(f"{len(self.truth)} rocks")
        depth = right.imshow(self.depth_m, cmap="viridis")
        right.set_title(f"depth, {self.noise}")
        figure.colorbar(depth, ax=right, label="z-depth, m")
        for axes in (left, right):
            axes.set_xticks([])
            axes.set_yticks([])
        return figure

    def __repr__(self) -> str:
        """Return the view's number, size, rocks in sight and range of depth."""
        rows, cols = self.labels.shape
        seen = len(np.unique(self.labels[self.labels > 0]))
        known = self.depth_m[np.isfinite(self.depth_m)]
        depth = f"{known.min():.1f} to {known.max():.1f} m" if known.size else "none"
        return (
            f"View({self.number}: {rows} × {cols} px, {seen} rocks in sight, depth {depth}, "
            f"noise {self.noise!r})"
        )

    def _repr_html_(self) -> str:
        """Return the image and the depth beside the truth, for a notebook."""
        return figure_html(self.image, self.depth_m, caption=repr(self), table=self.truth)
