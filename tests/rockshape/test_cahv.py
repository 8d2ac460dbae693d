"""CAHV, CAHVOR and CAHVORE cameras against their published projections, written here from vectors.

Yakimovsky and Cunningham (1978) for CAHV, Di and Li (2004) for CAHVOR, Gennery (2006) for CAHVORE.
"""

from pathlib import Path

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.io import read_lens
from tests.rockshape.io.test_pds_images import PDS4

DATA = Path(__file__).parent.parent / "data"
SIZE = 1024
RNG = np.random.default_rng(4)
# the Spirit Navcam of tests/data/spirit_navcam.lbl
SPIRIT = {
    "C": (0.454993, 0.141198, -1.23312),
    "A": (-0.69585, 0.571462, 0.435),
    "H": (-1075.03, -654.572, 220.543),
    "V": (50.6594, -19.3653, 1294.76),
    "O": (-0.61985, 0.672629, 0.404174),
    "R": (0.019876, -0.014281, 0.020876),
}
PUPIL = {"E": (1e-5, 2e-5, -1e-5)}


def cahv(model: dict[str, tuple[float, ...]], points: np.ndarray) -> np.ndarray:
    """Pixels (n, 2) of points (n, 3): the ratios of projections on H, V and A."""
    beside = points - np.array(model["C"])
    depth = beside @ model["A"]
    return np.column_stack([beside @ model["H"] / depth, beside @ model["V"] / depth])


def cahvor(model: dict[str, tuple[float, ...]], points: np.ndarray) -> np.ndarray:
    """Each point is moved away from the axis O by r0 + r1 τ + r2 τ² of its distance from it."""
    center, axis = np.array(model["C"]), np.array(model["O"])
    zeta = (points - center) @ axis
    off = points - center - zeta[:, None] * axis
    tau = (off**2).sum(axis=1) / zeta**2
    r0, r1, r2 = model["R"]
    return cahv(model, points + (r0 + r1 * tau + r2 * tau**2)[:, None] * off)


def cahvore(
    model: dict[str, tuple[float, ...]], points: np.ndarray, linearity: float
) -> np.ndarray:
    """The angle θ at the entrance pupil by Newton's method, then the radius by the linearity."""
    projected = []
    axis, (e0, e1, e2), (r0, r1, r2) = np.array(model["O"]), model["E"], model["R"]
    for point in points - np.array(model["C"]):
        zeta = point @ axis
        off = point - zeta * axis
        length = np.linalg.norm(off)
        theta = np.arctan2(length, zeta)
        for _ in range(30):
            e = e0 + e1 * theta**2 + e2 * theta**4
            slope = (
                zeta * np.cos(theta)
                + length * np.sin(theta)
                - (1 - np.cos(theta)) * e
                - (theta - np.sin(theta)) * (2 * e1 * theta + 4 * e2 * theta**3)
            )
            theta -= (
                zeta * np.sin(theta) - length * np.cos(theta) - (theta - np.sin(theta)) * e
            ) / slope
        if linearity > 0:
            chi = np.tan(linearity * theta) / linearity
        elif linearity < 0:
            chi = np.sin(linearity * theta) / linearity
        else:
            chi = theta
        gain = 1 + r0 + r1 * chi**2 + r2 * chi**4
        moved = length / chi * axis + gain * off
        projected.append([moved @ model["H"], moved @ model["V"]] / (moved @ model["A"]))
    return np.array(projected)


def label(folder: Path, kind: str, **model: tuple[float, ...] | float) -> Path:
    """Label of PDS3 after the MER camera SIS: a component for each letter."""
    lines = [
        f"  MODEL_COMPONENT_{place} = {value}" for place, value in enumerate(model.values(), 1)
    ]
    text = "\r\n".join(
        [
            "PDS_VERSION_ID = PDS3",
            "RECORD_TYPE = UNDEFINED",
            '^IMAGE = ("frame.img", 1 <BYTES>)',
            "GROUP = GEOMETRIC_CAMERA_MODEL_PARMS",
            f"  MODEL_TYPE = {kind}",
            *lines,
            "END_GROUP = GEOMETRIC_CAMERA_MODEL_PARMS",
            "OBJECT = IMAGE",
            f"  LINES = {SIZE}",
            f"  LINE_SAMPLES = {SIZE}",
            "  SAMPLE_TYPE = MSB_INTEGER",
            "  SAMPLE_BITS = 16",
            "END_OBJECT = IMAGE",
            "END",
            "",
        ]
    )
    path = folder / "frame.lbl"
    path.write_text(text)
    return path


def points_of(lens: Lens) -> np.ndarray:
    """Points (n, 3) of the label's frame, 1.5 to 10 m away, all over the picture."""
    places = np.stack(np.meshgrid(np.arange(0, SIZE, 61), np.arange(0, SIZE, 61)), axis=-1)
    rays = lens.rays_at(places.reshape(-1, 2).astype(np.float64))
    rays = rays[np.isfinite(rays).all(axis=1)]
    assert len(rays) > 200
    distance = RNG.uniform(1.5, 10, len(rays))
    seen = rays / np.linalg.norm(rays, axis=1)[:, None] * distance[:, None]
    return (seen - lens.pose.translation_m) @ lens.pose.rotation


