"""Key of a rock in the page: a true rock of a scene, or a thing taken for one in a view."""

from typing import NamedTuple

import pandas as pd


class RockKey(NamedTuple):
    """A true rock, or a thing that a method took for one in one view."""

    experiment: str
    series: str
    scene: int
    instance: int | None
    view: int = 0  # of a thing that is no true rock
    method: str = ""
    rock: int = 0

    @property
    def id(self) -> str:
        """The name of the rock's place in the page."""
        parts = [self.experiment, self.series, str(self.scene)]
        if self.instance is None:
            parts += [f"x{self.view}", self.method, str(self.rock)]
        else:
            parts.append(str(self.instance))
        return "rock-" + "-".join(part for part in parts if part)


def keys_of(records: pd.DataFrame) -> list[RockKey]:
    """Key of each record."""
    names = ("experiment", "series", "scene", "view", "method", "instance", "rock")
    columns = (records[name].astype(object).tolist() for name in names)
    return [
        RockKey(experiment, series, int(scene), None, int(view), method, int(rock))
        if pd.isna(instance)
        else RockKey(experiment, series, int(scene), int(instance))
        for experiment, series, scene, view, method, instance, rock in zip(*columns, strict=True)
    ]
