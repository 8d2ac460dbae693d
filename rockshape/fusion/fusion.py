"""Fusion of several views of the same rocks into one row a rock."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.api import measure
from rockshape.errors import InputError
from rockshape.fusion.alignment import Alignment, align
from rockshape.fusion.fused_rock import FusedRock, fused_rock
from rockshape.fusion.matching import match_rocks
from rockshape.fusion.pose import CameraPose, PoseLike, pose_argument
from rockshape.fusion.posed_view import PosedView, posed_view
from rockshape.method import Method
from rockshape.observation import Observation
from rockshape.rock.instances import Instances

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False, repr=False)
class Fusion:
    """Rocks of several views."""

    rocks: tuple[FusedRock, ...]
    views: tuple[PosedView, ...]  # as measured, with the poses that were used
    alignment: Alignment | None  # how far the poses moved; None where they were kept

    @cached_property
    def poses(self) -> tuple[CameraPose, ...]:
        """Poses that were used."""
        return tuple(view.pose for view in self.views)

    def to_frame(self) -> "pd.DataFrame":
        """Table of one row a rock."""
        from rockshape.fusion.tables import rock_table  # noqa: PLC0415 - brings pandas

        return rock_table(self.rocks, self.views)

    def views_to_frame(self) -> "pd.DataFrame":
        """Table of one row a rock and view: the columns of `rockshape measure` behind both."""
        from rockshape.fusion.tables import view_table  # noqa: PLC0415 - brings pandas

        return view_table(self.rocks, self.views)

    def __repr__(self) -> str:
        several = sum(len(rock.sights) > 1 for rock in self.rocks)
        return f"Fusion({len(self.rocks)} rocks, {several} in several of {len(self.views)} views)"


def fuse(
    observations: Sequence[Observation],
    poses: Sequence[PoseLike],
    *,
    labels: Sequence[ArrayLike | Instances | None] | None = None,
    names: Sequence[str] | None = None,
    method: str | Method = "robust",
    refine: bool = True,
) -> Fusion:
    """Measure every view, match their rocks and fuse what the views tell of each.

    - observations: as `rockshape.read` returns them, each with range; rocks that one has outlined
      already are measured, in others they are found.
    - poses: of each, a `CameraPose` or its matrix (4, 4) from the camera's frame to the world, m.
    - labels: rocks outlined already, an array or Instances for each view, or None where they are to
      be found.
    - names: of the views, for tables and messages; `view 0` and so on.
    - method: what is measured, as `rockshape.measure` has it.
    - refine: whether the poses are refined by the range before rocks are matched.

    Raises: InputError for unequal numbers of views, poses and labels, poses that are none, a view
        without range or ground, and range that does not fit the other views' within 3° and 10 cm.
    """
    count = len(observations)
    told = [f"view {number}" for number in range(count)] if names is None else list(names)
    given = [None] * count if labels is None else list(labels)
    for name, found in (("poses", len(poses)), ("labels", len(given)), ("names", len(told))):
        if found != count:
            raise InputError(f"{name}: expected {count}, one a view, found {found}")
    if not count:
        raise InputError("observations: expected at least one view, found none")
    placed = [pose_argument(f"{name}: pose", pose) for name, pose in zip(told, poses, strict=True)]
    views = [
        posed_view(name, pose, measure(observation, labels=own, method=method))
        for name, pose, observation, own in zip(told, placed, observations, given, strict=True)
    ]
    return fuse_views(views, refine=refine)


def fuse_views(views: Sequence[PosedView], *, refine: bool = True) -> Fusion:
    """Fusion of views that are measured.

    Raises: InputError for range that does not fit the other views' within 3° and 10 cm.
    """
    alignment = align(views) if refine else None
    if alignment is not None:
        views = [view.posed(pose) for view, pose in zip(views, alignment.poses, strict=True)]
    up = _up(views)
    rocks = [
        fused_rock(number, sights, views, up=up)
        for number, sights in enumerate(match_rocks(views), start=1)
    ]
    return Fusion(tuple(rocks), tuple(views), alignment)


def _up(views: Sequence[PosedView]) -> NDArray[np.float64]:
    """Mean normal (3,) of the views' grounds, in the world."""
    total = sum((view.pose.camera_to_world @ view.up for view in views), np.zeros(3))
    return np.asarray(total / np.linalg.norm(total))
