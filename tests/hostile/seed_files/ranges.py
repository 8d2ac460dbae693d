"""Range files of the scene: depth, distance, disparity and points."""

from collections.abc import Iterator

import numpy as np
import pypcd4

from tests.hostile.scene import SHAPE, depth_m, points_m
from tests.hostile.seed_files.encoding import File, npy, npz, pds3, pds4, pillow, tiff
from tests.rockshape.io.exr_file import ZIPS, exr

BASELINE_M = 0.1
DISPARITY_STEP_PX = 1 / 256


def files() -> Iterator[File]:
    """Range of each format."""
    steps = np.rint(1000 * depth_m()).astype(np.uint16)
    for values in (points_m(), depth_m(), points_m().astype(np.float32)):
        yield "NPY", ".npy", npy(values)
    yield "NPZ", ".npz", npz(xyz=points_m())
    yield "PNG", ".png", pillow(steps, "PNG")
    yield "PGM", ".pgm", pillow(steps, "PPM")
    yield "TIFF", ".tif", tiff(depth_m().astype(np.float32))
    yield "TIFF", ".tif", tiff(points_m().astype(np.float32), photometric="rgb")
    yield "PFM", ".pfm", _pfm(depth_m())
    yield "PFM", ".pfm", _pfm(points_m())
    yield "OpenEXR", ".exr", exr({"Z": depth_m().astype(np.float32)}, compression=ZIPS)
    yield "OpenEXR", ".exr", exr({"V": depth_m().astype(np.float16)})
    yield "PLY", ".ply", _ply()
    for encoding in pypcd4.Encoding:
        yield "PCD", ".pcd", _pcd(encoding)
    xyz, distance = points_m().astype("<f4"), np.linalg.norm(points_m(), axis=-1).astype("<f4")
    yield "PDS3", ".xyz", pds3(xyz, sample_type="PC_REAL", constant="(0.0, 0.0, 0.0)")
    yield "PDS3", ".rng", pds3(distance, sample_type="PC_REAL", constant="0.0")
    yield "PDS4", ".xml", pds4(distance, data_type="IEEE754LSBSingle")
    yield "IMP table", ".tab", _imp_table()
    yield from disparities()


def disparities() -> Iterator[File]:
    """Disparity in pixels, and in steps of 1/256 px."""
    disparity = 80.0 * BASELINE_M / depth_m()
    yield "NPY", ".npy", npy(disparity)
    yield "PFM", ".pfm", _pfm(disparity)
    yield "PNG", ".png", pillow(np.rint(disparity / DISPARITY_STEP_PX).astype(np.uint16), "PNG")


def _pfm(values: np.ndarray) -> bytes:
    kind = "PF" if values.ndim == 3 else "Pf"
    header = f"{kind}\n{SHAPE[1]} {SHAPE[0]}\n-1.0\n".encode()
    return header + values[::-1].astype("<f4").tobytes()


def _ply() -> bytes:
    points = points_m().reshape(-1, 3).astype("<f4")
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n"
    )
    return head.encode() + points.tobytes()


def _pcd(encoding: pypcd4.Encoding) -> bytes:
    import tempfile
    from pathlib import Path

    cloud = pypcd4.PointCloud.from_xyz_points(points_m().reshape(-1, 3).astype(np.float32))
    cloud.metadata.width, cloud.metadata.height = SHAPE[1], SHAPE[0]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cloud.pcd"
        cloud.save(path, encoding=encoding)
        return path.read_bytes()


def _imp_table() -> bytes:
    pixels = zip(np.ndindex(SHAPE), points_m().reshape(-1, 3), strict=True)
    rows = [
        f"{row + 1:5d},{col + 1:5d},{x:10.5f},{y:10.5f},{z:10.5f},  100"
        for (row, col), (x, y, z) in pixels
    ]
    return ("\r\n".join(rows) + "\r\n").encode()
