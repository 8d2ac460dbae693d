"""Skin of a ground: its reflectance at a place, and relief finer than its triangles."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from synth.arrays import Floats, Singles
from synth.noise import MipMap, fractal, slopes, stones
from synth.spec.terrain import Colour, TerrainSpec
from synth.terrain.grid import HeightGrid, Spacing
from synth.terrain.layers import FEATHER_M, Layers

_GRIT_SIDE, _GRIT_SEED = 1024, 20090103
_GRIT_LARGEST = 32  # samples between the largest stones of the grit
_GRIT_SHARES = ((4, 0.9), (8, 0.75), (16, 0.4), (32, 0.22))  # spacing, share that is there
_IN_CRACKS = 0.45  # reflectance there over the soil's
_SPECKLE = 0.16  # of the grit's brightness
_MOTTLE_M = 0.11  # size of the patches in which pebbles are alike
_PEBBLE_SPREAD = 0.35  # of the logarithm of their brightness


@dataclass(frozen=True, eq=False)
class Skin:
    """Skin of a surface: what the painter sees where triangles are too coarse."""

    paint: Callable[[Singles, Singles], Singles]
    """Linear red, green and blue (n, 3) at points (n, 3), averaged over footprints (n,)."""
    mean_rgb: Floats
    """Linear red, green and blue (3,), about their mean over the surface."""
    relief: Callable[[Singles, Singles, Singles], Singles] | None = None
    """Unit normals (n, 3) with the finer relief at points (n, 3) where the triangles' normals are
    (n, 3), averaged over footprints (n,); None: the triangles have it all."""


@dataclass(frozen=True, eq=False)
class SoilSkin:
    """Skin of soil, drifts and bedrock, with relief and grit down to a pixel."""

    covers: MipMap  # drift, bedrock and crack
    slopes: MipMap  # of the relief along x and y
    cell_m: float  # of these maps
    mesh: Spacing  # whose cells hold the relief that is longer than they are
    soil: Colour
    dust: Colour
    bedrock: Colour
    grit_m: float
    tails: HeightGrid | None = None  # thickness of the sand behind rocks

    def mean_rgb(self) -> Floats:
        """See `Skin.mean_rgb`; of the maps' covers, without tails and grit."""
        drift, bedrock, crack = self.covers.mean()
        soil, dust, rock = (np.array(one) for one in (self.soil, self.dust, self.bedrock))
        colour = soil + drift * (dust - soil)
        colour += bedrock * (rock - colour)
        return np.asarray(colour * (1.0 - (1.0 - _IN_CRACKS) * crack))

    def reflectance(self, points_m: Singles, footprint_m: Singles) -> Singles:
        """See `Skin.paint`."""
        drift, bedrock, crack = self._covers(points_m, footprint_m)
        soil, dust, rock = (_row(one) for one in (self.soil, self.dust, self.bedrock))
        colour = soil + drift[:, None] * (dust - soil)
        colour = colour + bedrock[:, None] * (rock - colour)
        colour *= (1.0 - (1.0 - _IN_CRACKS) * crack)[:, None]
        if self.grit_m > 0.0:
            tint = self._grit(points_m, footprint_m)[2]
            colour *= np.exp(np.float32(_SPECKLE) * _bare(drift, bedrock) * tint)[:, None]
        return np.asarray(colour.clip(0.01, 1.0))

    def normals(self, points_m: Singles, normals: Singles, footprint_m: Singles) -> Singles:
        """See `Skin.relief`."""
        slopes = self._finer(points_m, footprint_m)
        if self.tails is not None:
            slopes *= (1.0 - self._sanded(points_m, self.tails))[:, None]
        if self.grit_m > 0.0:
            drift, bedrock, _ = self._covers(points_m, footprint_m)
            grit = self._grit(points_m, footprint_m)[:2].T
            slopes = slopes + _bare(drift, bedrock)[:, None] * grit
        tilted = normals.copy()
        tilted[:, :2] -= slopes
        return np.asarray(tilted / np.linalg.norm(tilted, axis=1, keepdims=True))

    def _finer(self, points_m: Singles, footprint_m: Singles) -> Singles:
        """Slopes (n, 2) of the relief that footprints show and the triangles do not."""
        x, y = points_m[:, 0] / self.cell_m, points_m[:, 1] / self.cell_m
        held_m = self.mesh.at(points_m[:, 0], points_m[:, 1])
        coarse = np.asarray(np.maximum(held_m, footprint_m) / self.cell_m, dtype=np.float32)
        whole = self.slopes.at(x, y, footprint_m / self.cell_m)
        return np.asarray(whole - self.slopes.at(x, y, coarse))

    def _covers(self, points_m: Singles, footprint_m: Singles) -> Singles:
        """Shares of drift, bedrock and cracks, (3, n)."""
        x, y = points_m[:, 0] / self.cell_m, points_m[:, 1] / self.cell_m
        covers = self.covers.at(x, y, footprint_m / self.cell_m).T
        if self.tails is None:
            return covers
        sand = self._sanded(points_m, self.tails)
        drift, bedrock, crack = covers
        return np.stack([np.maximum(drift, sand), bedrock * (1.0 - sand), crack * (1.0 - sand)])

    def _sanded(self, points_m: Singles, tails: HeightGrid) -> Singles:
        """Cover by the sand behind rocks, (n,)."""
        thickness_m = tails.heights_m(points_m[:, :2].astype(np.float64))
        return np.asarray((thickness_m / FEATHER_M).clip(0.0, 1.0), dtype=np.float32)

    def _grit(self, points_m: Singles, footprint_m: Singles) -> Singles:
        """Slopes of the grit along x and y, and its tint, (3, n)."""
        scale = np.float32(_GRIT_LARGEST / self.grit_m)
        return _grit().at(points_m[:, 0] * scale, points_m[:, 1] * scale, footprint_m * scale).T


