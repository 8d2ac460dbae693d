"""Gravel beds: tiles a second and core, beside a floor that no such generator can go below."""

import cv2
import numpy as np
from case import Case, Column, Table
from msgspec import structs
from timing import best_of

from synth.bed.make import make_tile
from synth.bed.relief.bodies import body_library
from synth.spec.bed import BedGroundSpec, BedSpec, GrainsSpec


def crowded(side_px: int, bodies: int) -> BedSpec:
    """Bed of grains of 17 px, about 200 in sight on a tile of 256 px."""
    return BedSpec(
        width_px=side_px,
        height_px=side_px,
        bodies=bodies,
        grains=GrainsSpec(median_px=(17.0, 17.0), spread=(0.4, 0.4), cover=(1.6, 1.6)),
        ground=BedGroundSpec(filled=0.0),
    )


def tiles(*, side_px: int = 256, bodies: int = 250, rounds: int = 5) -> list[Table]:
    """Time tiles of about 200 grains in sight, without the stock of bodies, made once a process."""
    spec = crowded(side_px, bodies)
    plain = structs.replace(spec, supersample=1)
    numbers = range(8)
    bed = make_tile(spec, 0)
    found = {
        name: np.mean([len(make_tile(one, number).rocks) for number in numbers])
        for name, one in (("4 samples a pixel", spec), ("1 sample a pixel", plain))
    }
    maps = body_library(spec.seed, spec.bodies)[0].maps
    dropped = int(bed.conditions["grains_dropped"])

    def floor() -> None:
        for _ in numbers:
            for _ in range(dropped):
                cv2.resize(maps, (40, 40))
            cv2.imencode(".jpg", bed.image)

    def make(one: BedSpec) -> None:
        for number in numbers:
            make_tile(one, number)

    times = best_of(
        rounds,
        {
            "4 samples a pixel": lambda: make(spec),
            "1 sample a pixel": lambda: make(plain),
            "floor": floor,
        },
    )
    rows = [
        (
            name,
            found.get(name),
            1e3 * time.cpu_s / len(numbers),
            len(numbers) / time.cpu_s,
            time.cpu_s / times["floor"].cpu_s,
        )
        for name, time in times.items()
    ]
    columns = (
        Column("tile"),
        Column("grains in sight", "", ".0f"),
        Column("processor", "ms", ".0f"),
        Column("tiles a second and core", "", ".1f"),
        Column("ratio", "", ".1f"),
    )
    return [Table(columns, rows)]


BEDS_CASE = Case(
    name="beds",
    what="tiles of a gravel bed with about 200 grains in sight",
    run=tiles,
    smallest={"side_px": 64, "bodies": 10, "rounds": 1},
    peer="one cv2.resize of each grain's maps to 40 × 40 px, and the JPEG",
)
