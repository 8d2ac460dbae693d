"""Outlines moved to the image's edge: range finds a rock, the image tells where it ends.

Stereo matching fattens or eats rocks by pixels. Along each outline the image is unrolled into a
band, and the path through the band that follows the strongest edge without bending much is the
outline. How far range's outlines lie from the image's edges is measured in the frame itself, and
holds the path where the image has no edge.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Singles
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.outline.polygon_fill import inside_of
from rockshape.outline.resample import outline_length, smooth_evenly
from rockshape.outline.trace import signed_area
from rockshape.segmentation.brightness import blurred_light
from rockshape.segmentation.edges.shortest_path import closed_paths
from rockshape.segmentation.relabel import relabelled

REACH_PX = 6.0  # how far an edge may lie from the outline
LANE_PX = 0.5
BLUR_PX = 0.8  # of the image, before its edges are taken
ROUND_PX = 4.5  # least smoothing of the outline along itself; does not shrink it
STRONGEST = 12.0  # edges above this many of the texture's standard deviations are all alike
BEND = 0.35  # cost of moving by a lane from one pixel of the outline to the next
CLEAR = 2.5  # edges of this strength tell how far range is off
SHARPEST_PX = 0.4  # range's outlines are never taken to be surer than this
OVERLAP = 40


@dataclass(frozen=True, eq=False)
class SnappedOutline:
    """A closed outline at sub-pixel places, and how sure it is."""

    points_px: Floats  # (n, 2) as (x, y), a pixel apart, clockwise as seen
    sd_px: float  # standard deviation of its points across the outline


@dataclass(frozen=True, eq=False)
class _Ring:
    """An outline with its normals and the image's edges across it."""

    number: int
    points: Floats  # (n, 2)
    normals: Floats  # (n, 2), outwards
    edge: Singles  # (n, lanes), strength in the texture's standard deviations
    held: NDArray[np.bool_]  # (n,), on the frame's border, where nothing can be moved


def snap(
    image: Singles, labels: NDArray[np.int32], *, texture: float, window_px: int = 1
) -> dict[int, SnappedOutline]:
    """Outlines of the labels (rows, cols), moved to the image's edges, by number.

    image is (rows, cols) from 0 to 1, texture the standard deviation of its logarithm on bare
    ground. window_px is the side of the window over which errors of range correlate: what is
    shorter along an outline is the matcher's and is smoothed away first.

    The cost of a path is, at each pixel of it, its distance from range's outline over the spread of
    those distances, squared and halved, less the edge's strength in texture's standard deviations,
    up to 12; a first run without the distances gives their middle and spread. Empty where these
    show that the outlines are on the image's edges already.
    """
    light = blurred_light(image, BLUR_PX)
    smooth_px = max(ROUND_PX, float(window_px))
    tried = [
        _ring(light, mask, number, texture=texture, smooth_px=smooth_px)
        for number, mask in _masks(labels)
    ]
    rings = [ring for ring in tried if ring is not None]
    if not rings:
        return {}
    lanes = _lanes()
    bend = np.full(len(rings), BEND, dtype=np.float32)
    flat = (lanes / REACH_PX) ** 2
    free = closed_paths([flat - ring.edge for ring in rings], bend=bend, overlap=OVERLAP)
    middle, spread = _bleeding(rings, free, lanes)
    if abs(middle) < SHARPEST_PX and spread < 2 * SHARPEST_PX:
        return {}
    held = 0.5 * ((lanes - middle) / max(spread, SHARPEST_PX)) ** 2
    costs = [
        np.where(ring.held[:, None], 1e3 * np.abs(lanes), held - ring.edge).astype(np.float32)
        for ring in rings
    ]
    paths = closed_paths(costs, bend=bend, overlap=OVERLAP)
    return {
        ring.number: _outline(ring, cost, path, lanes)
        for ring, cost, path in zip(rings, costs, paths, strict=True)
    }


def _lanes() -> Singles:
    half = round(REACH_PX / LANE_PX)
    return (LANE_PX * np.arange(-half, half + 1)).astype(np.float32)


def _masks(labels: NDArray[np.int32]) -> list[tuple[int, tuple[NDArray[np.bool_], int, int]]]:
    """Each number with its mask in a window, and the window's first row and column."""
    windows = ndi.find_objects(labels)
    return [
        (number, (labels[window] == number, window[0].start, window[1].start))
        for number, window in enumerate(windows, start=1)
        if window is not None
    ]


