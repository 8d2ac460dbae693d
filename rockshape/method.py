"""Method record: how rocks are found, fitted and measured, and the registry of methods.

Two methods come with the package: `paper`, as published by Fox et al. (2002), and `robust`. An
entry point of the group `rockshape.methods` adds a method, one of `rockshape.measures` a measure
to `robust`; `register_method` adds one to this process.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from rockshape import measures
from rockshape.ellipse.direct import Ellipse
from rockshape.ellipsoid import Ellipsoid
from rockshape.errors import unknown_name
from rockshape.measures import Measure
from rockshape.plugins.entry_points import load_records, with_entry_points
from rockshape.rock.flags import KnownOfRock, view_flags
from rockshape.rock.view import RockView
from rockshape.segmentation.finders import FINDERS
from rockshape.uncertainty import ErrorModels, read_error_models

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rockshape.ground import Ground
    from rockshape.observation import Observation, Outline
    from rockshape.segmentation.result import Segmentation

METHODS_GROUP = "rockshape.methods"
MEASURES_GROUP = "rockshape.measures"


@dataclass(frozen=True, eq=False)
class Fits:
    """Ellipse of a rock's outline and ellipsoid of its points, as the table has them."""

    ellipse: Ellipse | None
    ellipsoid: Ellipsoid | None
    outline_px: "Outline | None" = None  # that the measures see; None: the rock's edge
    half_axes_m: "NDArray[np.float64] | None" = None  # (3,), longest first; None: the ellipsoid's


@dataclass(frozen=True, eq=False)
class Method:
    """A way to find rocks, fit them and measure them."""

    name: str
    segment: "Callable[[Observation], Segmentation]"  # its own finder, which `find` overrides
    ground: "Callable[[Observation], Ground | None]"  # the ground under rocks that are given
    fits: Callable[[RockView], Fits]
    measures: tuple[Measure, ...]  # in the order of the table
    errors: Callable[[], ErrorModels] | None = None  # None: not estimated
    # what weakens a rock's values, beside what its finder tells
    flags: Callable[[RockView, KnownOfRock], tuple[str, ...]] | None = None

    @property
    def estimated(self) -> tuple[str, ...]:
        """Columns whose uncertainty is estimated, in the order of the table."""
        return () if self.errors is None else tuple(self.errors().given)

    @property
    def value_ranges(self) -> dict[str, tuple[float, float]]:
        """Ends of the values of each measure by its column."""
        return {one.column: one.value_range for one in self.measures}


def _published_ground(observation: "Observation") -> "Ground | None":
    from rockshape.segmentation.published import ground_as_published  # noqa: PLC0415 - half a second

    return ground_as_published(observation)


def _robust_ground(observation: "Observation") -> "Ground | None":
    from rockshape.segmentation.robust import ground_among_rocks  # noqa: PLC0415 - half a second

    return ground_among_rocks(observation)


def _published_fits(view: RockView) -> Fits:
    ellipsoid = None if view.ellipsoid is None else view.ellipsoid.ellipsoid
    return Fits(view.ellipse, ellipsoid, view.outline_px)


def _robust_fits(view: RockView) -> Fits:
    return Fits(
        view.form_ellipse,
        view.held_ellipsoid,
        outline_px=view.smooth_outline_px,
        half_axes_m=view.body_half_axes_m,
    )


PAPER = Method(
    name="paper",
    segment=FINDERS["published"].segment,
    ground=_published_ground,
    fits=_published_fits,
    measures=measures.PAPER,
)
ROBUST = Method(
    name="robust",
    segment=FINDERS["both"].segment,
    ground=_robust_ground,
    fits=_robust_fits,
    measures=measures.ROBUST,
    errors=read_error_models,
    flags=view_flags,
)
BUILT_IN = (PAPER.name, ROBUST.name)


def methods() -> Mapping[str, Method]:
    """Methods by name: the package's own, then those of entry points, then registered ones.

    Raises: InputError for an entry point that is no Method or no Measure, or takes another's name.
    """
    return MappingProxyType(_registry())


def find_method(method: str | Method) -> Method:
    """Method of a name; a Method is returned as it is. Raises: InputError for an unknown name."""
    if isinstance(method, Method):
        return method
    if not isinstance(method, str) or method not in methods():
        raise unknown_name("method", method, methods())
    return methods()[method]


def register_method(method: Method) -> None:
    """Add a method to this process's registry, in place of one of the same name."""
    _registry()[method.name] = method


@contextmanager
def registered(method: Method) -> Iterator[None]:
    """Registry with a method added, or put in place of one of its name, until the context ends."""
    before = dict(_registry())
    register_method(method)
    try:
        yield
    finally:
        _registry().clear()
        _registry().update(before)


def measure_of(column: str) -> Measure | None:
    """First measure of any method that fills a column; None where none does."""
    every = (one for method in methods().values() for one in method.measures)
    return next((one for one in every if one.column == column), None)


@cache
def _registry() -> dict[str, Method]:
    own = replace(ROBUST, measures=(*ROBUST.measures, *load_records(MEASURES_GROUP, Measure)))
    return with_entry_points((PAPER, own), METHODS_GROUP, Method)
