"""Sensors: from a rendered view to an image and a range with the errors of measurement."""

from synth.sensor.capture import capture_view, sensor_of
from synth.sensor.sensor import Capture, Sensor, SensorInput, find_sensor, register_sensor

__all__ = [
    "Capture",
    "Sensor",
    "SensorInput",
    "capture_view",
    "find_sensor",
    "register_sensor",
    "sensor_of",
]
