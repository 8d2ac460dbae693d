"""Parameters of pictures: colour, and maps beside them."""

from msgspec import Struct


class ImageSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Pictures of a scene beside the grey one."""

    colour: bool = False  # also a colour picture
    normals: bool = False  # also the surface's normal at every pixel
