"""Pictures of whole views as the page shows them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from validation.execution.run import AnyPicture, Run
from validation.records.join import RecordKey
from validation.records.pictures import UNITS, Mark, Portrait
from validation.report.embed import centre, data_uri, mark_lines
from validation.report.rock_key import RockKey

MAX_PICTURE_BYTES = 1_200_000  # base64 makes them a third more


@dataclass(frozen=True)
class ShownMark:
    """A rock in a picture: its lines, its number and where that stands, its place in the page."""

    lines: Markup
    number: int
    x: float
    y: float
    place: str | None


@dataclass(frozen=True)
class ShownPicture:
    """A picture as the page embeds it."""

    source: str
    width: int
    height: int
    units: int
    text: str
    caption: str
    marks: tuple[ShownMark, ...]


def shown_pictures(
    run: Run,
    name: str,
    chosen: Mapping[RockKey, Sequence[Portrait]],
    *,
    words: Callable[[RecordKey], tuple[str, str]],
    share: float = 1.0,
) -> tuple[ShownPicture, ...]:
    """Pictures of an experiment, its part of what the page has room for.

    `words` says what the picture of a place shows, in full and as a caption.
    """
    spent = sum(p.size_bytes for p in run.pictures)
    part = min(1.0, share * MAX_PICTURE_BYTES / spent) if spent else 1.0
    own = [p for p in run.pictures if p.place.experiment == name]
    places = _places(chosen)
    return tuple(
        _shown(picture, places, words(picture.place))
        for picture in own[: max(1, int(part * len(own)))]
    )


def _places(
    chosen: Mapping[RockKey, Sequence[Portrait]],
) -> dict[tuple[str, str, int, int, str, int], str]:
    """Page's place of each rock by where, by whom and as what it was found."""
    return {
        (*key[:3], one.picture.place.view, mark.method, mark.rock): key.id
        for key, portraits in chosen.items()
        for one in portraits
        for mark in one.picture.marks
    }


def _shown(
    picture: AnyPicture,
    places: Mapping[tuple[str, str, int, int, str, int], str],
    words: tuple[str, str],
) -> ShownPicture:
    text, caption = words
    place = picture.place

    def shown(mark: Mark) -> ShownMark:
        x, y = centre(mark)
        key = (place.experiment, place.series, place.scene, place.view, mark.method, mark.rock)
        return ShownMark(mark_lines(mark), mark.rock, x, y, places.get(key))

    return ShownPicture(
        source=data_uri(picture.jpeg),
        width=picture.width_px,
        height=picture.height_px,
        units=UNITS,
        text=text,
        caption=caption,
        marks=tuple(shown(mark) for mark in picture.marks),
    )
