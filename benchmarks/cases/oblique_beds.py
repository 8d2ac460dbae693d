"""Oblique gravel beds: processor time by tilt, beside the same bed from straight above."""

from functools import partial

import numpy as np
from case import Case, Column, Table
from cases.beds import crowded
from msgspec import structs
from timing import best_of

from synth.bed.make import make_tile
from synth.spec.bed import BedSpec

_TILTS_DEG = (0.0, 20.0, 45.0, 60.0, 70.0)


def tilted(
    *, side_px: int = 256, bodies: int = 250, tiles: int = 6, rounds: int = 4
) -> list[Table]:
    """Time tiles whose grains have a median of 17 px; their stock is made before."""
    spec = crowded(side_px, bodies)
    specs = {tilt: structs.replace(spec, tilt_deg=(tilt, tilt)) for tilt in _TILTS_DEG}
    seen = {
        tilt: np.mean([len(make_tile(one, number).rocks) for number in range(tiles)])
        for tilt, one in specs.items()
    }

    def make(one: BedSpec) -> None:
        for number in range(tiles):
            make_tile(one, number)

    times = best_of(rounds, {f"{tilt:g}": partial(make, one) for tilt, one in specs.items()})
    rows = [
        (
            tilt,
            seen[tilt],
            1e3 * times[f"{tilt:g}"].cpu_s / tiles,
            tiles / times[f"{tilt:g}"].cpu_s,
            times[f"{tilt:g}"].cpu_s / times["0"].cpu_s,
        )
        for tilt in _TILTS_DEG
    ]
    columns = (
        Column("tilt", "°", ".0f"),
        Column("grains in sight", "", ".0f"),
        Column("processor", "ms", ".0f"),
        Column("tiles a second and core", "", ".1f"),
        Column("times that from above", "", ".1f"),
    )
    return [Table(columns, rows)]


OBLIQUE_BEDS_CASE = Case(
    name="oblique_beds",
    what="tiles of a gravel bed by the tilt of the line of sight, 4 samples a pixel",
    run=tilted,
    smallest={"side_px": 64, "bodies": 10, "tiles": 1, "rounds": 1},
)
