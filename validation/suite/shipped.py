"""Suites that come with the package; this module imports nothing heavy."""

from importlib.resources import files


def suite_names() -> tuple[str, ...]:
    """Names of the suites that come with the package."""
    names = [file.name for file in (files("validation") / "suites").iterdir()]
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))
