"""What finding the rocks of a frame costs, beside one labelling of connected regions.

Each is the median processor time of five, on one thread, of a frame of 1024 x 1024 pixels with
stereo noise, sparse, crowded and on ripples; the floor is cv2.connectedComponentsWithStats on the
mask of what stands there, in the same run. `--steps PICTURE` draws the steps of the robust way,
`--ways PICTURE` the published and the robust way side by side, `--mars PICTURE` the example from
Mars.
"""

import argparse
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt

from rockshape.ground import Ground
from rockshape.io import read_camera, read_image, read_range
from rockshape.observation import Observation
from rockshape.outline.trace import trace_outline
from rockshape.segmentation import FINDERS, Segmentation
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_range.height_signal import HeightSignal, standing
from rockshape.segmentation.robust import find_by_range, ground_among_rocks, heights_over
from synth.dataset.write import write_common, write_scene
from synth.render import choose_backend
from synth.spec import convert_spec

MARS = Path(__file__).parent.parent / "examples" / "mars"
SEED = 10_050
REPEATS = 5
ROCKS = {"family": "mixed", "series": "random", "b_over_a": [0.6, 0.95], "c_over_b": [0.5, 0.9]}
CAMERA = {"preset": "msl-navcam", "distance_m": 5.0, "elevation_deg": 24.0}
RANGE_COLOUR, IMAGE_COLOUR = (255, 209, 56), (255, 120, 255)


def make(k: float, *, noise: str, **rest: object) -> Observation:
    """A view of a field of rocks that cover the share k of the ground."""
    field = {"kind": "golombek-rapp", "k": k, "d_min_m": 0.12, "d_max_m": 0.7, "radius_m": 3.2}
    table = {
        "seed": SEED,
        "rocks": ROCKS,
        "population": field,
        "camera": CAMERA,
        "noise": {"kind": noise},
        "sensor": {"full_well_e": 20000.0, "read_noise_e": 25.0},
        "views": {"count": 1, "start_deg": 20.0},
    }
    spec = convert_spec(table | rest, where="benchmark")
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "data"
        write_scene(spec, 0, choose_backend("auto"), folder)
        write_common(spec, choose_backend("auto"), folder)
        camera = read_camera(folder / "camera.json")
        image = read_image(folder / "000000" / "gray" / "000000.png")
        points = read_range(
            folder / "000000" / "depth" / "000000.png", shape=image.shape, camera=camera
        )
    return Observation(image=image, points_m=points, camera=camera)


def median_ms(work: Callable[[], object]) -> float:
    """Median processor time of five runs after one to warm up."""
    work()
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return 1000 * float(np.median(times))


def by_range(observation: Observation) -> np.ndarray:
    """Ground and rocks from range alone."""
    ground, heights = stand(observation)
    return find_by_range(heights, ground)


def stand(observation: Observation) -> tuple[Ground, HeightSignal]:
    """Ground of an observation with range, and the heights over it."""
    ground = ground_among_rocks(observation)
    assert ground is not None
    heights = heights_over(observation, ground)
    assert heights is not None
    return ground, heights


def print_times() -> None:
    """Print the table of times."""
    cv2.setNumThreads(1)
    print("frame     rocks  way                          ms  times the floor")
    waves = {"ripple_height_m": 0.05, "ripple_length_m": 0.6}
    for name, k, rest in (
        ("sparse", 0.06, {}),
        ("crowded", 0.30, {}),
        ("ripples", 0.08, {"ground": waves}),
    ):
        observation = make(k, noise="stereo", **rest)
        blind = Observation(image=observation.image, camera=observation.camera)
        labels = by_range(observation)
        mask = (labels > 0).astype(np.uint8)
        floor = median_ms(lambda mask=mask: cv2.connectedComponentsWithStats(mask))
        ways: dict[str, Callable[[], object]] = {
            "ground and range": lambda o=observation: by_range(o),
            "image alone": lambda o=blind: FINDERS["both"].segment(o),
            "range, image and edges": lambda o=observation: FINDERS["both"].segment(o),
            "as published": lambda o=observation: FINDERS["published"].segment(o),
        }
        print(f"{name:9s} {labels.max():5d}  {'connected regions':24s} {floor:8.1f}")
        for way, work in ways.items():
            spent = median_ms(work)
            print(f"{name:9s} {labels.max():5d}  {way:24s} {spent:8.1f}  {spent / floor:10.0f}")


def outlined(observation: Observation, found: Segmentation) -> np.ndarray:
    """The image with each rock's outline, yellow where range found it and pink where the image."""
    grey = np.clip(np.rint(observation.image * 255), 0, 255).astype(np.uint8)
    canvas = np.repeat(grey[..., None], 3, axis=2)
    for one in found.found:
        ring = (
            trace_outline(found.labels == one.number)
            if one.outline is None
            else one.outline.points_px
        )
        colour = RANGE_COLOUR if one.branch == "range" else IMAGE_COLOUR
        fixed = np.rint(ring * 16).astype(np.int32)
        thick = max(1, round(max(canvas.shape) / 500))
        cv2.polylines(canvas, [fixed], True, colour, thick, cv2.LINE_AA, shift=4)
    return canvas


