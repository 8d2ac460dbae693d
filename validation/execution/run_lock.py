"""Lock of a run's folder: a second run into it is refused."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from synth.dataset.folder_lock import folder_lock
from synth.errors import SpecError
from validation.errors import InputError


@contextmanager
def run_lock(out: Path) -> Iterator[None]:
    """Hold the lock of a run's folder, which is made if it is not there.

    Raises:
        InputError: another run writes there, or the folder cannot be made.
    """
    with ExitStack() as held:
        try:
            held.enter_context(folder_lock(out))
        except SpecError as error:
            raise InputError(f"--out: {error}") from error
        yield