def agreement_px(lens: Lens, expected: np.ndarray, points: np.ndarray) -> float:
    """Greatest distance between where the lens shows points and where they should be, px."""
    return float(np.abs(lens.project(lens.pose.to_camera(points)) - expected).max())


def test_cahv(tmp_path: Path) -> None:
    model = {letter: SPIRIT[letter] for letter in "CAHV"}
    lens = read_lens(label(tmp_path, "CAHV", **model), shape=(SIZE, SIZE))
    points = points_of(lens)
    assert lens.distortion is None
    assert agreement_px(lens, cahv(model, points), points) < 1e-6
    axis, horizontal, vertical = (np.array(model[letter]) for letter in "AHV")
    assert lens.pinhole.fy == pytest.approx(np.linalg.norm(np.cross(axis, vertical)), rel=1e-5)
    assert np.hypot(lens.pinhole.fx, lens.skew_px) == pytest.approx(
        np.linalg.norm(np.cross(axis, horizontal)), rel=1e-5
    )
    assert lens.pinhole.cx == pytest.approx(axis @ horizontal, rel=1e-5)


def test_cahvor(tmp_path: Path) -> None:
    lens = read_lens(label(tmp_path, "CAHVOR", **SPIRIT), shape=(SIZE, SIZE))
    points = points_of(lens)
    expected = cahvor(SPIRIT, points)
    assert expected.min() < 20
    assert expected.max() > SIZE - 60
    assert agreement_px(lens, expected, points) < 1e-4


@pytest.mark.parametrize(
    ("kind", "parameter", "linearity"),
    [(1, 0.0, 1.0), (2, 0.0, 0.0), (3, 0.6, 0.6), (3, -0.4, -0.4)],
)
def test_cahvore(tmp_path: Path, kind: int, parameter: float, linearity: float) -> None:
    model = SPIRIT | PUPIL
    path = label(tmp_path, "CAHVORE", **model, T=float(kind), P=parameter)
    lens = read_lens(path, shape=(SIZE, SIZE))
    points = points_of(lens)
    expected = cahvore(model, points, linearity)
    assert agreement_px(lens, expected, points) < 0.05
    # what the entrance pupil moves is all that is left
    still = cahvore(SPIRIT | {"E": (0.0, 0.0, 0.0)}, points, linearity)
    assert agreement_px(lens, still, points) < 1e-4


def test_a_pupil_that_moves_far_is_refused(tmp_path: Path) -> None:
    path = label(tmp_path, "CAHVORE", **SPIRIT, E=(0.02, 0.3, 0.1), T=2.0, P=0.0)
    with pytest.raises(InputError, match=r"entrance pupil whose move displaces at most 0.5 px"):
        read_lens(path, shape=(SIZE, SIZE))


def test_spirits_navcam_has_its_published_focal_length() -> None:
    """14.67 mm and pixels of 12 µm (Maki et al. 2003): 1222 px, across the tilt of A from O."""
    lens = read_lens(DATA / "spirit_navcam.lbl")
    assert lens.shape == (1024, 1024)
    forward = lens.pose.rotation @ SPIRIT["O"]
    across = np.cross(forward, [0.0, 0.0, 1.0])
    across *= 1e-3 / np.linalg.norm(across)
    ends = lens.project(np.array([forward - across, forward + across]))
    assert np.linalg.norm(ends[1] - ends[0]) / 2e-3 == pytest.approx(14.67 / 0.012, rel=0.002)
    points = points_of(lens)
    assert agreement_px(lens, cahvor(SPIRIT, points), points) < 1e-4


VECTOR = (
    "<geom:{0}><geom:{1}>{4}</geom:{1}><geom:{2}>{5}</geom:{2}><geom:{3}>{6}</geom:{3}></geom:{0}>"
)
PDS4_PARTS = (
    ("Vector_Center", "x_position", "y_position", "z_position", "C"),
    ("Vector_Axis", "x_unit", "y_unit", "z_unit", "A"),
    ("Vector_Horizontal", "x_pixel", "y_pixel", "z_pixel", "H"),
    ("Vector_Vertical", "x_pixel", "y_pixel", "z_pixel", "V"),
    ("Vector_Optical", "x_unit", "y_unit", "z_unit", "O"),
    ("Radial_Terms", "c0", "c1", "c2", "R"),
    ("Entrance_Terms", "c0", "c1", "c2", "E"),
)