def draw_steps(path: Path) -> None:
    """Draw the steps of the robust way on a crowded field whose pictures were matched."""
    observation = make(0.2, noise="sgm")
    ground, relief = stand(observation)
    lightness = read_lightness(observation.image)
    labels = find_by_range(relief, ground)
    colours = np.random.default_rng(3).uniform(0.25, 1, (int(labels.max()) + 1, 3))
    colours[0] = 0
    kinds = np.where(lightness.cast, 2, lightness.unlike.astype(int))
    panels: list[tuple[str, np.ndarray, dict[str, object]]] = [
        ("1  the image", observation.image, {"cmap": "gray", "vmin": 0, "vmax": 1}),
        (
            "2  height above the ground, in its noise",
            np.where(relief.known, np.clip(relief.signal, -5, 40), np.nan),
            {"cmap": "viridis"},
        ),
        ("3  what stands: 2.5 σ, somewhere 5 σ", standing(relief), {"cmap": "gray"}),
        ("4  cut at valleys and jumps of depth", colours[labels], {}),
        (
            "5  unlike the ground; blue: cast shadow",
            np.array([[0.0, 0, 0], [0.85, 0.85, 0.85], [0.2, 0.45, 1.0]])[kinds],
            {},
        ),
        (
            "6  rocks, at the image's edges",
            outlined(observation, FINDERS["both"].segment(observation)),
            {},
        ),
    ]
    _page(panels, path, columns=3)


def draw_ways(path: Path) -> None:
    """Draw the published and the robust way on a scene of each kind."""
    scenes = {
        "sparse": make(0.06, noise="stereo"),
        "crowded": make(0.3, noise="stereo"),
        "slope": make(0.1, noise="stereo", ground={"slope_deg": 14, "burial": [0, 0.4]}),
        "ripples": make(
            0.08, noise="stereo", ground={"ripple_height_m": 0.05, "ripple_length_m": 0.6}
        ),
        "low sun": make(0.1, noise="stereo", sun={"elevation_deg": 14.0, "ambient": 0.2}),
        "matched": make(0.2, noise="sgm"),
    }
    panels: list[tuple[str, np.ndarray, dict[str, object]]] = []
    for name, observation in scenes.items():
        blind = Observation(image=observation.image, camera=observation.camera)
        for way, given in (
            ("published", observation),
            ("robust", observation),
            ("no range", blind),
        ):
            found = FINDERS["published" if way == "published" else "both"].segment(given)
            panels.append((f"{name}: {way}", outlined(observation, found), {}))
    _page(panels, path, columns=3)


def draw_mars(path: Path) -> None:
    """Draw the Mars frame as published, robust, and robust without range."""
    image = read_image(MARS / "i944014r.png")
    points = read_range(MARS / "i944014r_xyz.npz", shape=image.shape, camera=None)
    observation = Observation(image=image, points_m=points)
    panels: list[tuple[str, np.ndarray, dict[str, object]]] = [
        ("as published", outlined(observation, FINDERS["published"].segment(observation)), {}),
        ("robust", outlined(observation, FINDERS["both"].segment(observation)), {}),
        (
            "robust, without range",
            outlined(observation, FINDERS["both"].segment(Observation(image=image))),
            {},
        ),
    ]
    _page(panels, path, columns=3, top=0)


def _page(
    panels: list[tuple[str, np.ndarray, dict[str, object]]],
    path: Path,
    *,
    columns: int,
    top: int = 200,
) -> None:
    mpl.use("Agg")
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.2 * columns, 3.5 * rows), dpi=100)
    for axis, (title, picture, options) in zip(axes.ravel(), panels, strict=False):
        axis.imshow(picture[top:], interpolation="nearest", **options)
        axis.set_title(title, fontsize=9)
        axis.set_axis_off()
    figure.tight_layout(pad=1.0)
    figure.savefig(path, pil_kwargs={"quality": 70})
    plt.close(figure)


def main() -> None:
    """Print the times, or draw what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=Path, metavar="PICTURE")
    parser.add_argument("--mars", type=Path, metavar="PICTURE")
    parser.add_argument("--ways", type=Path, metavar="PICTURE")
    args = parser.parse_args()
    if args.steps:
        draw_steps(args.steps)
    if args.ways:
        draw_ways(args.ways)
    if args.mars:
        draw_mars(args.mars)
    if not (args.steps or args.ways or args.mars):
        print_times()


if __name__ == "__main__":
    main()
