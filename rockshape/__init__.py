"""Measure the shape of rocks from an image and its range.

`measure` takes arrays; each measure by itself is a function of `rockshape.measures`. Names and
submodules are imported when first asked for.

The parts, in the order data flows through them: `io` reads files, `observation` holds an image and
its range, `ground` and `segmentation` find the rocks, `outline`, `ellipse`, `ellipsoid` and
`surface` fit each, `measures` turns fits into numbers, `pipeline` joins all that, `measurement`
is what comes out, with its table, and `report` shows it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
