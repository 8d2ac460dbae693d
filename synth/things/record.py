"""Thing record: a body that is no rock, in its own frame and placed."""

from dataclasses import dataclass

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.spec.things import ThingName


@dataclass(frozen=True, eq=False)
class ThingModel:
    """Thing in its own frame: it stands on z = 0 round the origin."""

    kind: ThingName
    mesh: Mesh
    rgb: tuple[float, float, float]  # linear reflectance
    stripe_m: float | None = None  # light and dark stripes across x, each this wide


@dataclass(frozen=True, eq=False)
class PlacedThing:
    """Thing in the world."""

    model: ThingModel
    mesh: Mesh  # in the world
    model_to_world: Floats  # (3, 3) rotation
    position_m: Floats  # (3,)


# Values in `not_rock` images; 0 is ground, sky or rock.
CLASSES: dict[ThingName, int] = {
    "ruler": 1,
    "cable": 2,
    "wheel": 3,
    "deck": 4,
    "coin": 5,
    "ball": 6,
}
