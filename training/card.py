"""Card of the shipped weights: their size, and their scores on made pictures that they never saw.

`python -m training.card` measures both and compares them with training/card.json; it fails where
they differ. `--write` writes that file afresh.
"""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import pandas as pd

from rockshape.segmentation.by_network.instances import cut_rocks
from rockshape.segmentation.by_network.picture import as_fractions
from rockshape.segmentation.by_network.scales import SCALES, joint_answer
from rockshape.segmentation.by_network.weights import NETWORK, read_weights
from synth.dataset.workers import worker_pool
from training.mixture import JUDGED, PARTS, Shard
from training.tile import SIDE_PX, Tile
from validation.records.object_matching import (
    Rule,
    equivalent_diameter,
    judge,
    whole_and_wide,
)
from validation.scores.object_scores import count, f1, precision, recall

CARD = Path(__file__).parent / "card.json"
PAGE = Path(__file__).parent.parent / "docs" / "finder.md"
_TILES = 12  # of each part
_RULE = Rule(0.5, 12.0, equivalent_diameter)
_SHOWN = ("f1", "precision", "recall")
_TOLERANCE = 0.005  # processors round differently


def card(*, jobs: int) -> dict[str, Any]:
    """Size of the shipped network, and its scores on each part of the mixture."""
    content = read_weights(NETWORK)
    with worker_pool(jobs) as pool:
        waiting = {part.name: pool.submit(_scores, part.name) for part in PARTS[::-1]}
        scores = {part.name: waiting[part.name].result() for part in PARTS}
    return {**_size(content), "tiles": _TILES, "scores": scores}


def _size(content: bytes) -> dict[str, Any]:
    network = onnx.load_from_string(content)
    weights = sum(int(np.prod(one.dims)) for one in network.graph.initializer)
    return {
        "bytes": len(content),
        "parameters": weights,
        "gmac_a_megapixel": round(sum(s * s for s in SCALES) * _products(network) / 1e9, 1),
    }


def _products(network: onnx.ModelProto) -> float:
    """Multiplications of the convolutions for a megapixel, at full scale."""
    side = 1024
    for dim, size in zip(
        network.graph.input[0].type.tensor_type.shape.dim[2:], (side, side), strict=True
    ):
        dim.dim_value = size
    shaped = onnx.shape_inference.infer_shapes(network)
    sizes = {
        value.name: [dim.dim_value for dim in value.type.tensor_type.shape.dim]
        for value in (*shaped.graph.value_info, *shaped.graph.output)
    }
    weights = {one.name: int(np.prod(one.dims)) for one in shaped.graph.initializer}
    total = 0.0
    for node in shaped.graph.node:
        if node.op_type == "Conv":
            rows, cols = sizes[node.output[0]][2:]
            total += weights[node.input[1]] * rows * cols
    return total * 1e6 / side**2


def _scores(part: str) -> dict[str, float]:
    """Scores on tiles of a part that neither weights nor likelihood were fitted to."""
    tiles = Shard(part, JUDGED, _TILES).make()
    rows = pd.concat([_judged(tile) for tile in tiles])
    status = rows["status"].to_numpy()
    counts = count(status, np.ones((1, len(status))))
    scores = {"f1": f1(counts), "precision": precision(counts), "recall": recall(counts)}
    rocks, beside = int(counts.matched[0] + counts.missed[0]), int(counts.extra[0])
    told: dict[str, float] = {
        "rocks": rocks,
        "found_beside": beside,
        "found_beside_a_megapixel": round(beside * 1e6 / (_TILES * SIDE_PX**2), 1),
    }
    if rocks:
        told |= {name: round(float(value[0]), 4) for name, value in scores.items()}
    return told


def _judged(tile: Tile) -> pd.DataFrame:
    """Rows of the rocks of a tile that count: whole ones of 12 px and more."""
    truth = tile.labels.astype(np.int32)
    found = cut_rocks(joint_answer(as_fractions(tile.image)))
    return judge(truth, whole_and_wide(truth, _RULE.min_width_px), found, {}, _RULE)


def with_table(page: str, card: dict[str, Any]) -> str:
    """Page with the card between its marks `<!-- card -->` and `<!-- end -->`."""
    before, _, rest = page.partition("<!-- card -->\n")
    after = rest.partition("<!-- end -->")[2]
    return f"{before}<!-- card -->\n\n{_markdown(card)}\n\n<!-- end -->{after}"


def _markdown(card: dict[str, Any]) -> str:
    size = (
        f"{card['parameters']:,} parameters, {card['bytes'] / 1e6:.1f} MB, "
        f"{card['gmac_a_megapixel']:.0f} billion multiplications for a megapixel at all scales. "
        f"Scores on {card['tiles']} tiles of each part, seed {JUDGED:,}:"
    )
    lines = ["| part | rocks | F1 | precision | recall | found beside, a megapixel |"]
    lines.append("| --- | --- | --- | --- | --- | --- |")
    for part, told in card["scores"].items():
        cells = [f"{told[name]:.2f}" if name in told else "–" for name in _SHOWN]
        beside = f"{told['found_beside_a_megapixel']:.0f}"
        lines.append(f"| {part} | {told['rocks']} | {' | '.join(cells)} | {beside} |")
    return size + "\n\n" + "\n".join(lines)


def differences(one: Any, two: Any, *, where: str = "card") -> list[str]:
    """What differs between two cards by more than rounding, a line each."""
    if isinstance(one, dict) and isinstance(two, dict):
        names = sorted(one.keys() | two.keys())
        return [
            line
            for name in names
            for line in differences(one.get(name), two.get(name), where=f"{where}.{name}")
        ]
    counts = isinstance(one, int) and isinstance(two, int)
    if isinstance(one, int | float) and isinstance(two, int | float):
        allowed = _TOLERANCE * max(abs(one), 1.0) if not counts else 0.01 * max(abs(one), 100)
        return [] if abs(one - two) <= allowed else [f"{where}: expected {one}, found {two}"]
    return [] if one == two else [f"{where}: expected {one}, found {two}"]


def main() -> int:
    """Measure, and write or compare."""
    parser = argparse.ArgumentParser(prog="python -m training.card", description=__doc__)
    parser.add_argument("--write", action="store_true", help="write the card afresh")
    parser.add_argument("--jobs", type=int, default=2, help="processes (%(default)s)")
    said = parser.parse_args()
    measured = card(jobs=said.jobs)
    print(json.dumps(measured, indent=2))
    if said.write:
        CARD.write_text(json.dumps(measured, indent=2) + "\n")
        PAGE.write_text(with_table(PAGE.read_text("utf-8"), measured), "utf-8")
        return 0
    wrong = differences(json.loads(CARD.read_text()), measured)
    print("\n".join(wrong) if wrong else "as the card says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
