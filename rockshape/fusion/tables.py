"""Tables of fused rocks: one row a rock, and one row a rock and view."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from rockshape.fusion.fused_rock import FusedRock
from rockshape.fusion.posed_view import PosedView
from rockshape.measurement import AXES, to_frame
from rockshape.measures.reading import listed

PLACE = ("rock", "views", "x_m", "y_m", "z_m", "gap_deg", "boxed")


def columns(measures: Sequence[str]) -> tuple[str, ...]:
    """Columns of `rock_table` for measures: each with its uncertainty and spread over views."""
    own = [name for one in measures for name in (one, f"{one}_sd", f"{one}_view_sd")]
    return (*PLACE, *AXES, *own, "reason")


def rock_table(rocks: Sequence[FusedRock], views: Sequence[PosedView]) -> pd.DataFrame:
    """Table with the columns of `columns`, one row a rock.

    views counts those that see the rock; x_m, y_m and z_m are the middle of its points in the
    world; the axes are half-axes. `<name>_sd` is the standard error by the jackknife over views,
    `<name>_view_sd` the standard deviation between views. A value that no view has is NaN, and
    `reason` says why.
    """
    measured = [measure.column for measure in views[0].measurement.measures]
    names = columns(measured)
    rows = [_row(rock, views) for rock in rocks]
    whole = {"rock": "int64", "views": "int64", "boxed": "bool", "reason": "object"}
    return pd.DataFrame(
        {
            name: pd.Series([row[name] for row in rows], dtype=whole.get(name, "float64"))
            for name in names
        }
    )


def _row(rock: FusedRock, views: Sequence[PosedView]) -> dict[str, object]:
    row: dict[str, object] = {"rock": rock.number, "views": len(rock.sights)}
    row |= zip(("x_m", "y_m", "z_m"), rock.place_m, strict=True)
    row |= {"gap_deg": rock.gap_deg, "boxed": rock.boxed}
    row |= zip(AXES, rock.half_axes_m, strict=True)
    for name, told in rock.values.items():
        row |= {name: told.value, f"{name}_sd": told.sd, f"{name}_view_sd": told.view_sd}
    missing = [name for name, told in rock.values.items() if np.isnan(told.value)]
    sights = [views[each.view].rocks[each.rock].rock for each in rock.sights]
    reasons = [(name, one.readings[name].reason) for name in missing for one in sights]
    row["reason"] = listed((name, reason) for name, reason in reasons if reason)
    return row


def view_table(rocks: Sequence[FusedRock], views: Sequence[PosedView]) -> pd.DataFrame:
    """Table of every sight: `rock` as fused, `view`, `view_rock` its number there, and its row.

    Rocks of a view without range enough are left out, as they are of the fused rows.
    """
    parts = []
    for index, view in enumerate(views):
        fused = {
            view.rocks[each.rock].rock.number: rock.number
            for rock in rocks
            for each in rock.sights
            if each.view == index
        }
        own = to_frame(view.measurement).rename(columns={"rock": "view_rock"})
        own.insert(0, "rock", own["view_rock"].map(fused))
        own.insert(1, "view", view.name)
        parts.append(own[own["rock"].notna()].astype({"rock": "int64"}))
    table = pd.concat(parts, ignore_index=True)
    return table.sort_values("rock", kind="stable", ignore_index=True)
