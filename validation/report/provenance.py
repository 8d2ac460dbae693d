"""What a run was made with."""

import platform
from importlib.metadata import version

from validation.execution.run import Run

_PACKAGES = ("rockshape", "numpy", "scipy", "opencv-python-headless", "scikit-image", "pandas")


def versions() -> dict[str, str]:
    """Versions that can move a score."""
    return {"python": platform.python_version()} | {name: version(name) for name in _PACKAGES}


def seeds(run: Run) -> dict[str, int]:
    """First seed of each experiment."""
    return {experiment.name: experiment.seed for experiment in run.suite.experiments}
