"""Outlines of the finders that lie where no rock is: in the sky, on things, on bare ground."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table

from rockshape.inputs.arrays import observe
from rockshape.segmentation import FINDERS
from synth import make_scene
from synth.things.record import CLASSES

FIRST_SEED = 10_000
LOW_CAMERA = {"preset": "sojourner", "distance_m": 3.5, "elevation_deg": 14.0}
LOOKING_UP = {**LOW_CAMERA, "target_m": [0.0, 0.0, 0.5]}  # a third of the frame is sky
THINGS = {"kinds": list(CLASSES)}
SITES: tuple[Mapping[str, Any], ...] = (
    {"site": "pathfinder", "camera": LOOKING_UP},
    {"site": "gale", "camera": LOOKING_UP},
    {"site": "dunes", "camera": LOOKING_UP},
    {"site": "pathfinder", "camera": LOW_CAMERA, "things": THINGS},
    {"site": "gale", "camera": LOW_CAMERA, "things": THINGS},
)
LEAST_PX = 100  # of a class, for a frame to show it
NAMES = ("image", "network")


def where_outlines_lie(*, seeds: int = 4, sites: int = len(SITES)) -> list[Table]:
    """Count outlines by what most of their pixels show, and the frames that show it."""
    seen_px: dict[str, list[int]] = {}
    outlines: dict[tuple[str, str], int] = {}
    for image, shown in _frames(seeds, SITES[-sites:]):
        seen = observe(image)
        for name, pixels in zip(*np.unique(shown, return_counts=True), strict=True):
            if pixels >= LEAST_PX:
                seen_px.setdefault(str(name), []).append(int(pixels))
        for finder in NAMES:
            labels = FINDERS[finder].segment(seen).labels
            for number in range(1, int(labels.max()) + 1):
                names, counts = np.unique(shown[labels == number], return_counts=True)
                key = (finder, str(names[counts.argmax()]))
                outlines[key] = outlines.get(key, 0) + 1
    rows: list[tuple[Cell, ...]] = []
    for name, pixels in sorted(seen_px.items(), key=lambda item: -sum(item[1])):
        found = (outlines.get((finder, name), 0) for finder in NAMES)
        rows.append((name, len(pixels), sum(pixels) / 1e6, *found))
    columns = (
        Column("what most of an outline shows"),
        Column("frames with it", "", "d"),
        Column("seen", "megapixels", ".3f"),
        *(Column(f"outlines, {finder}", "", "d") for finder in NAMES),
    )
    return [Table(columns, rows)]


def _frames(
    seeds: int, sites: tuple[Mapping[str, Any], ...]
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield pictures (rows, cols, 3), and what each pixel shows (rows, cols) by name."""
    for seed in range(FIRST_SEED, FIRST_SEED + seeds):
        for site in sites:
            scene = make_scene(
                {**site, "seed": seed}, image={"colour": True}, renderer="embree", views=1
            )
            view = scene.render(0)
            shown = np.full(view.labels.shape, "ground", dtype="<U16")
            shown[~np.isfinite(view.exact_depth_m)] = "sky"
            shown[view.labels > 0] = "rock"
            for name, number in CLASSES.items():
                shown[view.not_rock == number] = name
            yield view.image, shown


FINDER_FALSE_CASE = Case(
    name="finder_false",
    what="outlines where no rock is, on made sites with sky and with things",
    run=where_outlines_lie,
    smallest={"seeds": 1, "sites": 1},
    peer="the image branch",
)
