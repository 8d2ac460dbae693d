"""Reflectance of surfaces, with texture and dust."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.light.body import Body
from synth.light.colour import LUMINANCE, Appearance
from synth.light.samples import Indices, Samples
from synth.light.texture import pattern, wrapped
from synth.light.wetness import wetted
from synth.spec.surface import SurfaceSpec

_MAX_PARTS = 4  # of a slanted footprint


class Reflectance:
    """Linear reflectance of a scene's bodies; it moves and turns with the rocks."""

    def __init__(
        self,
        rocks: Sequence[Body],
        ground: Sequence[Body],
        surface: SurfaceSpec,
        *,
        things: Sequence[Body] = (),
        appearance: Appearance | None = None,
    ) -> None:
        bodies = [*rocks, *ground, *things]
        self._textured = len(rocks) + len(ground)
        self._rocks, self._surface = len(rocks), surface
        self._painted = [number for number, body in enumerate(bodies) if body.paint is not None]
        self._bodies = bodies
        self._means = _channels(bodies, appearance)
        self._wetness = 0.0 if appearance is None else appearance.wetness
        dust = np.ones(1) if appearance is None else appearance.dust
        self._dust = (surface.ground_albedo * dust).astype(np.float32)
        self._turns = np.stack([body.model_to_world for body in bodies]).astype(np.float32)
        self._origins_m = np.stack([body.position_m for body in bodies]).astype(np.float32)

    def at(self, samples: Samples, normals: Singles) -> Singles:
        """Reflectance at samples, (n, k): k = 3 for R, G, B, or 1, their luminance.

        ρ = ρ_body (1 + contrast × texture); dust of the ground's albedo covers the share
        dust × (n_z − 0.4)/0.6 of a rock, between 0 and 1, with n_z of `normals` (n, 3), which have
        the fine relief.
        """
        surface = self._surface
        found = self._means[samples.body]
        for number in self._painted:
            here = np.flatnonzero(samples.body == number)
            found[here] *= self._paint(number, samples, here)
        rocky = np.flatnonzero(samples.body < self._rocks)
        if surface.dust > 0.0:
            cover = surface.dust * np.clip((normals[rocky, 2] - 0.4) / 0.6, 0.0, 1.0)
            found[rocky] += cover[:, None] * (self._dust - found[rocky])
        if surface.contrast > 0.0:
            texture = self._texture(samples)[:, None]
            texture[samples.body >= self._textured] = 0.0
            found = found * np.maximum(1.0 + np.float32(surface.contrast) * texture, 0.1)
        return found if self._wetness == 0.0 else wetted(np.minimum(found, 1.0), self._wetness)

    def _paint(self, number: int, samples: Samples, here: Indices) -> Singles:
        """Factor of a body's own paint at some of the samples, (m, k)."""
        body = self._bodies[number]
        if body.paint is None or not len(here):
            return np.ones((len(here), 1), dtype=np.float32)
        own_m = (samples.points_m[here] - self._origins_m[number]) @ self._turns[number]
        side_m = samples.width_m[here] * np.sqrt(samples.stretch[here])
        factor = body.paint(own_m, side_m)
        if self._means.shape[1] == 1:
            weights = (LUMINANCE * body.tint).astype(np.float32)
            return np.asarray((factor @ weights)[:, None])
        return factor

    def _texture(self, samples: Samples) -> Singles:
        """Texture at samples, (n,), averaged over their footprints.

        A slanted surface is longer under a pixel than it is broad. Its length is cut into up to
        four parts, each the size of its geometric mean side: one part alone would lack what is
        broad and keep what is too fine in length, which two eyes see in one row alike and in
        bent rows never.
        """
        parts = np.clip(np.rint(samples.stretch), 1, _MAX_PARTS).astype(np.int8)
        side_m = samples.width_m * np.sqrt(samples.stretch / parts)
        lengths_m = samples.lengths_m()
        texture = np.empty(len(parts), dtype=np.float32)
        earthy, rocky = (
            np.flatnonzero(one) for one in (samples.body >= self._rocks, samples.body < self._rocks)
        )
        texture[earthy] = _mean_along(
            lambda places_m, here: pattern(places_m[:, 0], places_m[:, 1], side_m[earthy[here]]),
            samples.points_m[earthy, :2],
            lengths_m[earthy, :2],
            parts[earthy],
        )
        body = samples.body[rocky]
        turns = self._turns[body]
        # Rocks of one shape are painted with different parts of the tile.
        apart_m = np.float32(0.37) * body[:, None].astype(np.float32)
        arms_m, across_m, normals = (
            np.einsum("nij,ni->nj", turns, one)
            for one in (
                samples.points_m[rocky] - self._origins_m[body],
                lengths_m[rocky],
                samples.normals[rocky],
            )
        )
        texture[rocky] = _mean_along(
            lambda places_m, here: wrapped(places_m, normals[here], side_m[rocky[here]]),
            arms_m + apart_m,
            across_m,
            parts[rocky],
        )
        return texture


def _channels(bodies: Sequence[Body], appearance: Appearance | None) -> Singles:
    """Bodies' mean reflectance, (bodies, 1) grey or (bodies, 3) in colour."""
    albedo = np.array([body.albedo for body in bodies], dtype=np.float32)[:, None]
    if appearance is None:
        return albedo
    return albedo * np.stack([body.tint for body in bodies]).astype(np.float32)


def _mean_along(
    look: Callable[[Singles, Indices], Singles],
    points_m: Singles,
    lengths_m: Singles,
    parts: NDArray[np.int8],
) -> Singles:
    """Mean of what `look` sees in the middles of the parts of lengths, (n,).

    points_m (n, k) are the lengths' middles, lengths_m (n, k) their vectors; `look` takes places
    and the numbers of the samples they belong to.
    """
    mean = np.empty(len(parts), dtype=np.float32)
    for count in np.unique(parts):
        here = np.flatnonzero(parts == count)
        middles_m, whole_m = points_m[here], lengths_m[here]
        shares = (np.arange(count, dtype=np.float32) + 0.5) / np.float32(count) - 0.5
        seen = [look(middles_m + share * whole_m, here) for share in shares]
        mean[here] = sum(seen[1:], start=seen[0]) / np.float32(count)
    return mean
