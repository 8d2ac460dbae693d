"""Page of a kind: its section, and which of its rocks are shown one by one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Protocol, TypeVar, cast

from markupsafe import Markup

from validation.execution.run import Run
from validation.records.pictures import Portrait
from validation.report.rock_key import RockKey
from validation.suite.experiment import Experiment
from validation.suite.registry import kind_of

E_contra = TypeVar("E_contra", bound=Experiment, contravariant=True)


@dataclass(frozen=True)
class Room:
    """Room that the page has, and the rocks that were chosen for it."""

    chosen: Mapping[RockKey, Sequence[Portrait]]
    most_points: int  # of a chart
    share: float  # of the bytes for pictures of whole views


class Page(Protocol[E_contra]):
    """Module of a kind that shows its experiments."""

    def scenes_shown(self, experiment: E_contra, /) -> int | None:
        """How many first scenes have their rocks shown one by one before all others.

        None where no rock of such an experiment is shown by itself.
        """

    def section(self, run: Run, experiment: E_contra, room: Room, /) -> Markup:
        """Section with the id `at-` and the experiment's name; empty for none."""


def page_of(experiment: Experiment) -> Page[Experiment]:
    """Import the page of an experiment's kind."""
    return cast(Page[Experiment], import_module(kind_of(experiment).page))
