"""Exact range: the sensor `none`."""

from synth.sensor.sensor import Capture, Sensor, SensorInput


def _capture(shot: SensorInput) -> Capture:
    return Capture(picture=shot.picture, depth_m=shot.view.depth_m)


EXACT = Sensor("none", "exact range", _capture, exact_range=True)
