"""Dataset integrity check: files of the manifest that are missing."""

from collections.abc import Sequence
from pathlib import Path

from synth.dataset.files import read_json
from synth.dataset.layout import MAX_ROCKS
from synth.errors import SpecError

_DIGITS = 6  # of the numbers in file names


def lost_files(out: Path) -> list[str]:
    """Paths that the manifest names and the folder lacks, in rising order.

    Without a manifest the dataset is not finished, and nothing is lost.

    Raises:
        SpecError: the manifest lacks its table of files.
    """
    manifest = out / "manifest.json"
    if not manifest.is_file():
        return []
    files = read_json(manifest).get("files")
    if not isinstance(files, dict):
        raise SpecError(f"{manifest}: files: expected paths with their SHA-256, found {files!r}")
    return sorted(name for name in files if not (out / name).is_file())


def scenes_of(names: Sequence[str]) -> list[int]:
    """Scenes that files of a dataset belong to, in rising order.

    A path has its scene's number as a folder, or is the model obj_NNNNNN of a rock whose number is
    1000 × scene + instance + 1; the other files are the whole dataset's.
    """
    scenes = set()
    for name in names:
        *folders, file = name.split("/")
        numbers = [folder for folder in folders if folder.isdecimal()]
        if numbers:
            scenes.add(int(numbers[0]))
        elif file.startswith("obj_"):
            number = file.removeprefix("obj_")[:_DIGITS]
            scenes.add((int(number) - 1) // MAX_ROCKS)
    return sorted(scenes)
