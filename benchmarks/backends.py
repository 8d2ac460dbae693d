"""Do the backends agree? Ten scenes, each seen by every backend in a process of its own.

    python benchmarks/backends.py [--scenes 10] [--pictures FOLDER]

Depth is compared where both depth images store it: ground beyond their 65,535 steps, up to the
horizon, is no part of a dataset. Ground so far away that a depth buffer of 24 bits cannot tell
millimetres is thereby left out.
"""

import argparse
import subprocess
import sys
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np

from synth.dataset.depth import depth_scale_mm, encode_depth
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.render.backends import BACKENDS, has_backend
from synth.scene.scene import build_scene
from synth.spec import SceneSpec, convert_spec

SCENES = [
    {},
    {"rocks": {"family": "mixed", "series": "random", "count": 9}},
    {"camera": {"preset": "imp"}},
    {"camera": {"preset": "mer-hazcam"}, "sun": {"elevation_deg": 20}},
    {"camera": {"elevation_deg": 12}, "sun": {"elevation_deg": 15, "azimuth_deg": 300}},
    {"ground": {"slope_deg": 8, "burial": [0.1, 0.4], "resting": "stable"}},
    {"ground": {"ripple_height_m": 0.02, "ripple_length_m": 0.4}},
    {"ground": {"pebbles_per_m2": 60}, "surface": {"dust": 0.6}},
    {"population": {"kind": "golombek-rapp", "k": 0.06, "d_min_m": 0.12}},
    {"surface": {"law": "lunar-lambert"}, "camera": {"roll_deg": 10}},
]


def render(number: int, backend: str, out: Path) -> None:
    """Write one scene's first view by one backend, depth as a dataset stores it."""
    spec = _spec(number)
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer(backend, stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
    scale_mm = depth_scale_mm(spec)
    depth_m = np.where(encode_depth(view.depth_m, scale_mm) > 0, view.depth_m, np.nan)
    np.savez(out, depth_m=depth_m, labels=view.labels, image=view.image)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=len(SCENES))
    parser.add_argument("--pictures", type=Path, help="folder for the images side by side")
    parser.add_argument("--one", nargs=3, metavar=("SCENE", "BACKEND", "OUT"), help="internal")
    args = parser.parse_args()
    if args.one:
        render(int(args.one[0]), args.one[1], Path(args.one[2]))
        return
    present = [backend for backend in BACKENDS if has_backend(backend)]
    print("scene  pair             labels differ   depth > 1 mm apart   median depth   grey > 4")
    for number in range(min(args.scenes, len(SCENES))):
        views = {backend: _rendered(number, backend) for backend in present}
        for pair in combinations(present, 2):
            _compare(number, pair, [views[backend] for backend in pair])
        if args.pictures:
            args.pictures.mkdir(parents=True, exist_ok=True)
            row = np.hstack([views[backend]["image"] for backend in present])
            cv2.imwrite(str(args.pictures / f"scene_{number}.png"), row)


def _spec(number: int) -> SceneSpec:
    return convert_spec({"seed": 100 + number, **SCENES[number]}, where=f"scene {number}")


def _rendered(number: int, backend: str) -> dict[str, np.ndarray]:
    with TemporaryDirectory() as folder:
        out = Path(folder) / "view.npz"
        command = [sys.executable, __file__, "--one", str(number), backend, str(out)]
        subprocess.run(command, check=True)
        with np.load(out) as arrays:
            return dict(arrays)


def _compare(number: int, pair: tuple[str, str], views: list[dict[str, np.ndarray]]) -> None:
    one, two = views
    both = ~np.isnan(one["depth_m"]) & ~np.isnan(two["depth_m"])
    apart_m = np.abs(one["depth_m"] - two["depth_m"])[both]
    labels = int((one["labels"] != two["labels"]).sum())
    grey = np.abs(one["image"].astype(int) - two["image"])
    print(
        f"{number:5d}  {'-'.join(pair):15s}  {labels:5d} of {one['labels'].size}  "
        f"{int((apart_m > 1e-3).sum()):6d} of {int(both.sum())}   "
        f"{1e6 * np.median(apart_m):8.2f} µm   {int((grey > 4).sum()):6d}",
        flush=True,
    )


if __name__ == "__main__":
    main()
