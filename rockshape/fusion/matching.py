"""Matching of rocks between views by the bodies that they would be."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import Ellipsoid
from rockshape.fusion.posed_view import PosedView, ViewRock

SWOLLEN = 1.25  # half-axes of a body over those fitted to one side of it
LEAST_SHARE = 0.3  # of the points of two rocks in each other's body, for them to be one
MAX_POINTS = 400  # of a rock


@dataclass(frozen=True)
class Sighting:
    """A rock of a view, by the numbers of both in their order."""

    view: int
    rock: int


@dataclass(frozen=True, eq=False)
class _Body:
    """A view's rock in the world: some of its points, and the body that one side tells."""

    points_m: NDArray[np.float64]
    ellipsoid: Ellipsoid

    def share(self, other: "_Body") -> float:
        """Share of the points of another that lie in this body, swollen."""
        level = np.linalg.norm(self.ellipsoid.to_sphere(other.points_m), axis=1)
        return float(np.mean(level < SWOLLEN))


def match_rocks(views: Sequence[PosedView]) -> list[list[Sighting]]:
    """Groups of sights that are one rock, at most one a view, in the order of their first.

    Two rocks are alike by the mean share of the points of each that lie in the other's body. The
    most alike are joined first, and groups are joined while they share no view; what is like
    nothing is a group by itself.
    """
    sights = [Sighting(v, r) for v, view in enumerate(views) for r in range(len(view.rocks))]
    bodies = {each: _body(views[each.view], views[each.view].rocks[each.rock]) for each in sights}
    alike = [
        (0.5 * (bodies[a].share(bodies[b]) + bodies[b].share(bodies[a])), a, b)
        for i, a in enumerate(sights)
        for b in sights[i + 1 :]
        if a.view != b.view
    ]
    group = {each: [each] for each in sights}
    for share, a, b in sorted(alike, key=lambda pair: -pair[0]):
        if share < LEAST_SHARE:
            break
        one, other = group[a], group[b]
        if one is other or {each.view for each in one} & {each.view for each in other}:
            continue
        one.extend(other)
        for each in other:
            group[each] = one
    unique = {id(each): each for each in group.values()}
    return [sorted(each, key=lambda s: (s.view, s.rock)) for each in unique.values()]


def _body(view: PosedView, rock: ViewRock) -> _Body:
    """Body of a view's rock: its ellipsoid, or the ball about its points and their feet."""
    step = max(1, len(rock.points_m) // MAX_POINTS)
    points_m = view.pose.to_world(rock.points_m[::step])
    fitted = rock.rock.ellipsoid
    if fitted is not None:
        turned = fitted.axes @ view.pose.camera_to_world.T
        centre = view.pose.to_world(fitted.centre_m)
        return _Body(points_m, Ellipsoid(centre, fitted.half_axes_m, turned))
    whole = view.pose.to_world(np.vstack([rock.points_m, rock.feet_m]))
    centre = 0.5 * (whole.min(axis=0) + whole.max(axis=0))
    radius = float(np.median(np.linalg.norm(points_m - centre, axis=1)))
    return _Body(points_m, Ellipsoid(centre, np.full(3, radius), np.eye(3)))
