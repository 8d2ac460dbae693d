import numpy as np
import pytest
from hypothesis import settings

# the same examples in every run, and no deadline: a loaded machine is no defect
settings.register_profile("steady", derandomize=True, deadline=None)
settings.load_profile("steady")


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers that are the same in every run."""
    return np.random.default_rng(20261122)
