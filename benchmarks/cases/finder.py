"""Finder by a network: time beside a plain watershed of dark gaps."""

import cv2
from case import Case, Column, Table
from timing import TIME_COLUMNS, best_of

from rockshape.inputs.arrays import observe
from rockshape.segmentation import FINDERS
from synth.bed.make import make_tile
from synth.spec.bed import BedSpec
from validation.peers.finders import PEER_FINDERS

SIDES_PX = (256, 512, 1024)


def speed(*, sides_px: tuple[int, ...] = SIDES_PX, rounds: int = 3) -> list[Table]:
    """Time the finder on made gravel beds of several sizes."""
    rows = []
    for side in sides_px:
        bed = make_tile(BedSpec(seed=10_000, width_px=side, height_px=side), 0)
        seen = observe(bed.image)
        works = {
            "watershed of dark gaps": lambda seen=seen: PEER_FINDERS["top-hat"].segment(seen),
            "network": lambda seen=seen: FINDERS["network"].segment(seen),
            "network without colour": lambda seen=seen: FINDERS["network"].segment(
                observe(seen.image)
            ),
        }
        cv2.setNumThreads(2)
        times = best_of(rounds, works)
        floor = times["watershed of dark gaps"]
        megapixels = side * side / 1e6
        for name, spent in times.items():
            rows.append((f"{side} × {side}", name, *spent.cells(floor), spent.wall_s / megapixels))
    columns = (
        Column("picture", "px"),
        Column("finder"),
        *TIME_COLUMNS,
        Column("wall, of a megapixel", "s", ".2f"),
    )
    return [Table(columns, rows)]


FINDER_SPEED_CASE = Case(
    name="finder_speed",
    what="time of the finder by a network on made gravel beds",
    run=speed,
    smallest={"sides_px": (64,), "rounds": 1},
    peer="a watershed of the black top-hat",
    threads=2,
)
