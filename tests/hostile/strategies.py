"""Hypothesis strategies of damaged files, folders and arrays."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from rockshape.point_grid.range_kinds import KINDS
from tests.hostile.mutations import LENGTHS, MUTATIONS, retyped_json
from tests.hostile.seed_files import labels as label_files
from tests.hostile.seeds import Seed, readable_formats, seeds, seeds_of

RANGE_KINDS = st.sampled_from((None, None, *KINDS))  # None: what the file itself tells


@st.composite
def damaged_files(draw: st.DrawFn, kind: str | None = None) -> Seed:
    """Damaged file of any readable format, or of those of a kind."""
    formats = [one for one in readable_formats() if kind in (None, one.kind)]
    one = draw(st.sampled_from(formats))
    seed_file = draw(st.sampled_from(seeds_of(one)))
    suffix = draw(st.sampled_from((seed_file.suffix, *one.suffixes)))
    return seed_file._replace(suffix=suffix, data=draw(damaged(seed_file.data)))


@st.composite
def damaged_masks(draw: st.DrawFn) -> dict[str, bytes]:
    """Files of a folder of masks, one of them damaged or of another kind."""
    files = label_files.masks()
    seed_file = draw(st.sampled_from([seed for seed in seeds() if seed.kind != "camera"]))
    stem = draw(st.sampled_from(("rock_2", "rock_03", "rock", "9" * 30, "é")))
    files[f"{stem}{seed_file.suffix}"] = draw(damaged(seed_file.data))
    return files


@st.composite
def damaged(draw: st.DrawFn, data: bytes) -> bytes:
    """Content with damage."""
    if draw(st.booleans()) and data.startswith((b"{", b"[")):
        data = retyped_json(data, np.random.default_rng(draw(st.integers(0, 2**32))))
    for _ in range(draw(st.integers(0, 3))):
        way = draw(st.sampled_from(("any", "bytes", "length", "cut")))
        at = draw(st.integers(0, max(0, len(data) - 1)))
        if way == "any":
            mutation = draw(st.sampled_from(MUTATIONS))
            data = mutation(data, np.random.default_rng(draw(st.integers(0, 2**32))))
        elif way == "bytes":
            patch = draw(st.binary(min_size=1, max_size=8))
            data = data[:at] + patch + data[at + len(patch) :]
        elif way == "length":
            order = draw(st.sampled_from(("little", "big")))
            field = draw(st.sampled_from(LENGTHS)).to_bytes(4, order)
            data = data[:at] + field + data[at + 4 :]
        else:
            data = data[:at]
    return data


_ODD = st.sampled_from((0.0, -0.0, 1.0, 0.5, -1.0, np.nan, np.inf, -np.inf, 1e-38, 3e38, 1e-6))
_SIDES = st.tuples(st.integers(0, 24), st.integers(0, 24))


@st.composite
def observations(draw: st.DrawFn) -> dict[str, object]:
    """Arguments of `rockshape.measure`: pictures, labels, range and cameras of any values."""
    shape = draw(_SIDES)
    kind = draw(st.sampled_from(("u1", "u2", "f4", "f8", "i4", "?")))
    given_image = draw(
        arrays.arrays(kind, draw(st.sampled_from((shape, (*shape, 3), (*shape, 4)))))
        if kind not in ("f4", "f8")
        else arrays.arrays(kind, shape, elements=_ODD.map(np.dtype(kind).type))
    )
    found: dict[str, object] = {"image": given_image}
    if draw(st.booleans()):
        own = draw(arrays.arrays("i4", shape, elements=st.integers(-1, 3), fill=st.just(0)))
        found["labels"] = own
    if draw(st.booleans()):
        places = draw(st.sampled_from((shape, (*shape, 3))))
        base = np.full(places, draw(st.sampled_from((0.5, 2.0, 1e3))))
        spoilt = draw(arrays.arrays("f8", places, elements=_ODD, fill=st.just(0.0)))
        found["range_m"] = np.where(spoilt == 0, base, spoilt)
    if draw(st.booleans()):
        size = {"width": shape[1], "height": shape[0]}
        focal = draw(st.sampled_from((1e-9, 1.0, 80.0, 1e9)))
        found["camera"] = {"fx": focal, "fy": focal, "cx": 1.0, "cy": 1.0, **size}
    return found
