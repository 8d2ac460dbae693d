"""Flags and visible fraction of found rocks against the truth."""

from collections import Counter

import msgspec
import numpy as np
from case import Case, Column, Table
from views import MadeView, made_views

from rockshape.pipeline import measure
from validation.suite.suite import load_suite

FLAG_SEEDS = {"sparse": 50_000, "crowded": 50_100, "slope": 50_300}
MIN_IOU = 0.5
HIDDEN, SMALL_PX, BURIED = 0.95, 12, 0.15


def flags(
    *, experiments: tuple[str, ...] = tuple(FLAG_SEEDS), preset: str | None = None
) -> list[Table]:
    """Hold flags and visible fractions to the truth of made scenes, from exact range."""
    told: Counter[tuple[str, bool, bool]] = Counter()
    misses: list[float] = []
    for experiment in load_suite("segmentation").experiments:
        if experiment.name not in experiments:
            continue
        noise = msgspec.structs.replace(experiment.scene.noise, kind="none")
        spec = msgspec.structs.replace(
            experiment.scene, seed=FLAG_SEEDS[experiment.name], noise=noise
        )
        if preset:
            camera = msgspec.structs.replace(spec.camera, preset=preset)
            spec = msgspec.structs.replace(spec, camera=camera)
        for view in made_views(spec):
            _judge(view, told, misses)
    rows = []
    for flag in ("truncated", "occluded", "small", "buried"):
        counts = [(told[flag, so, True], told[flag, so, False]) for so in (True, False)]
        rows.append((flag, *(n for hit, miss in counts for n in (hit, hit + miss))))
    missed = np.array(misses)
    missed = missed[np.isfinite(missed)]
    heads = ("flagged", "that have it", "flagged wrongly", "that do not")
    return [
        Table((Column("flag"), *(Column(head, "rocks", "d") for head in heads)), rows, "flags"),
        Table(
            (
                Column("rocks", "", "d"),
                Column("bias", "", "+.3f"),
                Column("median error", "", ".3f"),
                Column("nine of ten under", "", ".3f"),
            ),
            [
                (
                    len(missed),
                    missed.mean(),
                    np.median(np.abs(missed)),
                    np.quantile(np.abs(missed), 0.9),
                )
            ],
            name="visible_fraction",
        ),
    ]


def _judge(view: MadeView, told: Counter[tuple[str, bool, bool]], misses: list[float]) -> None:
    """Count the flags of one view's rocks that match a true one.

    Truth: cut by the frame; less than 95 % visible; narrower than 12 px; more than 15 % of the
    volume below the ground, beside none of it.
    """
    made = measure(view.observation, method="robust")
    sizes = np.bincount(view.labels.ravel())
    for rock, found in zip(made.rocks, made.found, strict=True):
        mask = made.labels == found.number
        common = np.bincount(view.labels[mask], minlength=len(sizes))
        common[0] = 0
        best = int(common.argmax())
        if common[best] <= MIN_IOU * (mask.sum() + sizes[best] - common[best]):
            continue
        true, buried = view.seen[best - 1], view.rocks[best - 1]["buried_fraction"]
        wide, high = (int(np.ptp(axis)) + 1 for axis in np.nonzero(view.labels == best))
        hidden = true["visible_fraction"] < HIDDEN
        is_so = {"truncated": true["truncated"], "small": min(wide, high) < SMALL_PX}
        if not true["truncated"]:
            is_so["occluded"] = hidden
        if not (true["truncated"] or hidden or 0 < buried <= BURIED):
            is_so["buried"] = buried > BURIED
        for flag, so in is_so.items():
            told[flag, so, flag in found.flags] += 1
        misses.append(rock.visible_fraction - true["visible_fraction"])


SEGMENTATION_FLAGS_CASE = Case(
    name="segmentation_flags",
    what="flags and visible fraction of found rocks against the truth, exact range",
    run=flags,
    smallest={"experiments": ("sparse",), "preset": "imp"},
)
