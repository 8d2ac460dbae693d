"""TOML files of specifications."""

import tomllib
from pathlib import Path
from typing import Any

from synth.errors import SpecError
from synth.text_file import read_text


def read_toml(path: Path) -> dict[str, Any]:
    """Tables of a TOML file.

    Raises:
        SpecError: the file is missing or is no TOML.
    """
    try:
        return tomllib.loads(read_text(path))
    except OSError as error:
        raise SpecError(f"{path}: expected a TOML file, found {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise SpecError(f"{path}: expected a TOML file, found bytes that are no text") from error
    except (ValueError, RecursionError) as error:
        raise SpecError(f"{path}: expected TOML, found {error}") from error
