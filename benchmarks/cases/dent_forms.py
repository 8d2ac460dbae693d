"""Form of rocks with as many dents as scanned rocks have, beside the scans."""

import numpy as np
from case import Case, Column, Table
from cases.rock_forms import HEADS, SEED, form_row, scan_rows
from rock_statistics import solid_statistics

from synth.rocks import quarry
from synth.spec.rocks import RocksSpec

# Fitted by the median volume over the hull's to the scans that are not held out, seeds 0 to 7.
DENTS = {"lumpy": (60, 100), "broken": (40, 90), "vesicular": (35, 80), "slab": (30, 75)}


def dent_forms(*, families: int = len(DENTS), rocks: int = 8) -> list[Table]:
    """Median and quartiles of each statistic, of scans and of families with dents."""
    rows = scan_rows()
    for family, dents in list(DENTS.items())[:families]:
        spec = RocksSpec(
            count=rocks,
            family=family,
            series="random",
            b_over_a=(0.55, 0.95),
            c_over_b=(0.55, 0.95),
            options={"subdivisions": 5, "dents": dents},
        )
        made = quarry(spec, rng=np.random.default_rng(SEED))
        name = f"{family}, `dents` = [{dents[0]}, {dents[1]}]"
        rows.append(form_row(name, [solid_statistics(rock.mesh) for rock in made]))
    columns = (Column("rocks"), Column("number", "", "d"), *map(Column, HEADS.values()))
    return [Table(columns, rows)]


DENT_FORMS_CASE = Case(
    name="dent_forms",
    what="form of rocks with as many dents as scans have, beside the scans",
    run=dent_forms,
    smallest={"families": 1, "rocks": 1},
)
