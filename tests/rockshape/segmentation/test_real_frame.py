"""A real frame has the same rocks with all versions of the libraries, the oldest and the newest."""

import rockshape
from tests.paths import MARS_IMAGE, MARS_RANGE


def test_the_mars_frame_has_the_same_rocks_everywhere() -> None:
    found = rockshape.measure(rockshape.read(MARS_IMAGE, range=MARS_RANGE))
    assert len(found) == 8