def pds4_label(path: Path, kind: str, model: dict[str, tuple[float, ...]], more: str = "") -> Path:
    """Label after the PDS4 geometry dictionary: a class for each vector, and more elements."""
    parts = "".join(
        VECTOR.format(*names, *model[letter]) for *names, letter in PDS4_PARTS if letter in kind
    )
    geometry = f"<geom:{kind}_Model>{parts}{more}</geom:{kind}_Model>"
    text = PDS4.replace(
        "<File_Area_Observational>",
        f"<Observation_Area>{geometry}</Observation_Area><File_Area_Observational>",
    ).replace(
        'xmlns="http://pds.nasa.gov/pds4/pds/v1"',
        'xmlns="http://pds.nasa.gov/pds4/pds/v1" xmlns:geom="http://pds.nasa.gov/pds4/geom/v1"',
    )
    path.write_text(text)
    return path


@pytest.mark.parametrize("kind", ["CAHV", "CAHVOR", "CAHVORE"])
def test_pds4_labels_give_the_same_camera(tmp_path: Path, kind: str) -> None:
    model = SPIRIT | PUPIL
    more, scalars = "", {}
    if kind == "CAHVORE":
        more += "<geom:cahvore_model_type>3</geom:cahvore_model_type>"
        more += "<geom:cahvore_model_parameter>0.6</geom:cahvore_model_parameter>"
        scalars = {"T": 3.0, "P": 0.6}
    vectors = {letter: model[letter] for letter in kind}
    other = read_lens(label(tmp_path, kind, **vectors, **scalars), shape=(SIZE, SIZE))
    path = pds4_label(tmp_path / "frame.xml", kind, model, more)
    lens = read_lens(path, shape=(SIZE, SIZE))
    assert lens.pinhole == other.pinhole
    assert lens.distortion == other.distortion
    np.testing.assert_array_equal(lens.pose.rotation, other.pose.rotation)


def test_an_image_is_resampled_and_points_of_the_rover_frame_are_used(tmp_path: Path) -> None:
    path = label(tmp_path, "CAHVOR", **SPIRIT)
    lens = read_lens(path)
    rays = lens.rays()
    points = (3 * rays - lens.pose.translation_m) @ lens.pose.rotation
    np.save(tmp_path / "xyz.npy", points.astype(np.float32))
    cv2.imwrite(str(tmp_path / "frame.png"), np.full((SIZE, SIZE), 90, np.uint8))
    found = rockshape.read(tmp_path / "frame.png", range=tmp_path / "xyz.npy", camera=path)
    assert found.camera.fx == found.camera.fy
    depth = found.points_m[..., 2]
    assert np.isfinite(depth).mean() > 0.9
    np.testing.assert_allclose(depth[np.isfinite(depth)], 3, atol=1e-4)
    assert any("image resampled" in note for note in found.notes)


C, A, H, V = (SPIRIT[letter] for letter in "CAHV")
WRONG = [
    ("CAHVOR", {"C": C, "A": A, "H": H, "V": V}, "expected the vectors CAHVOR, found no O"),
    ("NONE", {"C": C, "A": A, "H": H, "V": V}, "MODEL_TYPE: expected CAHV, CAHVOR, CAHVORE"),
    ("CAHV", {"C": C, "A": H, "H": H, "V": V}, "axis: expected a unit vector"),
    ("CAHV", {"C": C, "A": A, "H": V, "V": H}, "expected H to the right, V down"),
    ("CAHV", {"C": C, "A": A, "H": A, "V": V}, "expected"),
    ("CAHV", {"C": C, "A": A, "H": (1.0, 2.0), "V": V}, "vectors of three finite numbers"),
    ("CAHV", {"C": C, "A": '("N/A", 1, 2)', "H": H, "V": V}, "component A: expected numbers"),
    ("CAHVORE", {**SPIRIT, **PUPIL, "T": 4.0, "P": 0.0}, "expected type 1, 2, or 3"),
    ("CAHVORE", {**SPIRIT, **PUPIL}, "expected a type, component 8"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "model", "says"), WRONG, ids=[says for *_, says in WRONG])
def test_what_is_no_camera_is_one_line(
    tmp_path: Path, kind: str, model: dict[str, tuple[float, ...]], says: str
) -> None:
    path = label(tmp_path, kind, **model)
    with pytest.raises(InputError, match=says) as refused:
        read_lens(path, shape=(SIZE, SIZE))
    assert str(refused.value).startswith(str(path))
    assert "\n" not in str(refused.value)


def test_a_label_without_a_camera_is_told(tmp_path: Path) -> None:
    (tmp_path / "frame.xml").write_text(PDS4)
    with pytest.raises(InputError, match="found a PDS4 label without CAHV_Model"):
        read_lens(tmp_path / "frame.xml", shape=(12, 20))
    text = (DATA / "spirit_navcam.lbl").read_text()
    path = tmp_path / "frame.lbl"
    path.write_text(text.replace("GEOMETRIC_CAMERA_MODEL", "ANOTHER_GROUP"))
    with pytest.raises(InputError, match="found a PDS label without GEOMETRIC_CAMERA_MODEL"):
        read_lens(path, shape=(SIZE, SIZE))
