"""Size of the page of many images: full of pictures and rows it stays under 5 MB."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.commands.measure_batch_report import MAX_PICTURES, MAX_ROWS, section_order
from rockshape.measurement import to_frame
from rockshape.report.page import PageContent, page_parts
from rockshape.report.section import section_of
from rockshape.report.verdict import joined

SIDE_PX = 600


@pytest.mark.parametrize("images", [50, MAX_PICTURES])
def test_a_page_full_of_pictures_and_rows_stays_under_5_mb(images: int) -> None:
    rocks = MAX_ROWS // images
    across = int(np.ceil(rocks**0.5))
    rng = np.random.default_rng(images)
    labels = np.zeros((SIDE_PX, SIDE_PX), np.uint8)
    for rock in range(rocks):
        centre = [int((part + 0.5) * SIDE_PX / across) for part in divmod(rock, across)]
        axes = rng.integers(SIDE_PX // across // 5, SIDE_PX // across // 2, 2).tolist()
        cv2.ellipse(labels, centre, axes, float(rng.uniform(0, 180)), 0, 360, rock + 1, -1)
    image = np.clip(0.3 + 0.4 * (labels > 0) + rng.normal(0, 0.05, labels.shape), 0, 1)
    found = rockshape.measure(image.astype(np.float32), labels=labels.astype(int), scale="1mm")
    frame = to_frame(found)
    frame.insert(0, "image", "a_photograph_of_gravel.jpg")
    sections = [section_of("p", found, section_order(each, images)) for each in range(images)]
    rows = frame.to_dict(orient="records")
    content = PageContent(
        title="full",
        method=found.method,
        measures=found.measures,
        tally=joined(section.tally for section in sections),
        values=frame.loc[frame.index.repeat(images)],
        columns=list(frame.columns),
        filled=frame.columns[frame.notna().any()].tolist(),
        sections=[replace(each, name="a_photograph_of_gravel.jpg") for each in sections],
        rows=((f"{each}-{row['rock']}", row) for each in range(images) for row in rows),
    )
    page = "".join(page_parts(content))
    assert page.count('<tr id="row-') == MAX_ROWS
    assert page.count('<g class="rock"') == MAX_ROWS
    assert page.count("data:image/jpeg") == images
    assert 1e6 < len(page.encode()) < 5e6
