"""Rendering backends: those that the machine has, and opening one."""

import ctypes
import ctypes.util
import importlib
import importlib.util
import os
import subprocess
import sys
from functools import cache
from typing import cast

from synth.camera.camera import RenderCamera
from synth.errors import MissingBackendError
from synth.light import Stage
from synth.render.interface import Renderer
from synth.spec import RendererName

BACKENDS: tuple[RendererName, ...] = ("osmesa", "egl", "embree")  # in the order of `auto`

_PACKAGES = {
    "osmesa": "the system package libosmesa6",
    "egl": "the system packages libegl1 and libgl1-mesa-dri",
    "embree": "the Python package embreex",
}
_EGL_PROBE = "import pyrender; pyrender.OffscreenRenderer(1, 1).delete()"
_EGL_PROBE_SECONDS = 180


def choose_backend(name: RendererName) -> RendererName:
    """Backend to use: the one named, or for `auto` the first that the machine has.

    Raises:
        MissingBackendError: the machine lacks it; the message names the package to install.
    """
    if name == "auto":
        for backend in BACKENDS:
            if has_backend(backend):
                return backend
        raise MissingBackendError(
            f"renderer: expected one on this machine, found none: install {_PACKAGES['osmesa']}"
        )
    if not has_backend(name):
        raise MissingBackendError(
            f"renderer: {name} is missing on this machine: install {_PACKAGES[name]}"
        )
    return name


@cache
def has_backend(name: RendererName) -> bool:
    """Whether the machine has a backend; tested once in a process."""
    if name == "osmesa":
        return _has_osmesa()
    if name == "egl":
        return _has_egl()
    return importlib.util.find_spec("embreex") is not None


def open_renderer(backend: RendererName, stage: Stage, camera: RenderCamera) -> Renderer:
    """Renderer of the stage; for OpenGL, this process is bound to the backend for good.

    OpenGL draws straight lines only: a camera whose lens distorts is ray cast by Embree, which
    every installation has, whatever the backend.

    Raises:
        MissingBackendError: the process is bound to another OpenGL backend already.
    """
    if backend == "embree" or camera.distortion is not None:
        embree = importlib.import_module("synth.render.embree")
        return cast(Renderer, embree.EmbreeRenderer(stage, camera))
    bound = os.environ.get("PYOPENGL_PLATFORM")
    if "OpenGL" in sys.modules and bound != backend:
        raise MissingBackendError(
            f"renderer: expected a process without OpenGL for {backend}, found {bound} at work"
        )
    os.environ["PYOPENGL_PLATFORM"] = backend
    gl = importlib.import_module("synth.render.gl")
    return cast(Renderer, gl.GLRenderer(stage, camera))


def _has_osmesa() -> bool:
    """Load the library and look for the call that makes a core-profile context."""
    path = ctypes.util.find_library("OSMesa")
    if path is None:
        return False
    try:
        return hasattr(ctypes.CDLL(path), "OSMesaCreateContextAttribs")
    except OSError:
        return False


def _has_egl() -> bool:
    """Make a context of one pixel in a process of its own: a library alone proves nothing."""
    environment = {**os.environ, "PYOPENGL_PLATFORM": "egl"}
    try:
        probe = subprocess.run(
            [sys.executable, "-c", _EGL_PROBE],
            env=environment,
            capture_output=True,
            timeout=_EGL_PROBE_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return probe.returncode == 0
