"""Plain finders on pictures whose rocks are plain."""

import numpy as np

from validation.peers.finders import PEER_FINDERS


def test_peer_finders_find_nothing_in_an_even_picture_and_discs_in_one_with_discs() -> None:
    from rockshape.inputs.arrays import observe

    for finder in PEER_FINDERS.values():
        even = finder.segment(observe(np.full((80, 80, 3), 90, np.uint8)))
        assert len(even.found) <= 1  # at most the whole picture, which touches the frame
    y, x = np.mgrid[:120, :120]
    disc = np.hypot(x - 60, y - 60) < 25
    colour = np.where(disc[..., None], (90, 95, 110), (190, 130, 90)).astype(np.uint8)
    for name in ("otsu", "otsu-b"):
        assert ((PEER_FINDERS[name].segment(observe(colour)).labels > 0) == disc).all()
    ring = np.hypot(x - 60, y - 60)
    gaps = np.where((ring > 25) & (ring < 29), 30, 150).astype(np.uint8)
    found = PEER_FINDERS["top-hat"].segment(observe(gaps)).labels
    inside = found == found[60, 60]
    assert (inside & disc).sum() / (inside | disc).sum() > 0.9
    bright = np.where(disc, 200, 80).astype(np.uint8)
    found = PEER_FINDERS["local-threshold"].segment(observe(bright)).labels
    assert (found > 0)[disc].mean() > 0.9
