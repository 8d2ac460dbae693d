"""Range files cut short anywhere in their first bytes are refused, and soon."""

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from rockshape.errors import InputError
from rockshape.io import read_range
from tests.rockshape.io.sphere_scene import sphere_scene
from tests.rockshape.io.test_every_format import RANGE_FILES

SOON_S = 60
CUTS = [*range(40), 80, 160, 320, 640]


@pytest.fixture(autouse=True)
def _alarm() -> Iterator[None]:
    """Fail what never ends by itself; the guard of readers takes the error for a refusal."""
    rung = []

    def ring(*_: object) -> None:
        rung.append(True)
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, SOON_S, 1.0)  # again and again: each cut may hang
    yield
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)
    assert not rung, f"no end within {SOON_S} s"


# PDS4 has its data beside it, and an IMP table that ends with a row is a whole one
@pytest.mark.parametrize("name", sorted(set(RANGE_FILES) - {"PDS4", "IMP table"}))
def test_a_file_cut_short_is_refused(tmp_path: Path, name: str) -> None:
    scene = sphere_scene()
    whole = RANGE_FILES[name][0](tmp_path, scene)
    data = whole.read_bytes()
    cut = whole.with_name(f"cut{whole.suffix}")
    for length in CUTS:
        assert length < len(data)
        cut.write_bytes(data[:length])
        with pytest.raises(InputError):
            read_range(cut, shape=scene.depth_m.shape, camera=None)
