"""Deterministic files: bytes that depend on the content alone."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.errors import SpecError
from synth.geometry.mesh import Mesh
from synth.text_file import read_text

Json = Mapping[str, Any] | Sequence[Any]

# Differences to the left neighbour in run lengths: masks, labels, pictures and measured depth come
# out no larger than with the encoder's own choice, which takes three to seven times as long.
_PNG = (
    *(cv2.IMWRITE_PNG_COMPRESSION, 1),
    *(cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE),
    *(cv2.IMWRITE_PNG_FILTER, cv2.IMWRITE_PNG_FILTER_SUB),
)
_SIGNIFICANT = 12  # digits of a number in JSON: far below any error, above the last bits' noise


def write_rgb_png(path: Path, image: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write an image (rows, cols, 3) of red, green and blue."""
    blue_first: NDArray[Any] = np.ascontiguousarray(image[..., ::-1])
    write_png(path, blue_first)


def write_png(path: Path, image: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write an image of 8 or 16 bits, grey or (rows, cols, 3) blue first; no date is added."""
    _, data = cv2.imencode(".png", image, _PNG)
    path.write_bytes(data.tobytes())


def write_json(path: Path, value: Json) -> None:
    """Write JSON with sorted keys, numbers to 12 significant digits, and no NaN."""
    text = json.dumps(plain(value), sort_keys=True, indent=1, allow_nan=False)
    path.write_text(text + "\n", encoding="utf-8")


def read_json(path: Path) -> Any:
    """JSON file's content.

    Raises:
        SpecError: the file is missing or is no JSON.
    """
    try:
        return json.loads(read_text(path))
    except OSError as error:
        raise SpecError(f"{path}: expected a JSON file, found {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise SpecError(f"{path}: expected JSON, found {error}") from error


def write_ply_mm(path: Path, mesh: Mesh) -> None:
    """Write a mesh as binary PLY: positions in millimetres, normals, triangles."""
    vertices = np.hstack([1000.0 * mesh.vertices_m, mesh.normals]).astype("<f4")
    faces = np.empty(len(mesh.faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = mesh.faces
    header = _ply_header(mesh, "binary_little_endian")
    path.write_bytes(header.encode("ascii") + vertices.tobytes() + faces.tobytes())


def write_ascii_ply_mm(path: Path, mesh: Mesh) -> None:
    """Write a mesh as text PLY, in the same units and order."""
    vertices = np.hstack([1000.0 * mesh.vertices_m, mesh.normals]).tolist()
    lines = [" ".join(f"{value:.9g}" for value in vertex) for vertex in vertices]
    lines += [f"3 {one} {two} {three}" for one, two, three in mesh.faces.tolist()]
    path.write_bytes((_ply_header(mesh, "ascii") + "\n".join(lines) + "\n").encode("ascii"))


def _ply_header(mesh: Mesh, encoding: str) -> str:
    return (
        f"ply\nformat {encoding} 1.0\n"
        f"element vertex {len(mesh.vertices_m)}\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        + f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )


def plain(value: Any) -> Any:
    """Value as JSON's own types, its numbers rounded."""
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return float(f"{value:.{_SIGNIFICANT}g}") + 0.0
    return value


def sha256(path: Path) -> str:
    """File's SHA-256 in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()
