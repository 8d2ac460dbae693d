"""Sites: tables of specifications that make a scene look like a place."""

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from typing import Any, Literal, get_args

from synth.errors import SpecError
from synth.spec.wording import expected_one_of

SiteName = Literal["pathfinder", "gale", "dunes", "plain"]
SITES: tuple[SiteName, ...] = get_args(SiteName)
DEFAULT: SiteName = "pathfinder"
_FORMS = {"family", "series", "options"}  # keys of [rocks] that only go with one another


def with_site(table: Mapping[str, Any], *, where: str) -> Mapping[str, Any]:
    """Tables with those of their `site` below them, and without that key.

    `plain` has none: six rocks on a level grey plane in clear air. Tables that say a family,
    series or options of rocks have none of the site's.

    Raises:
        SpecError: no site has the name.
    """
    from synth.spec.source import merged  # noqa: PLC0415 (needs numpy, a parser does not)

    name = table.get("site", DEFAULT)
    if name not in SITES:
        raise SpecError(f"{where}: site: {expected_one_of(str(name), SITES)}")
    said = {key: value for key, value in table.items() if key != "site"}
    if name == "plain":
        return said
    below, rocks = _tables(name), said.get("rocks", {})
    if isinstance(rocks, Mapping) and _FORMS & rocks.keys():
        below["rocks"] = {key: value for key, value in below["rocks"].items() if key not in _FORMS}
    return merged(below, said)


def _tables(name: str) -> dict[str, Any]:
    text = (files("synth.spec") / "sites" / f"{name}.toml").read_text("utf-8")
    return tomllib.loads(text)
