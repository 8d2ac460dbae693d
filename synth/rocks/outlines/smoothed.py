"""Roundness of rough outlines: Wadell's, of the outline smoothed at a stated scale."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from synth.arrays import Floats

SCALE = 0.07  # deviation of the smoothing over the radius of the disc of the outline's area
_POINTS = 2048  # of the smoothed outline: some twenty in the smoothing's deviation
_CHORDS = 1e-3  # more than those of some hundred dots take of a disc's radius
_NOTHING = 50.0  # e^-50 is below rounding
_DISC_POINTS = 512  # of those that bound the inscribed disc: their chords take 2e-5 of its radius


def smoothed_roundness(points_m: Floats) -> float:
    """Wadell's roundness of a polygon (n, 2), anticlockwise, at the scale `SCALE`.

    The outline, as a function of its length, is smoothed by a normal distribution of deviation
    SCALE √(A/π). Corners are the peaks of its curvature above the inscribed disc's, 1/R. Each has
    the peak's radius ρ, and counts by 1 − ρ/ρ', where ρ' <= R is the radius that must be passed on
    the way to a sharper corner: a bump that hardly stands out hardly counts, and none comes or
    goes at once. An outline without corners has the roundness 1.
    """
    from scipy.signal import find_peaks  # noqa: PLC0415 (a quarter of the time to import synth)

    curve, curvature = _smoothed(points_m)
    disc_m = inscribed_radius_m(curve[:: _POINTS // _DISC_POINTS])
    looped = np.roll(curvature, -int(np.argmin(curvature)))
    bent = np.maximum(np.append(looped, looped[0]), 1.0 / disc_m)
    peaks, found = find_peaks(bent, prominence=0.0)
    counts = found["prominences"] / bent[peaks]
    if not counts.sum():
        return 1.0
    return float(counts @ (1.0 / bent[peaks]) / (counts.sum() * disc_m))


def inscribed_radius_m(points_m: Floats) -> float:
    """Radius of the largest disc inside a closely dotted outline (n, 2).

    It touches three points and holds none: it is a Delaunay triangle's circumcircle. Its radius
    is between the outline's area over its perimeter and the radius of the disc of its area.
    """
    first, second, third = points_m[Delaunay(points_m).simplices].transpose(1, 0, 2)
    one, two = second - first, third - first
    doubled = 2.0 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    first, one, two, doubled = (part[doubled != 0.0] for part in (first, one, two, doubled))
    squares, others = (one**2).sum(axis=1), (two**2).sum(axis=1)
    across = np.column_stack(
        [
            two[:, 1] * squares - one[:, 1] * others,
            one[:, 0] * others - two[:, 0] * squares,
        ]
    )
    arms_m = across / doubled[:, None]
    radii_m = np.linalg.norm(arms_m, axis=1)
    area_m2 = _area_m2(points_m)
    perimeter_m = np.linalg.norm(np.roll(points_m, -1, axis=0) - points_m, axis=1).sum()
    possible = np.flatnonzero(
        (radii_m <= (1.0 + _CHORDS) * np.sqrt(area_m2 / np.pi)) & (radii_m >= area_m2 / perimeter_m)
    )
    inside = _inside((first + arms_m)[possible], points_m)
    return float(radii_m[possible][inside].max())


def _smoothed(points_m: Floats) -> tuple[Floats, Floats]:
    """Smoothed outline at equal steps of the outline's length, and its curvature."""
    places = points_m[:, 0] + 1j * points_m[:, 1]
    closed = np.append(places, places[0])
    lengths_m = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(closed)))])
    steps_m = np.linspace(0.0, lengths_m[-1], _POINTS, endpoint=False)
    wave_per_m = 2.0 * np.pi / lengths_m[-1] * np.fft.fftfreq(_POINTS, 1.0 / _POINTS)
    deviation_m = SCALE * np.sqrt(_area_m2(points_m) / np.pi)
    spectrum = np.fft.fft(np.interp(steps_m, lengths_m, closed))
    damping = (wave_per_m * deviation_m) ** 2 / 2.0
    spectrum *= np.where(damping < _NOTHING, np.exp(-damping), 0.0)
    curve, slope, bend = (np.fft.ifft(spectrum * (1j * wave_per_m) ** k) for k in range(3))
    curvature = (slope.conj() * bend).imag / np.abs(slope) ** 3
    return np.column_stack([curve.real, curve.imag]), np.asarray(curvature)


def _area_m2(points_m: Floats) -> float:
    after = np.roll(points_m, -1, axis=0)
    return float((points_m[:, 0] * after[:, 1] - points_m[:, 1] * after[:, 0]).sum()) / 2.0


def _inside(places_m: Floats, points_m: Floats) -> NDArray[np.bool_]:
    """Mask of places (k, 2) inside a polygon (n, 2): a ray from them crosses it oddly often."""
    start, span = points_m, np.roll(points_m, -1, axis=0) - points_m
    above = points_m[:, 1] > places_m[:, 1, None]
    crossed = above != np.roll(above, -1, axis=1)
    place, edge = np.nonzero(crossed)
    share = (places_m[place, 1] - start[edge, 1]) / span[edge, 1]
    right = start[edge, 0] + share * span[edge, 0] > places_m[place, 0]
    return np.asarray(np.bincount(place[right], minlength=len(places_m)) % 2 == 1)