def _bare(drift: Singles, bedrock: Singles) -> Singles:
    """Share of the grit that is in sight."""
    return np.asarray((1.0 - 0.85 * drift) * (1.0 - 0.5 * bedrock))


@dataclass(frozen=True, eq=False)
class PebbleSkin:
    """Skin of pebbles: each about as bright as its neighbours."""

    pebble: Colour

    def reflectance(self, points_m: Singles, footprint_m: Singles) -> Singles:
        """See `Skin.paint`."""
        scale = np.float32(1.0 / _MOTTLE_M)
        bright = _mottle().at(points_m[:, 0] * scale, points_m[:, 1] * scale, footprint_m * scale)
        colour = _row(self.pebble) * np.exp(np.float32(_PEBBLE_SPREAD) * bright)[:, None]
        return np.asarray(colour.clip(0.01, 1.0))


def soil_skin(spec: TerrainSpec, layers: Layers, mesh: Spacing) -> SoilSkin:
    """Skin of a ground with some layers, whose triangles are spaced like `mesh`."""
    height = layers.height_m / np.float32(layers.cell_m)
    return SoilSkin(
        covers=MipMap(np.stack([layers.drift, layers.bedrock, layers.crack], axis=-1)),
        slopes=MipMap(slopes(height)),
        cell_m=layers.cell_m,
        mesh=mesh,
        soil=spec.soil,
        dust=spec.dust,
        bedrock=spec.bedrock,
        grit_m=spec.grit_m,
    )


def _row(colour: Colour) -> Singles:
    return np.array(colour, dtype=np.float32)


@cache
def _grit() -> MipMap:
    """Slopes along columns and rows, and a tint, of small stones of four sizes."""
    rng = np.random.default_rng(_GRIT_SEED)
    height = 0.6 * fractal(_GRIT_SIDE, 2.0, rng, longest_px=32.0)
    tint = 0.5 * fractal(_GRIT_SIDE, 1.5, rng, longest_px=64.0)
    for spacing, share in _GRIT_SHARES:
        top, own = stones(_GRIT_SIDE, spacing, share, rng, size=0.8)
        height, tint = np.where(top > 0.0, height + top, height), np.where(top > 0.0, own, tint)
    return MipMap(np.concatenate([slopes(height), tint[..., None]], axis=-1))


@cache
def _mottle() -> MipMap:
    """Field of unit variance that changes from sample to sample."""
    return MipMap(fractal(512, 0.6, np.random.default_rng(_GRIT_SEED + 1)))