def _ring(
    light: Singles,
    mask: tuple[NDArray[np.bool_], int, int],
    number: int,
    *,
    texture: float,
    smooth_px: float,
) -> _Ring | None:
    part, top, left = mask
    padded = cv2.copyMakeBorder(part.astype(np.uint8), 1, 1, 1, 1, cv2.BORDER_CONSTANT)
    contours, _ = cv2.findContours(padded, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    contour = max(contours, key=len)[:, 0].astype(np.float64) - 1 + (left, top)
    if len(contour) < 12:
        return None
    if signed_area(contour) < 0:
        contour = contour[::-1]
    steps = max(8, round(outline_length(contour)))
    smooth = smooth_evenly(contour, sigma=smooth_px, count=steps)
    ahead = np.roll(smooth, -1, axis=0) - np.roll(smooth, 1, axis=0)
    length = np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    normals = np.column_stack([ahead[:, 1], -ahead[:, 0]]) / length
    # boundary pixels' centres lie half a pixel inside the mask's edge
    points = smooth + 0.5 * normals
    rows, cols = light.shape
    held = ((points < 1) | (points > np.array([cols - 2, rows - 2]))).any(axis=1)
    lanes = _lanes()
    wide = np.concatenate([[lanes[0] - LANE_PX], lanes, [lanes[-1] + LANE_PX]])
    places = points[:, None] + wide[:, None] * normals[:, None]
    # cv2.remap rounds places to 1/32 px before OpenCV 5
    profile = ndi.map_coordinates(
        light, (places[..., 1], places[..., 0]), order=1, mode="nearest", output=np.float32
    )
    step = np.abs(profile[:, 2:] - profile[:, :-2]) / (2 * LANE_PX)
    edge = np.minimum(step / np.float32(texture), np.float32(STRONGEST))
    return _Ring(number, points, normals, edge.astype(np.float32), held)


def _round(points: Floats, sigma: float) -> Floats:
    """A closed outline smoothed along itself by a normal curve."""
    frequency = np.fft.fftfreq(len(points))
    passed = np.exp(-2 * (np.pi * sigma * frequency) ** 2)[:, None]
    return np.asarray(np.fft.ifft(np.fft.fft(points, axis=0) * passed, axis=0).real)


def _bleeding(
    rings: list[_Ring], paths: list[NDArray[np.intp]], lanes: Singles
) -> tuple[float, float]:
    """Median of the offsets of clear edges from range's outlines, outwards, and their spread."""
    offsets = [
        lanes[path[ring.edge[np.arange(len(path)), path] > CLEAR]]
        for ring, path in zip(rings, paths, strict=True)
    ]
    every = np.concatenate(offsets)
    if len(every) == 0:
        return 0.0, SHARPEST_PX
    middle = float(np.median(every))
    return middle, MEDIAN_TO_SIGMA * float(np.median(np.abs(every - middle)))


def _outline(ring: _Ring, cost: Singles, path: NDArray[np.intp], lanes: Singles) -> SnappedOutline:
    """The path's place between lanes, by a parabola through the cost, and its uncertainty."""
    steps = np.arange(len(path))
    middle = np.clip(path, 1, len(lanes) - 2)
    before, here, after = (cost[steps, middle + side] for side in (-1, 0, 1))
    curve = before - 2 * here + after
    shift = np.where(curve > 1e-6, 0.5 * (before - after) / np.maximum(curve, 1e-6), 0)
    offset = lanes[path] + LANE_PX * np.clip(np.where(middle == path, shift, 0), -0.5, 0.5)
    near = np.exp(-(cost - cost.min(axis=1, keepdims=True)))
    near /= near.sum(axis=1, keepdims=True)
    mean = near @ lanes
    variance = near @ lanes**2 - mean**2
    offset = _round(offset[:, None].astype(np.float64), 1.0)
    return SnappedOutline(ring.points + offset * ring.normals, float(np.sqrt(variance.mean())))


def paint(
    outlines: dict[int, SnappedOutline], labels: NDArray[np.int32], *, order: list[int]
) -> NDArray[np.int32]:
    """Labels with the pixels whose centres lie within the outlines; later in order covers earlier.

    Numbers without an outline keep their pixels.
    """
    kept = np.arange(int(labels.max(initial=0)) + 1, dtype=labels.dtype)
    kept[list(outlines)] = 0
    painted = relabelled(labels, kept)
    for number in order:
        if number in outlines:
            x, y = outlines[number].points_px.T
            window, mask = inside_of(x, y, labels.shape)
            painted[window][mask] = number
    return painted
