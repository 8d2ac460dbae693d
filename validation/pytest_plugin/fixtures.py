"""Fixtures: factories of scenes and of rendered views."""

from typing import TYPE_CHECKING, Protocol

import pytest

if TYPE_CHECKING:
    from typing import Unpack

    import synth
    from synth.handle.options import SceneOptions, SpecSource


class SceneFactory(Protocol):
    """Maker of scenes, with the arguments of `synth.make_scene`."""

    def __call__(
        self,
        spec: "SpecSource | None" = None,
        *,
        index: int = 0,
        **options: "Unpack[SceneOptions]",
    ) -> "synth.Scene":
        """Scene of a path, a table or keywords."""


class ViewFactory(Protocol):
    """Maker of rendered views, of a scene or with the arguments of `synth.make_scene`."""

    def __call__(
        self,
        spec: "synth.Scene | SpecSource | None" = None,
        view: int = 0,
        *,
        index: int = 0,
        **options: "Unpack[SceneOptions]",
    ) -> "synth.View":
        """View number `view`, through the sensor that `noise` names."""


@pytest.fixture(scope="session")
def rockshape_scene(pytestconfig: pytest.Config) -> SceneFactory:
    """Factory of scenes of known rocks, as `synth.make_scene`; each is built once a session.

    `rockshape_scene("scene.toml")`, `rockshape_scene({"rocks": {"count": 5}})` and
    `rockshape_scene(rocks=5, seed=1)` are the forms of a specification.
    """
    from validation.pytest_plugin.scenes import scene_of  # noqa: PLC0415 (heavy)

    def make(
        spec: "SpecSource | None" = None, *, index: int = 0, **options: "Unpack[SceneOptions]"
    ) -> "synth.Scene":
        return scene_of(pytestconfig, spec, index, options)

    return make


@pytest.fixture(scope="session")
def rockshape_view(pytestconfig: pytest.Config) -> ViewFactory:
    """Factory of rendered views, kept between sessions in pytest's cache.

    `rockshape_view(scene, 2, noise="stereo")` is view 2 of a scene; in place of the scene a
    specification may stand, or keywords: `rockshape_view(rocks=5, seed=1, view=2)`. A view has
    `image`, `depth_m`, `labels`, `camera` and `truth`, a pandas DataFrame of a row a rock.
    """
    from validation.pytest_plugin.scenes import view_of  # noqa: PLC0415 (heavy)

    def render(
        spec: "synth.Scene | SpecSource | None" = None,
        view: int = 0,
        *,
        index: int = 0,
        **options: "Unpack[SceneOptions]",
    ) -> "synth.View":
        return view_of(pytestconfig, spec, view, index, options)

    return render
