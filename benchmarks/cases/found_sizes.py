"""Median grain size from found grains of made beds: whether its interval covers the true one."""

from dataclasses import replace

import numpy as np
from case import Case, Column, Table

import rockshape
from rockshape.method import PAPER
from rockshape.samples.percentiles import bootstrap_percentiles, interval, percentiles
from rockshape.samples.sample import FOUND_SD
from synth.bed.make import make_tile
from synth.spec.bed import convert_bed_spec
from validation.records.object_matching import whole_and_wide

SEED = 10_000
LEVEL = 0.9
MIN_WIDTH_PX = 12.0
MIN_GRAINS = 10  # of both, in a bed
SIZE = "minor_axis_px"
SIZES_ALONE = replace(PAPER, measures=())
KINDS = {
    "beds": {},
    "packed": {"grains": {"cover": [1.6, 3.0], "median_px": [14, 28]}},
    "oblique": {"tilt_deg": [15, 50]},
    "half covered": {"ground": {"filled": 1.0}, "grains": {"burial": [0.1, 0.7]}},
}


def found_sizes(*, tiles: int = 100) -> list[Table]:
    """Find the grains of beds of four kinds, so many of each, and compare D50 with the masks'."""
    rows = []
    for title, keys in KINDS.items():
        size = {"width_px": 384, "height_px": 384, "seed": SEED}
        spec = convert_bed_spec({**size, **keys}, where=title)
        ratios, widths, covered, counted = [], [], [], []
        for number in range(tiles):
            bed = make_tile(spec, number)
            true = _sizes(bed.image, labels=bed.labels.astype(np.int32))
            found = _sizes(bed.image, find="network")
            if min(len(true), len(found)) < MIN_GRAINS:
                continue
            median, own = (
                percentiles(each, np.ones(len(each)), (50.0,))[0] for each in (true, found)
            )
            (low, high), (plain_low, plain_high) = (
                interval(
                    bootstrap_percentiles(
                        found, 0.0, (50.0,), sd=None, common_sd=common, draws=400
                    ),
                    LEVEL,
                )[:, 0]
                for common in (FOUND_SD, 0.0)
            )
            ratios.append(own / median)
            widths.append((high - low) / own)
            covered.append(low <= median <= high)
            counted.append(plain_low <= median <= plain_high)
        rows.append(
            (
                title,
                len(ratios),
                100 * float(np.mean(np.array(ratios) - 1)),
                100 * float(np.std(ratios)),
                100 * float(np.median(widths)),
                100 * float(np.mean(covered)),
                100 * float(np.mean(counted)),
            )
        )
    columns = (
        Column("beds"),
        Column("of ten grains and more", "", "d"),
        Column("D50 found over true − 1", "%", "+.1f"),
        Column("its spread", "%", ".1f"),
        Column("width of the 90 % interval", "%", ".0f"),
        Column("beds whose interval covers", "%", ".0f"),
        Column("without what finding does", "%", ".0f"),
    )
    return [Table(columns, rows)]


def _sizes(
    image: np.ndarray, *, labels: np.ndarray | None = None, find: str | None = None
) -> np.ndarray:
    """Minor axes of the grains that are whole in the frame and wide enough, px."""
    found = rockshape.measure(image, labels=labels, find=find, sizes=True, method=SIZES_ALONE)
    counts = whole_and_wide(found.labels, MIN_WIDTH_PX)
    table = found.to_frame()
    sizes = table.loc[[bool(counts[number]) for number in table["rock"]], SIZE]
    return sizes.dropna().to_numpy(np.float64)


FOUND_SIZES_CASE = Case(
    name="found_sizes",
    what="D50 by number of grains that the network finds, against true masks; 400 made beds",
    run=found_sizes,
    smallest={"tiles": 1},
    slow=True,
)
