"""The light of a scene, as MuJoCo has it: ambient, and lamps that shine on what faces them.

There are no shadows.
"""

from __future__ import annotations

import mujoco
import numpy as np

from robot.se3 import Array
from sim.camera.scene_view import Floats

MOST_SHARP = 128.0
"""GL's exponent of a highlight, of a material of shininess 1."""


class Lights:
    """Every lamp of a model, and the one at the camera."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Read them."""
        head = model.vis.headlight
        self._data = data
        self._on = np.flatnonzero(model.light_active)
        lamps = model.light_diffuse[self._on].astype(np.float32)
        self._diffuse: Floats = np.vstack([lamps, head.diffuse[None]]).astype(np.float32)
        shine = model.light_specular[self._on].astype(np.float32)
        self._specular: Floats = np.vstack([shine, head.specular[None]]).astype(np.float32)
        self._ambient: Floats = model.light_ambient[self._on].sum(axis=0) + head.ambient
        self._sky = _sky(model)

    def on(self, normals_W: Array, *, axis_W: Array) -> Floats:
        """How brightly surfaces are lit: red, green, blue, shape (n, 3).

        Every lamp is far away: its rays are parallel. Lambert's law.

        Args:
            normals_W: of the surfaces, unit vectors, shape (n, 3).
            axis_W: along which the camera looks, and its lamp shines.
        """
        facing: Floats = np.maximum(-(normals_W @ self._rays(axis_W).T), 0.0).astype(np.float32)
        light: Floats = facing @ self._diffuse
        light += self._ambient
        return light

    def highlights(
        self, normals_W: Array, rays_W: Array, *, axis_W: Array, gloss: Floats, shininess: Floats
    ) -> Floats:
        """What glossy surfaces mirror of the lamps, shape (n, 3): after Blinn (1977), as GL has it.

        Args:
            normals_W: of the surfaces, unit vectors, shape (n, 3).
            rays_W: from the camera to them, unit vectors, shape (n, 3).
            axis_W: along which the camera looks, and its lamp shines.
            gloss: how much is mirrored, shape (n,).
            shininess: how sharply, from 0 to 1, shape (n,).
        """
        total: Floats = np.zeros((len(rays_W), 3), dtype=np.float32)
        for lamp_W, colour in zip(self._rays(axis_W), self._specular, strict=True):
            if not colour.any():
                continue
            halfway = lamp_W + rays_W
            length = np.sqrt(np.einsum("ij,ij->i", halfway, halfway))
            facing = -np.einsum("ij,ij->i", normals_W, halfway) / np.maximum(length, 1e-9)
            shine = np.maximum(facing, 0.0).astype(np.float32) ** (MOST_SHARP * shininess)
            total += (gloss * shine)[:, None] * colour
        return total

    def _rays(self, axis_W: Array) -> Array:
        """Along which every lamp shines, the camera's last."""
        return np.vstack([self._data.light_xdir[self._on], axis_W[None]])

    def sky(self, directions_W: Array) -> Floats:
        """What is seen where nothing is, shape (n, 3): a gradient from the horizon up."""
        top, bottom = self._sky
        share: Floats = np.clip(0.5 + 0.5 * directions_W[:, 2:], 0.0, 1.0).astype(np.float32)
        return (share * (top - bottom) + bottom).astype(np.float32, copy=False)


def _sky(model: mujoco.MjModel) -> tuple[Floats, Floats]:
    """The colours above and below of the first sky there is; black without one."""
    for index in range(model.ntex):
        if model.tex_type[index] != mujoco.mjtTexture.mjTEXTURE_SKYBOX:
            continue
        width, start = int(model.tex_width[index]), int(model.tex_adr[index])
        channels, face = int(model.tex_nchannel[index]), width * width
        texels = model.tex_data[start : start + 6 * face * channels].reshape(-1, channels)[:, :3]
        # faces in MuJoCo's order: right, left, up, down, front, back
        up, down = (texels[k * face : (k + 1) * face].mean(axis=0) / 255.0 for k in (2, 3))
        return up.astype(np.float32), down.astype(np.float32)
    return np.zeros(3, np.float32), np.zeros(3, np.float32)
