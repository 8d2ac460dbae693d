"""Range files: z-depth or points for each pixel of the image."""

import io
import zipfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rockshape.camera import Camera
from rockshape.errors import InputError
from rockshape.io.files import read_bytes
from rockshape.io.images import decode

RANGE = "range (.npy, .npz with xyz or depth, float TIFF, or 16-bit PNG)"
KEYS = ("xyz", "depth")


def read_range(
    path: Path | str, *, shape: tuple[int, ...], camera: Camera | None
) -> NDArray[np.float64]:
    """Points (rows, cols, 3) in metres, NaN where nothing was measured.

    The file holds points (rows, cols, 3), taken as they are, or z-depth (rows, cols), which needs
    the camera; a 16-bit PNG counts the camera's depth_scale in millimetres, 0 meaning nothing.
    shape is the image's. A point with any part infinite or NaN is NaN whole.
    Raises InputError where the file is no such range or of another shape.
    """
    path = Path(path)
    values = _read_array(path)
    if values.dtype.kind not in "fiu":
        raise InputError(f"{path}: expected {RANGE}, found {values.dtype}")
    rows, cols = shape[:2]
    if values.shape not in ((rows, cols), (rows, cols, 3)):
        raise InputError(
            f"{path}: expected ({rows}, {cols}) or ({rows}, {cols}, 3) as the image has, "
            f"found {values.shape}"
        )
    if values.ndim == 2:
        values = _unproject(path, values, camera)
    points = np.array(values, dtype=np.float64)
    points[~np.isfinite(points).all(axis=-1)] = np.nan
    return points


def _unproject(
    path: Path, depth: NDArray[np.generic], camera: Camera | None
) -> NDArray[np.float64]:
    if camera is None:
        raise InputError(f"{path}: z-depth: expected --camera to turn it into points, found none")
    depth_m = depth.astype(np.float64)
    if path.suffix.lower() == ".png":
        if camera.depth_scale is None:
            raise InputError(f"{path}: 16-bit depth: expected depth_scale in the camera file")
        depth_m *= camera.depth_scale / 1000
    depth_m[~(depth_m > 0)] = np.nan
    return camera.unproject(depth_m)


def _read_array(path: Path) -> NDArray[np.generic]:
    suffix = path.suffix.lower()
    if suffix in (".npy", ".npz"):
        return _read_numpy(path)
    if suffix in (".tif", ".tiff", ".png"):
        return decode(path, what=RANGE)
    read_bytes(path, what=RANGE)
    raise InputError(f"{path}: expected {RANGE}, found a name ending in {suffix or 'nothing'}")


def _read_numpy(path: Path) -> NDArray[np.generic]:
    data = read_bytes(path, what=RANGE)
    try:
        loaded = np.load(io.BytesIO(data), allow_pickle=False)
        if not isinstance(loaded, np.lib.npyio.NpzFile):
            return np.asarray(loaded)
        with loaded:
            key = next((key for key in KEYS if key in loaded.files), None)
            if key is None:
                found = ", ".join(loaded.files) or "nothing"
                raise InputError(f"{path}: expected the key xyz or depth, found {found}")
            return np.asarray(loaded[key])
    except (ValueError, OSError, EOFError, KeyError, zipfile.BadZipFile) as error:
        if isinstance(error, InputError):
            raise
        found = "pickled objects, which are never loaded" if "pickle" in str(error) else str(error)
        raise InputError(f"{path}: expected {RANGE}, found {found}") from None
