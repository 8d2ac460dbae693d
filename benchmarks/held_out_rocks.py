"""Rocks that intervals are held to: made ones, scans, and those of photographs."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd
import trimesh

import rockshape
from training.uncertainty.pairs import MIN_IOU, NO_RANGE, UNESTIMATED, Way
from training.uncertainty.scenes import FAMILIES
from training.uncertainty.table import PairSet, pair_table
from validation.kinds.photographs.sources.shipped import SHIPPED, Shipped
from validation.records.match import match_labels

# held out: the form was developed on apollo_sample 1, 3, 4, 7, 8 and 17
SCANS = tuple(sorted((Path(__file__).parents[1] / "examples" / "rocks").glob("*.ply")))
SCAN, PHOTOGRAPH = "scan", "photograph"
PHOTOGRAPHS = tuple(name for name, one in SHIPPED.items() if one.has_instances)
MADE, SCANNED, BY_HAND = "families left out, each in turn", "scans", "photographs"
SUBDIVISIONS = 3  # of a scan's facets, whose edges are a quarter of a radius long


def made_and_scanned(families: int, scans: int, ways: Sequence[Way], *, jobs: int) -> pd.DataFrame:
    """Pairs of scenes of each family and of scans."""
    with TemporaryDirectory() as folder:
        smoothed = [smoothed_scan(scan, Path(folder)) for scan in SCANS]
        sets = (
            PairSet(MADE, 10_000, families, FAMILIES, ways=ways),
            PairSet(SCANNED, 10_200, scans, (SCAN,), smoothed, ways=ways),
        )
        return pd.concat([pair_table(one, jobs=jobs) for one in sets], ignore_index=True)


def photograph_pairs(name: str) -> pd.DataFrame:
    """Pairs of a photograph's whole rocks: as the network draws them, and as a person does."""
    picture = Shipped(names=(name,)).picture(0, 0)
    labels = np.where(picture.truth.judged, picture.truth.labels, 0)
    by_hand = rockshape.measure(picture.image, labels=labels, method=UNESTIMATED)
    found = rockshape.measure(picture.image, find="network", method=UNESTIMATED)
    true, measured = (
        {rock.number: rock for rock in rocks if not rock.truncated} for rocks in (by_hand, found)
    )
    rows = [
        {
            "family": PHOTOGRAPH,
            "set": BY_HAND,
            "range_kind": NO_RANGE,
            **{f"value_{key}": value for key, value in measured[match.measured].values.items()},
            **{f"truth_{key}": value for key, value in true[match.truth].values.items()},
            **{
                f"seen_{key}": value
                for key, value in vars(measured[match.measured].observables).items()
            },
        }
        for match in match_labels(by_hand.labels, found.labels, min_iou=MIN_IOU)
        if match.truth in true and match.measured in measured
    ]
    return pd.DataFrame(rows)


def smoothed_scan(scan: Path, folder: Path) -> str:
    """File in a folder with the smooth surface that a scan's 500 to 1000 facets stand for.

    The facets' edges are the mesh's, not the rock's, and the finer a camera the sharper it sees
    them. Source: Loop (1987), Smooth subdivision surfaces based on triangles.
    """
    mesh = trimesh.load_mesh(scan)
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    smooth = mesh.subdivide_loop(iterations=SUBDIVISIONS)
    place = folder / scan.name
    trimesh.Trimesh(smooth.vertices, smooth.faces).export(place)
    return str(place)
