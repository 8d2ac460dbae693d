"""Packing of one tile's bed: ground, grains in their places, and the view of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.bed.picture.light import BedLight, LitRelief
from synth.bed.relief.bodies import body_library
from synth.bed.relief.ground import fill, ground_maps, make_ground
from synth.bed.relief.packing import Footprint, Grain, HeightField, pack
from synth.bed.relief.sizes import draw_grains, draw_law
from synth.bed.view.above import ViewFromAbove
from synth.bed.view.frame import ObliqueFrame, bed_rows_needed
from synth.bed.view.oblique import oblique_view
from synth.bed.view.whole import WholeOutline
from synth.spec.bed import BedGround, BedSpec

MARGIN_PX = 16  # of bed round the tile, so that its edge is lit and covered like its middle


class BedView(Protocol):
    """What a camera sees of a bed, on samples finer than pixels."""

    @property
    def grain(self) -> NDArray[np.int32]:
        """Grain in sight (rows, cols), 0 for the ground, else 1 + the grain's index."""
        ...

    @property
    def tint(self) -> Singles:
        """Log-brightness of the ground (rows, cols)."""
        ...

    def outline(self, index: int) -> WholeOutline:
        """Whole outline of a grain."""
        ...

    def mask(self, index: int) -> tuple[tuple[int, int], NDArray[np.bool_]]:
        """Whole mask of a grain on the view's samples, and the row and column of its first."""
        ...

    def shine(self, relief_px: Sequence[Singles], light: BedLight, *, albedo: float) -> LitRelief:
        """Light on the bed with fine relief of the rocks laid over it."""
        ...


@dataclass(frozen=True, eq=False)
class PackedBed:
    """Bed of one tile."""

    grains: Sequence[Grain]
    places: Sequence[Footprint]
    ground: BedGround
    filled: bool
    tilt_deg: float  # of the line of sight from the vertical
    view: BedView


def pack_bed(spec: BedSpec, rng: Mapping[str, np.random.Generator]) -> PackedBed:
    """Bed of a tile whose parts draw from generators of their own."""
    per_px = spec.supersample
    rows, columns = (per_px * (side + 2 * MARGIN_PX) for side in (spec.height_px, spec.width_px))
    tilt_deg = float(rng["view"].uniform(*spec.tilt_deg))
    law = draw_law(spec.grains, rng["grains"])
    tilt_rad = np.deg2rad(tilt_deg)
    relief_px = min(law.relief_px(spec.grains), float(spec.height_px))
    shape = (bed_rows_needed(rows, tilt_rad, relief_px=relief_px, per_px=per_px), columns)
    kind = spec.ground.kinds[int(rng["ground"].integers(len(spec.ground.kinds)))]
    ground, tint = make_ground(
        kind,
        shape,
        samples_per_px=per_px,
        relief=float(rng["ground"].uniform(*spec.ground.relief)),
        maps=ground_maps(spec.seed),
        rng=rng["ground"],
    )
    level = float(rng["ground"].uniform(*spec.ground.fill))
    filled = bool(rng["ground"].uniform() < spec.ground.filled)
    library = body_library(spec.seed, spec.bodies)
    area_px2 = shape[0] * shape[1] / per_px**2
    grains = draw_grains(spec.grains, law, library, area_px2, rng["grains"])
    field = HeightField(ground.copy(), np.zeros(shape, np.int32), per_px, MARGIN_PX)
    places = pack(field, grains, rng["packing"])
    if filled and grains:
        ground = np.maximum(ground, fill(field.height_px, field.grain, ground, level))
    view: BedView
    if tilt_deg > 0.0:
        frame = ObliqueFrame(
            tilt_rad=tilt_rad,
            per_px=per_px,
            margin_px=MARGIN_PX,
            offset=float(np.floor(field.height_px[0].min() * per_px * np.sin(tilt_rad))),
            shape=(rows, columns),
        )
        view = oblique_view(field, ground, tint, grains=grains, places=places, frame=frame)
    else:
        view = ViewFromAbove(field, tint, grains, places)
    return PackedBed(grains, places, kind, filled, tilt_deg, view)
