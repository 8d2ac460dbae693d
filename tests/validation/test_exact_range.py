"""A scene's range is exact where its sensor's record says so, be it ours or from outside."""

from dataclasses import replace

import pytest

from synth.sensor import Sensor, find_sensor, register_sensor
from synth.spec import SceneSpec
from synth.spec.sensor import NoiseSpec
from validation.suite.scene import has_exact_range


@pytest.mark.parametrize(("kind", "exact"), [("none", True), ("stereo", False), ("sgm", False)])
def test_our_sensors(kind: str, exact: bool) -> None:
    assert has_exact_range(SceneSpec(noise=NoiseSpec(kind=kind))) == exact


@pytest.mark.parametrize("exact", [True, False])
def test_a_sensor_from_outside(exact: bool) -> None:
    ours: Sensor = find_sensor("none")
    register_sensor(replace(ours, name="guest", exact_range=exact))
    assert has_exact_range(SceneSpec(noise=NoiseSpec(kind="guest"))) == exact
