"""What a sensor makes of a view: a picture of so many bits, and range with its errors."""

from synth.sensor.capture import Capture, capture_view

__all__ = ["Capture", "capture_view"]
