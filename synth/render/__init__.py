"""Rendering of image, depth and labels by one of several backends that agree."""

from synth.render.backends import choose_backend, open_renderer
from synth.render.view import RenderedView, render_view

__all__ = ["RenderedView", "choose_backend", "open_renderer", "render_view"]
