"""Pixel size that a TIFF tells: of GeoTIFF in a projected system, and of ImageJ's calibration.

The resolution of a plain TIFF is that of a print and tells nothing of what is seen.

Source: OGC GeoTIFF 1.1 (19-008r4), tags 33550, 34264, 34735 and keys 1024, 3072, 3076; ImageJ's
`unit` in tag 270, with pixels a unit in tag 282.
"""

from math import hypot, isclose
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tifffile import TiffPage

PIXEL_SCALE, TRANSFORM, KEYS = 33550, 34264, 34735
X_RESOLUTION, Y_RESOLUTION = 282, 283
MODEL_TYPE, PROJECTED_SYSTEM, LINEAR_UNIT = 1024, 3072, 3076
PROJECTED = 1
METRES = {9001: 1.0, 9002: 0.3048, 9003: 1200 / 3937}  # EPSG's metre, foot, US survey foot
UTM = (range(32601, 32661), range(32701, 32761))  # systems whose unit is the metre
UNITS_M = {
    "m": 1.0,
    "meter": 1.0,
    "metre": 1.0,
    "cm": 0.01,
    "mm": 1e-3,
    "um": 1e-6,
    "µm": 1e-6,
    "μm": 1e-6,
    "\\u00b5m": 1e-6,
    "micron": 1e-6,
    "microns": 1e-6,
    "nm": 1e-9,
    "inch": 0.0254,
}


def pixel_size_m(page: "TiffPage", imagej: dict[str, Any] | None) -> float | None:
    """Length of a pixel's side in metres; None where it is not told or pixels are not square."""
    sides = _geotiff_sides(page) or _imagej_sides(page, imagej or {})
    if sides is None or min(sides) <= 0 or not isclose(*sides, rel_tol=1e-3):
        return None
    return sides[0]


def _geotiff_sides(page: "TiffPage") -> tuple[float, float] | None:
    if page.tags.valueof(KEYS) is None:
        return None
    told = geo_keys(page)
    unit_m = METRES.get(told.get(LINEAR_UNIT, 0))
    if any(told.get(PROJECTED_SYSTEM) in zones for zones in UTM):
        unit_m = unit_m or 1.0
    # a system by degrees, or with a unit that is not told, has no size in metres; the metres of
    # Web Mercator are longer the farther from the equator
    if told.get(MODEL_TYPE) != PROJECTED or unit_m is None or told.get(PROJECTED_SYSTEM) == 3857:
        return None
    scale, transform = page.tags.valueof(PIXEL_SCALE), page.tags.valueof(TRANSFORM)
    if scale is not None:
        return float(scale[0]) * unit_m, float(scale[1]) * unit_m
    if transform is not None:
        a, b, _, _, d, e = (float(each) * unit_m for each in transform[:6])
        return hypot(a, d), hypot(b, e)
    return None


def geo_keys(page: "TiffPage") -> dict[int, int]:
    """Short values of a page's GeoTIFF keys."""
    numbers = [int(each) for each in page.tags.valueof(KEYS)]
    return {numbers[k]: numbers[k + 3] for k in range(4, len(numbers) - 3, 4) if not numbers[k + 1]}


def _imagej_sides(page: "TiffPage", imagej: dict[str, Any]) -> tuple[float, float] | None:
    unit_m = UNITS_M.get(str(imagej.get("unit", "")).strip().lower())
    a, b = page.tags.valueof(X_RESOLUTION), page.tags.valueof(Y_RESOLUTION)
    if unit_m is None or not a or not b or not a[0] or not b[0]:
        return None
    return unit_m * a[1] / a[0], unit_m * b[1] / b[0]
