"""Range files: z-depth or points for each pixel of the image."""

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io.files import read_bytes
from rockshape.io.images import decode

RANGE = "range (.npy, .npz with xyz or depth, float TIFF, 16-bit PNG, PLY)"
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
    values = _read_array(path, shape)
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


def _read_array(path: Path, shape: tuple[int, ...]) -> NDArray[np.generic]:
    suffix = path.suffix.lower()
    if suffix in (".npy", ".npz"):
        return _read_numpy(path)
    if suffix == ".ply":
        return _read_ply(path, shape)
    if suffix in (".tif", ".tiff", ".png"):
        values = decode(path, what=RANGE)
        if suffix == ".png" and (values.dtype != np.uint16 or values.ndim != 2):
            raise InputError(
                f"{path}: expected a grey PNG of 16 bits, found {values.dtype} {values.shape}"
            )
        return values
    read_bytes(path, what=RANGE)
    raise InputError(f"{path}: expected {RANGE}, found a name ending in {suffix or 'nothing'}")


def _read_numpy(path: Path) -> NDArray[np.generic]:
    data = read_bytes(path, what=RANGE)
    try:
        arrays = _load(data)
    except Exception as error:  # the many ways in which a spoilt file fails to load
        found = "pickled objects, which are never loaded" if "pickle" in str(error) else str(error)
        raise InputError(f"{path}: expected {RANGE}, found {found}") from None
    key = next((key for key in KEYS if key in arrays), None)
    if key is None:
        found = ", ".join(arrays) or "nothing"
        raise InputError(f"{path}: expected the key xyz or depth, found {found}")
    return arrays[key]


def _read_ply(path: Path, shape: tuple[int, ...]) -> NDArray[np.generic]:
    """Vertices of a PLY, one a pixel, in the image's reading order."""
    from trimesh.exchange.ply import load_ply  # noqa: PLC0415 - it takes 0.3 s

    data = read_bytes(path, what=RANGE)
    try:
        vertices = np.asarray(load_ply(io.BytesIO(data), fix_texture=False)["vertices"])
    except Exception as error:
        raise InputError(f"{path}: expected {RANGE}, found {error or 'no PLY'}") from None
    rows, cols = shape[:2]
    if vertices.shape != (rows * cols, 3):
        raise InputError(
            f"{path}: expected a vertex for each of {rows} x {cols} pixels, found {len(vertices)}"
        )
    return vertices.reshape(rows, cols, 3)


def _load(data: bytes) -> dict[str, NDArray[np.generic]]:
    """The arrays of an .npz, or that of an .npy under the first key; arrays of other keys are
    named but not read.
    """
    loaded = np.load(io.BytesIO(data), allow_pickle=False)
    if not isinstance(loaded, np.lib.npyio.NpzFile):
        return {KEYS[0]: np.asarray(loaded)}
    with loaded:
        nothing = np.empty(0)
        return {key: loaded[key] if key in KEYS else nothing for key in loaded.files}
