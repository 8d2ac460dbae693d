import numpy as np
import pytest
import scipy.ndimage as ndi

from rockshape.rock.instances import Instances

SHAPE = (37, 53)


@pytest.mark.parametrize("numbers", [3, 40])
def test_boxes_and_pixels_are_those_of_the_largest_part(
    numbers: int, rng: np.random.Generator
) -> None:
    # blobs that touch each other, the borders, and fall into pieces
    field = ndi.gaussian_filter(rng.normal(size=(numbers + 1, *SHAPE)), (0, 1.5, 1.5))
    labels = 7 * field.argmax(axis=0).astype(np.int32)
    patches = Instances.from_labels(labels).largest_parts()
    assert [patch.id for patch in patches] == np.unique(labels[labels > 0]).tolist()
    for patch in patches:
        parts, count = ndi.label(labels == patch.id, structure=np.ones((3, 3)))
        sizes = np.bincount(parts.ravel())[1:]
        own = np.zeros(SHAPE, dtype=bool)
        own[patch.window] = patch.mask
        assert own.sum() == sizes.max()
        assert any(np.array_equal(own, parts == 1 + part) for part in range(count))
        assert ndi.find_objects(own.astype(int))[0] == patch.window


def test_one_pixel_the_whole_image_and_nothing() -> None:
    assert Instances.from_labels(np.zeros((4, 5), dtype=np.int32)).items == ()
    (whole,) = Instances.from_labels(np.full((4, 5), 2**31 - 1, dtype=np.int32)).largest_parts()
    assert whole.id == 2**31 - 1
    assert whole.window == (slice(0, 4), slice(0, 5))
    corner = np.zeros((4, 5), dtype=np.uint16)
    corner[3, 4] = 9
    (pixel,) = Instances.from_labels(corner).largest_parts()
    assert pixel.window == (slice(3, 4), slice(4, 5))
    assert pixel.mask.tolist() == [[True]]
