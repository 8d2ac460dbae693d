"""Outlines with points evenly along their length, and smoothed along it."""

import numpy as np
from numpy.typing import NDArray

from rockshape.outline.trace import signed_area

PIXEL_SIGMA = 1.0  # px: takes the staircase, leaves the corners
LENGTH_SIGMA = 0.4  # sqrt(px), of the square root of the radius: takes what lengthens it too
MIN_POINTS = 100


def outline_length(outline: NDArray[np.float64]) -> float:
    """Length of a closed polygon (n, 2), in its unit; 0 for fewer than two points."""
    if len(outline) < 2:
        return 0.0
    x, y = outline.T.copy()
    return float(np.hypot(np.diff(x), np.diff(y)).sum() + np.hypot(x[0] - x[-1], y[0] - y[-1]))


def even_outline(outline: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Points (count, 2) at equal steps along a closed polygon (n, 2), the first its own first.

    (0, 2) for an outline of no length.
    """
    length = outline_length(outline)
    if length == 0:
        return np.empty((0, 2))
    x, y = np.concatenate([outline, outline[:1]]).T.copy()
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    places = length / count * np.arange(count)
    return np.column_stack([np.interp(places, along, x), np.interp(places, along, y)])


def smooth_evenly(outline: NDArray[np.float64], *, sigma: float, count: int) -> NDArray[np.float64]:
    """A closed outline (n, 2) freed of detail shorter than sigma along it, at (count, 2) points.

    With g = exp(-(2 pi k sigma / L)² / 2), the Gaussian's transfer at the k-th harmonic of an
    outline of length L, the transfer is g (2 - g): what the Gaussian takes is smoothed once more
    and given back. A Gaussian alone would shrink a circle of radius R by sigma²/(2R), this by
    sigma⁴/(4R³). sigma in the outline's unit. (0, 2) for an outline of no length.
    """
    even = even_outline(outline, max(len(outline), count))
    if len(even) == 0:
        return even
    # fftfreq in whole waves round the outline
    wave = np.fft.fftfreq(len(even), 1 / len(even)) * (2 * np.pi * sigma / outline_length(even))
    smooth = np.fft.ifft(np.fft.fft(even[:, 0] + 1j * even[:, 1]) * fine_attenuation(wave))
    return even_outline(np.column_stack([smooth.real, smooth.imag]), count)


def fine_attenuation(wave: NDArray[np.floating]) -> NDArray[np.float64]:
    """Share of a harmonic that is left, g (2 - g), g = exp(-wave² / 2), wave 2 pi k sigma / L."""
    gauss = np.exp(-(wave**2) / 2)
    return np.asarray(gauss * (2 - gauss))


def canonical(outline: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same closed outline (n, 2), clockwise, from its point farthest from the points' mean.

    So that what depends on where samples fall does not depend on how the outline was given.
    """
    if len(outline) == 0:
        return outline
    ring = outline if signed_area(outline) >= 0 else outline[::-1]
    # rounded, since the mean of the points in another order differs in its last digits
    distance = np.round(((ring - ring.mean(axis=0)) ** 2).sum(axis=1), 6)
    return np.asarray(np.roll(ring, -int(distance.argmax()), axis=0))


def pixel_smooth(edge_px: NDArray[np.float64]) -> NDArray[np.float64]:
    """A pixel edge (n, 2) without its staircase, at (m, 2) points about a pixel apart.

    Smoothed by 1 px. What is left of the staircase makes it 0.7 % longer than the line it stands
    for, at any size.
    """
    ring = canonical(edge_px)
    # round a pixel edge one passes up to sqrt(2) sides' middles a pixel of length
    count = max(MIN_POINTS, round(outline_length(ring)))
    return smooth_evenly(ring, sigma=PIXEL_SIGMA, count=count)


def length_outline(edge_px: NDArray[np.float64]) -> NDArray[np.float64]:
    """A pixel edge (n, 2) without the ripple that lengthens it, at (m, 2) points a pixel apart.

    Smoothed by 0.4 sqrt(R px), R the radius of the disc of equal area, and at least by 1 px. Steps
    of a staircase are up to about sqrt(R) long where the edge of a disc runs along the pixels, so
    that the excess length vanishes as R grows, while corners are cut by a falling share of R.
    """
    ring = canonical(edge_px)
    radius = np.sqrt(abs(signed_area(ring)) / np.pi)
    sigma = max(PIXEL_SIGMA, LENGTH_SIGMA * float(np.sqrt(radius)))
    return smooth_evenly(ring, sigma=sigma, count=max(MIN_POINTS, round(outline_length(ring))))


def pixel_steps(outline_px: NDArray[np.float64]) -> NDArray[np.float64]:
    """A closed outline (n, 2) at (m, 2) points evenly about a pixel apart, without smoothing."""
    ring = canonical(outline_px)
    return even_outline(ring, max(MIN_POINTS, round(outline_length(ring))))
