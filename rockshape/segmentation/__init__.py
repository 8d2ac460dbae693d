"""Segmentation of rocks: as published, by range, by the image, or by both; see `finders`.

Names are imported when first asked for: rocks that are given need none of it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
