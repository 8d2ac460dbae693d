"""Baselines for the form of rocks on a block of known sides."""

import numpy as np
import pytest

from tests import solids
from validation.peers import forms

SIDES = (0.4, 0.3, 0.2)
TOP_M = 2.0


def block() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Image, labels and points of a block that lies under the camera, its top seen alone."""
    far = solids.CAMERA.unproject(np.full(solids.CAMERA.shape, TOP_M + SIDES[2]))
    near = solids.CAMERA.unproject(np.full(solids.CAMERA.shape, TOP_M))
    labels = (np.abs(near[..., 0]) <= SIDES[0] / 2) & (np.abs(near[..., 1]) <= SIDES[1] / 2)
    points = np.where(labels[..., None], near, far)
    return np.zeros(labels.shape, dtype=np.float32), labels.astype(np.int32), points


def test_a_block_seen_from_above_is_the_box_of_its_top_and_its_foot() -> None:
    a, b, c = SIDES
    found = forms.visible_box(*block())["sphericity_3d"]
    assert found == pytest.approx([(c * c / (a * b)) ** (1 / 3)], rel=0.01)


def test_one_value_is_the_same_for_all() -> None:
    image, labels, points = block()
    labels[labels == 0] = 2
    assert len(set(forms.one_value(image, labels, points)["sphericity_3d"])) == 1
