"""Contacts: edges that neighbours, ignored regions and the frame make are no corners."""

import numpy as np
import pytest

import rockshape
from rockshape.measurement import to_frame
from tests import solids


def disc_beside(cut_px: int) -> np.ndarray:
    """A disc of 60 px radius whose right side a neighbour covers from so many px on."""
    disc = np.pad(solids.disc(60), 20)
    cols = np.arange(disc.shape[1]) - disc.shape[1] // 2
    return np.where(cols >= cut_px, 2, disc.astype(np.int32)).astype(np.int32)


def test_the_corners_that_a_neighbour_makes_do_not_count() -> None:
    labels = disc_beside(35)
    beside = rockshape.measure(labels=labels)[0]
    alone = rockshape.measure(labels=np.where(labels == 1, 1, 0).astype(np.int32))[0]
    assert alone.roundness < 0.75
    assert beside.roundness > 0.93
    assert beside.angularity_2d < 0.5 * alone.angularity_2d


def test_the_share_of_true_outline_is_told() -> None:
    rock = rockshape.measure(labels=disc_beside(35))[0]
    half_angle = np.arccos(35 / 60)
    chord, arc = 2 * 60 * np.sin(half_angle), 2 * (np.pi - half_angle) * 60
    # a staircase is longer than the arc it stands for
    assert rock.outline_share == pytest.approx(arc / (arc + chord), abs=0.06)
    lone = rockshape.measure(labels=np.pad(solids.disc(20), 5).astype(np.int32))
    assert to_frame(lone, flags=True)["outline_share"].tolist() == [1.0]


def test_a_rock_shut_in_by_others_is_refused() -> None:
    labels = np.full((60, 60), 2, dtype=np.int32)
    labels[20:40, 20:40] = 1
    shut_in = rockshape.measure(labels=labels)[0]
    assert shut_in.outline_share == 0
    assert shut_in.roundness.reason == shut_in.angularity_2d.reason == rockshape.Reason.CONTACTS
