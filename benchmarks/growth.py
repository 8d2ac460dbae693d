"""How the time of a frame grows with its pixels and with its rocks: fitted exponents.

Run `python benchmarks/growth.py`. Processor time, so that other work does not bend the line; the
best of two. Two series: 64 rocks that grow with the frame, from 512² to
4096²; and rocks of 40 pixels in a frame of 4096², from 10 to 1,000. An exponent of 1 is linear.
"""

import argparse
import time

import numpy as np
from made_frame import make_frame

from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.pipeline import measure

SIDES = (512, 1024, 2048, 4096)
ROCKS = (10, 32, 100, 316, 1000)
RADIUS_PX = 20.0
LARGE = 4096


def seconds(*, side_px: int, rocks: int, radius_px: float | None, method: str) -> tuple[float, int]:
    """Processor time to find and measure a frame's rocks, the best of two, and the rocks found."""
    frame = make_frame(side_px=side_px, rocks=rocks, radius_px=radius_px)
    observation = Observation(image=frame.image, points_m=frame.points_m, camera=frame.camera)
    best, found = np.inf, 0
    for _ in range(2):
        start = time.process_time()
        found = len(measure(observation, method=method).rocks)
        best = min(best, time.process_time() - start)
    return best, found


def exponent(sizes: list[int], times: list[float]) -> float:
    """The power p of the best line through log(time) over log(size)."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def main() -> None:
    """Print both series and their exponents."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--method", choices=tuple(methods()), default="paper")
    parser.add_argument("--largest", type=int, default=LARGE, help="side of the largest frame, px")
    args = parser.parse_args()
    seconds(side_px=256, rocks=4, radius_px=None, method=args.method)  # warms up
    sizes, times = [], []
    print(f"{'pixels':>10s}{'rocks':>7s}{'found':>7s}{'s':>9s}{'µs/pixel':>10s}")
    for side in (side for side in SIDES if side <= args.largest):
        spent, found = seconds(side_px=side, rocks=64, radius_px=None, method=args.method)
        sizes.append(side**2)
        times.append(spent)
        print(
            f"{side**2:10d}{64:7d}{found:7d}{spent:9.3f}{1e6 * spent / side**2:10.3f}", flush=True
        )
    print(f"exponent over pixels, rocks growing along: {exponent(sizes, times):.2f}\n")
    sizes, times = [], []
    bare, _ = seconds(side_px=args.largest, rocks=1, radius_px=RADIUS_PX, method=args.method)
    print(f"{'rocks':>10s}{'found':>7s}{'s':>9s}{'ms/rock over one rock alone':>30s}")
    for rocks in (rocks for rocks in ROCKS if rocks <= (args.largest / 50) ** 2):
        spent, found = seconds(
            side_px=args.largest, rocks=rocks, radius_px=RADIUS_PX, method=args.method
        )
        sizes.append(rocks)
        times.append(spent)
        share = 1e3 * (spent - bare) / (rocks - 1)
        print(f"{rocks:10d}{found:7d}{spent:9.3f}{share:30.2f}", flush=True)
    fixed = np.array(times) - bare
    kept = fixed > 0.05 * bare
    print(f"exponent over rocks, with the bare frame of {bare:.2f} s: {exponent(sizes, times):.2f}")
    if kept.sum() > 1:
        power = exponent(list(np.array(sizes)[kept]), list(fixed[kept]))
        print(f"exponent over rocks, of what they add: {power:.2f}")


if __name__ == "__main__":
    main()
