"""Training loop, resumed from its last checkpoint."""

import copy
import time
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from rockshape.segmentation.by_network.picture import normalized
from training.augment import draw_crop
from training.network import Network
from training.targets import targets_of
from training.tile import Tile
from training.warm_start import start_from

_WARM_STEPS = 100
_AVERAGED_SHARE = 0.002  # of the last step in the mean of weights
_AHEAD = 6  # batches that are made while others are learnt
_BORDER_WEIGHT = 2.0
_DISTANCE_WEIGHT = 6.0
_WIDTH_WEIGHT = 0.3


@dataclass(frozen=True)
class Course:
    """How long the network is taught, and from which draw."""

    steps: int
    crops: int  # a step
    seed: int = 0
    side_px: int = 192  # of a crop
    checkpoint_steps: int = 200
    grey: bool = False  # without colour
    plain: bool = False  # rocks as they are made, and nothing drawn over them
    rate: float = 2e-3  # of learning, at its greatest
    start: Path | None = None  # exported network to begin with


def train(tiles: Sequence[Tile], course: Course, folder: Path) -> Network:
    """Network taught on crops of tiles, its weights averaged over the last steps.

    Checkpoints lie in `folder`; a run that was cut off goes on from its last one. Step k draws its
    crops from a generator of k alone, so a resumed run sees what an undisturbed one does.
    """
    torch.manual_seed(course.seed)
    network = Network().to(memory_format=torch.channels_last)
    if course.start is not None:
        start_from(network, course.start, _batch(tiles, course, 0)[0])
    average = copy.deepcopy(network)
    optimizer = torch.optim.AdamW(network.parameters(), lr=course.rate, weight_decay=1e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer,
        course.rate,
        total_steps=course.steps + 1,
        pct_start=min(0.3, _WARM_STEPS / course.steps),
        cycle_momentum=False,
    )
    parts = {"network": network, "average": average, "optimizer": optimizer, "schedule": schedule}
    checkpoint = folder / "checkpoint.pt"
    first = _resumed(checkpoint, parts)
    begun, losses = time.monotonic(), []
    for step, (pictures, answers) in enumerate(
        _batches(tiles, course, range(first, course.steps)), start=first + 1
    ):
        with torch.autocast("cpu", torch.bfloat16, enabled=_has_fast_bfloat16()):
            found = network(pictures.contiguous(memory_format=torch.channels_last))
        loss = _loss(found.float(), answers)
        optimizer.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(network.parameters(), 2.0)
        optimizer.step()
        schedule.step()
        _average(average, network, step)
        losses.append(loss.item())
        if step % 50 == 0:
            took = time.monotonic() - begun
            print(f"step {step}: loss {np.mean(losses[-50:]):.4f}, {took:.0f} s", flush=True)
        if step % course.checkpoint_steps == 0 or step == course.steps:
            _save(checkpoint, step, parts)
    return average.eval()


def _batches(
    tiles: Sequence[Tile], course: Course, steps: range
) -> Iterator[tuple[Tensor, Tensor]]:
    """Yield the batch of each step, made by a thread beside."""
    with ThreadPoolExecutor(1) as maker:
        waiting = deque(maker.submit(_batch, tiles, course, step) for step in steps[:_AHEAD])
        for step in steps:
            batch = waiting.popleft().result()
            if step + _AHEAD < steps.stop:
                waiting.append(maker.submit(_batch, tiles, course, step + _AHEAD))
            yield batch


def _batch(tiles: Sequence[Tile], course: Course, step: int) -> tuple[Tensor, Tensor]:
    """Pictures (crops, 3, side, side) and answers (crops, 5, side, side)."""
    rng = np.random.default_rng([course.seed, 70, step])
    pictures, answers = [], []
    for number in rng.integers(len(tiles), size=course.crops).tolist():
        picture, labels = draw_crop(tiles[number], course.side_px, rng, plain=course.plain)
        targets = targets_of(labels)
        pictures.append(normalized(picture.mean(axis=-1) if course.grey else picture))
        answers.append(
            np.stack(
                [targets.rock, targets.border, targets.distance, targets.width, targets.counts]
            )
        )
    return torch.from_numpy(np.stack(pictures)), torch.from_numpy(np.stack(answers))


def _loss(found: Tensor, wanted: Tensor) -> Tensor:
    """Sum of the losses of the four maps, where they count."""
    rock, border, distance, width, counts = wanted.unbind(1)
    entropy = nn.functional.binary_cross_entropy_with_logits
    inside = rock * counts
    parts = [
        _mean(entropy(found[:, 0], rock, reduction="none"), counts),
        _BORDER_WEIGHT * _mean(entropy(found[:, 1], border, reduction="none"), counts),
        _DISTANCE_WEIGHT * _mean((torch.sigmoid(found[:, 2]) - distance).square(), counts),
        _WIDTH_WEIGHT
        * _mean(nn.functional.smooth_l1_loss(found[:, 3], width, reduction="none"), inside),
    ]
    return torch.stack(parts).sum()


def _mean(values: Tensor, weights: Tensor) -> Tensor:
    return (values * weights).sum() / weights.sum().clamp(min=1.0)


def _average(average: Network, network: Network, step: int) -> None:
    """Move running means of weights towards what they are after a step."""
    share = max(_AVERAGED_SHARE, 10.0 / (step + 10.0))
    with torch.no_grad():
        for mean, value in zip(
            average.state_dict().values(), network.state_dict().values(), strict=True
        ):
            if mean.is_floating_point():
                mean.lerp_(value, share)
            else:
                mean.copy_(value)


def _has_fast_bfloat16() -> bool:
    return bool(torch.cpu._is_amx_tile_supported() or torch.cpu._is_avx512_bf16_supported())


def _resumed(checkpoint: Path, parts: Mapping[str, Any]) -> int:
    """Number of steps already done."""
    if not checkpoint.exists():
        return 0
    saved = torch.load(checkpoint, weights_only=True)
    for name, part in parts.items():
        part.load_state_dict(saved[name])
    return int(saved["step"])


def _save(checkpoint: Path, step: int, parts: Mapping[str, Any]) -> None:
    partly = checkpoint.with_suffix(".part")
    torch.save({"step": step, **{name: part.state_dict() for name, part in parts.items()}}, partly)
    partly.replace(checkpoint)
