"""An off-screen GL context, where EGL is installed."""

from __future__ import annotations

from typing import Any

from robot.errors import ConfigError, Problem

PACKAGES = "libegl1 libgl1-mesa-dri libopengl0"


def gl_context(width: int, height: int) -> Any:
    """An EGL context of MuJoCo's own wrapper, or an error that says what to install.

    Raises:
        ConfigError: there can be none here.
    """
    try:
        from mujoco.egl import GLContext  # pyright: ignore[reportMissingTypeStubs]

        return GLContext(width, height)
    except Exception as error:  # PyOpenGL fails in many ways where EGL is missing
        cure = f"apt install {PACKAGES}"
        problem = Problem(f"rendering needs EGL, which is not here: {error}", suggestion=cure)
        raise ConfigError([problem]) from error
