"""Statistics of the form of rocks, and of the silhouettes that they show.

    python benchmarks/rock_statistics.py FOLDER MASK… > benchmarks/rock_statistics.json

writes those of the scanned rocks of a folder and of the grains of instance masks, with which the
case `rock_forms` compares made ones.
"""

import argparse
import json
from pathlib import Path

import cv2
import numpy as np
from scipy.spatial import ConvexHull

from synth.geometry.mesh import Mesh, volume_m3
from synth.geometry.min_volume_box import smallest_box, spread_directions
from synth.rocks.outlines import mesh_form, plane_across
from synth.rocks.scan import scan

VIEWS, BEARINGS = 8, 1024
SCALE = 0.07  # deviation of the smoothing of outlines, over √(A/π)
SMALLEST_PX = 40  # width of grains whose outlines are looked at


def solid_statistics(mesh: Mesh) -> dict[str, float]:
    """Axis ratios of the smallest box, volume over the hull's, and the silhouettes' statistics."""
    a, b, c = smallest_box(mesh.vertices_m).half_sides_m
    form = mesh_form(mesh)
    views = [
        outline_statistics(form.silhouette_points_m(plane_across(ray), bearings=BEARINGS))
        for ray in spread_directions(VIEWS)
    ]
    return {
        "b_over_a": float(b / a),
        "c_over_b": float(c / b),
        "solidity": volume_m3(mesh) / float(ConvexHull(mesh.vertices_m).volume),
        **{name: float(np.mean([view[name] for view in views])) for name in views[0]},
    }


def outline_statistics(points: np.ndarray) -> dict[str, float]:
    """Convexity, and of the smoothed outline the RMS curvature and the share that is concave.

    Convexity is area over the hull's area. The outline (n, 2) is smoothed by a normal
    distribution of the deviation `SCALE`; its curvature is taken times √(A/π), 1 all round a disc.
    """
    place = points[:, 0] + 1j * points[:, 1]
    area = abs(float((place.conj() * np.roll(place, -1)).imag.sum())) / 2.0
    closed = np.append(place, place[0])
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(closed)))])
    even = np.interp(np.linspace(0.0, along[-1], BEARINGS, endpoint=False), along, closed)
    wave = 2.0 * np.pi / along[-1] * np.fft.fftfreq(BEARINGS, 1.0 / BEARINGS)
    radius = np.sqrt(area / np.pi)
    damped = np.fft.fft(even) * np.exp(-0.5 * (wave * SCALE * radius) ** 2)
    slope, bend = np.fft.ifft(1j * wave * damped), np.fft.ifft(-(wave**2) * damped)
    curvature = radius * (slope.conj() * bend).imag / np.abs(slope) ** 3
    weights = np.abs(slope) / np.abs(slope).sum()
    curvature *= np.sign(weights @ curvature)
    return {
        "convexity": area / float(ConvexHull(points).volume),
        "curvature_rms": float(np.sqrt(weights @ curvature**2)),
        "concave_share": float(weights[curvature < 0.0].sum()),
    }


def grains(path: Path) -> list[dict[str, float]]:
    """Outline statistics of the larger grains of an instance mask that its frame does not cut."""
    mask = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    found = []
    for label in np.unique(mask[mask > 0]):
        own = np.pad(mask == label, 1).astype(np.uint8)
        left, top, width, height = cv2.boundingRect(own)
        cut = left <= 1 or top <= 1
        cut = cut or left + width > mask.shape[1] or top + height > mask.shape[0]
        if cut or min(width, height) < SMALLEST_PX:
            continue
        lines, _ = cv2.findContours(own, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        line = max(lines, key=cv2.contourArea)
        found.append(outline_statistics(line[:, 0].astype(float)))
    return found


def main() -> None:
    """Print the statistics of scans and grains."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="scanned rocks, PLY")
    parser.add_argument("masks", type=Path, nargs="*", metavar="MASK", help="instance masks")
    args = parser.parse_args()
    scans = {
        path.stem: solid_statistics(scan(str(path), diameter_m=1.0).mesh)
        for path in sorted(args.folder.glob("*.ply"))
    }
    outlines = [one for path in args.masks for one in grains(path)]
    print(json.dumps({"scans": scans, "grains": outlines}, indent=1))


if __name__ == "__main__":
    main()
