"""Bodies of things, with the stripes of rulers."""

import numpy as np

from synth.arrays import Singles
from synth.light.body import Body, Paint
from synth.light.colour import LUMINANCE, tint
from synth.things.record import PlacedThing

_DARK = 0.06  # reflectance of a dark stripe over a light one's


def thing_body(thing: PlacedThing) -> Body:
    """Body of a thing in the world."""
    model = thing.model
    return Body(
        vertices_m=thing.mesh.vertices_m,
        faces=thing.mesh.faces,
        normals=thing.mesh.normals,
        albedo=float(np.array(model.rgb) @ LUMINANCE),
        model_to_world=thing.model_to_world,
        position_m=thing.position_m,
        tint=tint(model.rgb),
        paint=None if model.stripe_m is None else _stripes(model.stripe_m),
    )


def _stripes(width_m: float) -> Paint:
    """Light and dark stripes across x, averaged over the footprint.

    The mean of a square wave over a length is the difference of its integral, a triangle wave.
    """

    def paint(points_m: Singles, side_m: Singles) -> Singles:
        side = np.maximum(side_m / np.float32(width_m), np.float32(1e-3))
        middle = points_m[:, 0] / np.float32(width_m)
        dark = (_integral(middle + side / 2.0) - _integral(middle - side / 2.0)) / side
        factor = 1.0 - (1.0 - _DARK) * dark
        return np.repeat(factor.astype(np.float32)[:, None], 3, axis=1)

    return paint


def _integral(place: Singles) -> Singles:
    """Integral from 0 of a wave that is 0 and 1 in turn over lengths of 1."""
    cycles = np.floor(place / 2.0)
    return np.asarray(cycles + np.clip(place - 2.0 * cycles - 1.0, 0.0, 1.0))
