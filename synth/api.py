"""Public functions: scenes, gravel beds and drawn shapes of known truth."""

from collections.abc import Iterator, Sequence
from typing import Unpack

import pandas as pd

from synth.bed.bed import Bed
from synth.bed.make import make_tile
from synth.bed.options import BedOptions, BedSource, bed_spec_of
from synth.bed.tiles import tiles
from synth.errors import SpecError
from synth.handle.options import SceneOptions, SpecSource, spec_of
from synth.handle.scene import Scene
from synth.handle.shapes import DrawnShapes
from synth.shapes.draw import DrawingOptions, draw_named_series
from synth.spec.shapes import JITTER_RMS_PX


def make_scene(
    spec: SpecSource | None = None, *, index: int = 0, **options: Unpack[SceneOptions]
) -> Scene:
    """Scene of rocks of known shape, to be rendered view by view.

    >>> scene = make_scene(rocks=6, camera="msl-navcam", seed=1)
    >>> view = scene.render(0, noise="stereo")

    `spec` is a path to a TOML file, a `SceneSpec` or a dict of its tables; without it every key
    has its default. `index` is the scene's number in a dataset of several. The options are laid
    over the specification: `seed`, `scenes`, `renderer`; `rocks` (count), `family` and `series` of
    the rocks, `views` (count), `camera` (preset), `noise` (sensor), `population` (kind); each of
    these, and `ground`, `surface`, `sun`, `sensor`, `calibration`, `dataset` and `truth`, may also
    be a dict with keys of its table.

    Raises:
        SpecError: an unknown option, key or value, named with the one that was probably meant.
    """
    return Scene(spec_of(spec, options), index=index)


def make_shapes(
    series: str = "roundness",
    *,
    count: int | None = None,
    knobs: Sequence[float] | None = None,
    seed: int = 0,
    jitter_rms_px: float = JITTER_RMS_PX,
    size_px: float | None = None,
    turn_deg: float = 0.0,
) -> DrawnShapes:
    """Drawn shapes of a series.

    `series` is `roundness`, `sphericity`, `both`, `krumbein`, `rough`, `rippled` or `jagged`.
    The series' parameter rises in `count` even steps (4 by default) or takes the values `knobs`.
    `size_px` (30 to 1000) makes it the long side of each shape, `turn_deg` turns the shapes.
    The truth is the exact outline's, from which the pen strays by `jitter_rms_px` pixels RMS.

    Raises:
        SpecError: an unknown series, or a count, values, seed or jitter out of range.
    """
    if seed < 0:
        raise SpecError(f"seed: expected 0 or more, found {seed}")
    options = DrawingOptions(
        count=count,
        knobs=None if knobs is None else tuple(knobs),
        seed=seed,
        jitter_rms_px=jitter_rms_px,
        size_px=size_px,
        turn_deg=turn_deg,
    )
    _, drawing = draw_named_series(series, **options)
    truth = pd.DataFrame(drawing.rows).rename(columns={"rock": "id"}).astype({"id": int})
    truth.insert(1, "series", series)
    return DrawnShapes(
        image=drawing.image, labels=drawing.labels, truth=truth, series=series, options=options
    )


def make_bed(
    spec: BedSource | None = None, *, index: int = 0, **options: Unpack[BedOptions]
) -> Bed:
    """Gravel bed from above or obliquely: picture, labels, heights and the truth of each grain.

    >>> bed = make_bed(seed=1, grains={"median_px": [15, 30]}, ground={"kinds": ["sand"]})

    `spec` is a path to a TOML file, a `BedSpec` or a dict of its tables; without it every key has
    its default. `index` is the tile's number in a set; any number will do. The options are keys
    and tables of the specification and are laid over it.

    Raises:
        SpecError: an unknown option, key or value, named with the one that was probably meant.
    """
    if index < 0:
        raise SpecError(f"index: expected 0 or more, found {index}")
    return make_tile(bed_spec_of(spec, options, where="make_bed"), index)


def make_beds(
    spec: BedSource | None = None,
    *,
    start: int = 0,
    jobs: int = 1,
    **options: Unpack[BedOptions],
) -> Iterator[Bed]:
    """Tiles of a set in turn, without touching the disk: the first is number `start`.

    There are `tiles` of them, a key of the specification. With several `jobs` processes make
    them; the tiles and their order stay the same, and no more than a few wait in memory.

    Raises:
        SpecError: an unknown option, key or value, named with the one that was probably meant.
    """
    if start < 0:
        raise SpecError(f"start: expected 0 or more, found {start}")
    if jobs < 1:
        raise SpecError(f"jobs: expected 1 or more, found {jobs}")
    chosen = bed_spec_of(spec, options, where="make_beds")
    return tiles(chosen, start=start, jobs=jobs)
