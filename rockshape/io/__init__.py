"""Files in and out: the rim of the package, where paths become arrays."""

from rockshape.io.cameras import read_camera
from rockshape.io.images import read_image, read_labels, write_image
from rockshape.io.range import read_range

__all__ = ["read_camera", "read_image", "read_labels", "read_range", "write_image"]
