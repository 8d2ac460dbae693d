import numpy as np
import pytest
from hypothesis import settings

from synth.spec.rocks import FAMILIES
from synth.spec.sensor import SENSORS

# the same examples in every run, and no deadline: a loaded machine is no defect
settings.register_profile("steady", derandomize=True, deadline=None)
settings.load_profile("steady")


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers that are the same in every run."""
    return np.random.default_rng(20261122)


@pytest.fixture(autouse=True)
def no_registered_records(monkeypatch: pytest.MonkeyPatch) -> None:
    """Begin without the sensors and families that modules of tests register as they are imported.

    What depends on them, such as whether a rendered view may be kept, is then the same whatever
    tests the process has collected or run before.
    """
    for registry in (SENSORS, FAMILIES):
        monkeypatch.setattr(registry, "_registered", {})
