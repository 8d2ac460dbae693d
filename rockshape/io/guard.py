"""Guard around readers: other libraries' logs kept quiet, any failure one InputError."""

import logging
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from rockshape.errors import InputError, one_line

LIBRARIES = (
    "PIL",
    "tifffile",
    "trimesh",
    "pdr",
    "roifile",
    "imagecodecs",
    "matplotlib",
)  # their loggers
SILENT = logging.CRITICAL + 1
OPENCV_SILENT = 0


@contextmanager
def guard(refusal: Callable[[str], InputError]) -> Iterator[None]:
    """Run a reader quietly; whatever it raises becomes the refusal of what was found.

    An InputError passes as it is. SystemExit and other libraries' own base exceptions are failures
    of the reader like any other; an interrupt is not.
    """
    with quiet():
        try:
            yield
        except (InputError, KeyboardInterrupt, GeneratorExit):
            raise
        except BaseException as error:
            raise refusal(reason_of(error)) from error


@contextmanager
def quiet() -> Iterator[None]:
    """Silence of warnings and of other libraries' logs, OpenCV's among them."""
    with ExitStack() as restored:
        restored.enter_context(warnings.catch_warnings())
        warnings.simplefilter("ignore")
        for logger in map(logging.getLogger, LIBRARIES):
            restored.callback(logger.setLevel, logger.level)
            logger.setLevel(SILENT)
        opencv = sys.modules.get("cv2")
        if opencv is not None:
            log = getattr(opencv.utils, "logging", opencv)  # OpenCV 5, OpenCV 4
            restored.callback(log.setLogLevel, log.getLogLevel())
            log.setLogLevel(OPENCV_SILENT)
        yield


@contextmanager
def quiet_libraries_in_c() -> Iterator[None]:
    """Silence of what C libraries write to the standard error of the process, libtiff's warnings.

    What other threads write there meanwhile is lost too, so this is for a decoder's call alone.
    """
    try:
        kept = os.dup(2)
    except OSError:  # the process has no standard error
        yield
        return
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 2)
        os.close(nowhere)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def reason_of(error: BaseException) -> str:
    """What went wrong, in one line."""
    if isinstance(error, MemoryError):
        return "more than the memory holds"
    if isinstance(error, RecursionError):
        return "nesting that is too deep"
    return one_line(str(error)) or type(error).__name__
