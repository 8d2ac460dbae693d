"""Pictures of docs/segmentation.md: steps, methods side by side, Mars, best and worst views."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import cv2
import matplotlib as mpl
import msgspec
import numpy as np
import pandas as pd
from cases.segmentation import field
from suites import chosen_suite
from views import made_views

import validation
from rockshape.io import read_image, read_range
from rockshape.observation import Observation, locate_camera
from rockshape.outline.trace import trace_outline
from rockshape.segmentation import FINDERS, Segmentation
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_range.height_signal import standing
from rockshape.segmentation.robust import find_by_range, ground_among_rocks, heights_over
from validation.kinds.segmentation.work import draw as draw_both
from validation.scores.object_scores import f1_of

mpl.use("Agg")
from matplotlib import pyplot as plt

MARS = Path(__file__).parents[2] / "examples" / "mars"
RANGE_COLOUR, IMAGE_COLOUR = (255, 209, 56), (255, 120, 255)
SERIES = ("robust-exact", "robust-stereo", "robust-sgm", "robust-none")
MIN_ROCKS = 5  # rocks that count in a view
SKY_ROWS = 200
GREY: dict[str, Any] = {"cmap": "gray", "vmin": 0, "vmax": 1}
Panel = tuple[str, np.ndarray, Mapping[str, Any]]


def draw(folder: Path, part: str) -> None:
    """Write segmentation_PART.jpg."""
    panels, columns, top = {
        "steps": lambda: (_steps(), 3, SKY_ROWS),
        "ways": lambda: (_ways(), 3, SKY_ROWS),
        "mars": lambda: (_three("", _mars()), 3, 0),
        "cases": lambda: (_cases(), 2, SKY_ROWS),
    }[part]()
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(4.2 * columns, 3.5 * rows), dpi=100, layout="constrained"
    )
    for axis, (title, picture, options) in zip(axes.ravel(), panels, strict=False):
        axis.imshow(picture[top:], interpolation="nearest", **options)
        axis.set_title(title, fontsize=9)
        axis.set_axis_off()
    figure.savefig(folder / f"segmentation_{part}.jpg", pil_kwargs={"quality": 70})
    plt.close(figure)


def _steps() -> list[Panel]:
    """Return the steps of the robust method on a crowded field whose pictures were matched."""
    seen = field(0.2, noise="sgm")
    ground = ground_among_rocks(seen)
    relief, lightness = heights_over(seen, ground), read_lightness(seen.image)
    labels = find_by_range(relief, ground)
    colours = np.random.default_rng(3).uniform(0.25, 1, (int(labels.max()) + 1, 3))
    colours[0] = 0
    kinds = np.where(lightness.cast, 2, lightness.unlike.astype(int))
    signal = np.where(relief.known, np.clip(relief.signal, -5, 40), np.nan)
    unlike = np.array([[0.0, 0, 0], [0.85, 0.85, 0.85], [0.2, 0.45, 1.0]])[kinds]
    return [
        ("1  the image", seen.image, GREY),
        ("2  height above the ground over its noise", signal, {"cmap": "viridis"}),
        ("3  what stands: 2.5 σ, somewhere 5 σ", standing(relief), {"cmap": "gray"}),
        ("4  split at valleys and depth jumps", colours[labels], {}),
        ("5  unlike the ground; blue: cast shadow", unlike, {}),
        ("6  rocks, at the image's edges", outlined(seen, FINDERS["both"].segment(seen)), {}),
    ]


def _ways() -> list[Panel]:
    """Return the published and the robust method on a scene of each kind."""
    ripples = {"ripple_height_m": 0.05, "ripple_length_m": 0.6}
    scenes = {
        "sparse": field(0.06),
        "crowded": field(0.3),
        "slope": field(0.1, ground={"slope_deg": 14, "burial": [0, 0.4]}),
        "ripples": field(0.08, ground=ripples),
        "low sun": field(0.1, sun={"elevation_deg": 14.0, "ambient": 0.2}),
        "matched": field(0.2, noise="sgm"),
    }
    return [panel for name, seen in scenes.items() for panel in _three(f"{name}: ", seen)]


def _three(title: str, seen: Observation) -> list[Panel]:
    """Return a frame as published, robust, and robust without range."""
    blind = Observation(image=seen.image, camera=seen.camera)
    return [
        (f"{title}{name}", outlined(given, FINDERS[finder].segment(given)), {})
        for name, given, finder in (
            ("published", seen, "published"),
            ("robust", seen, "both"),
            ("robust, without range", blind, "both"),
        )
    ]


def _mars() -> Observation:
    image = read_image(MARS / "i944014r.png")
    points_m = read_range(MARS / "i944014r_xyz.npz", shape=image.shape, camera=None)
    return locate_camera(Observation(image=image, points_m=points_m))


def _cases() -> list[Panel]:
    """Return the best and the worst view of each kind of range: truth blue, found yellow."""
    suite = chosen_suite("segmentation")
    records = validation.run(suite, jobs=2).records
    panels: list[Panel] = []
    for series in SERIES:
        own = records[(records["series"] == series) & (records["experiment"] != "imp")]
        scores = {
            place: f1_of(rows["status"].to_numpy())
            for place, rows in own.groupby(["experiment", "scene", "view"])
            if _enough(rows)
        }
        for (name, scene, view), score in (
            max(scores.items(), key=lambda one: one[1]),
            min(scores.items(), key=lambda one: one[1]),
        ):
            experiment = next(one for one in suite.experiments if one.name == name)
            spec = msgspec.structs.replace(experiment.scene, seed=experiment.seed + int(scene))
            made = list(made_views(spec))[int(view)]
            seen = made.exact if series.endswith("exact") else made.observation
            if series.endswith("none"):
                seen = Observation(image=seen.image, camera=seen.camera)
            labels = FINDERS["both"].segment(seen).labels
            title = f"{series}: {name}, scene {scene}, view {view}: F1 {score:.2f}"
            panels.append((title, draw_both(seen.image, made.labels, labels), {}))
    return panels


def _enough(rows: pd.DataFrame) -> bool:
    return bool(rows["status"].isin(["matched", "missed"]).sum() >= MIN_ROCKS)


def outlined(seen: Observation, found: Segmentation) -> np.ndarray:
    """Return the image with outlines, yellow where range found a rock and pink where the image."""
    grey = np.clip(np.rint(seen.image * 255), 0, 255).astype(np.uint8)
    canvas = np.repeat(grey[..., None], 3, axis=2)
    thick = max(1, round(max(canvas.shape) / 500))
    for one in found.found:
        traced = one.outline is None
        ring = trace_outline(found.labels == one.number) if traced else one.outline.points_px
        colour = RANGE_COLOUR if one.branch == "range" else IMAGE_COLOUR
        fixed = np.rint(ring * 16).astype(np.int32)
        cv2.polylines(canvas, [fixed], True, colour, thick, cv2.LINE_AA, shift=4)
    return canvas
