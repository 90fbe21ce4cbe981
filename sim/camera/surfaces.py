"""What every geom of a scene looks like: its colour, gloss, and texture, as MuJoCo draws them."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array
from sim.camera.scene_view import Floats

UNPAINTED = (0.5, 0.5, 0.5, 1.0)
"""A geom of this colour has its material's (MuJoCo's default)."""
RGB = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)


class Texture:
    """A flat pattern, laid over the x-y plane of a geom, and ever coarser copies of it.

    A pixel that many texels fall into has their mean: patterns that are far away do not flicker.
    """

    def __init__(self, model: mujoco.MjModel, index: int, repeat: Array) -> None:
        """Read it, of a material that repeats it so often over x and y."""
        width, height = int(model.tex_width[index]), int(model.tex_height[index])
        channels, start = int(model.tex_nchannel[index]), int(model.tex_adr[index])
        data = model.tex_data[start : start + width * height * channels]
        pattern: Floats = data.reshape(height, width, channels)[..., :3].astype(np.float32) / 255.0
        self._levels: list[Floats] = [pattern]
        while min(pattern.shape[:2]) > 1:
            pattern = _halved(pattern)
            self._levels.append(pattern)
        self._repeat = repeat

    def colours(self, across: Array, *, footprint: Array) -> Floats:
        """The pattern's colours, shape (n, 3).

        Args:
            across: where on the geom, in units of its half sizes, shape (n, 2).
            footprint: how much of a half size falls into the pixel, shape (n,).
        """
        # MuJoCo: s = repeat / 2 * x / size - 1 / 2, t = repeat / 2 * y / size - 1 / 2
        s = (0.5 * self._repeat[0] * across[:, 0] - 0.5) % 1.0
        t = (0.5 * self._repeat[1] * across[:, 1] - 0.5) % 1.0
        texels = 0.5 * self._repeat.max() * max(self._levels[0].shape[:2]) * footprint
        level = np.log2(np.maximum(texels, 1.0)).astype(np.intp)
        level = np.minimum(level, len(self._levels) - 1)
        found = np.empty((len(across), 3), dtype=np.float32)
        for number, pattern in enumerate(self._levels):
            here = np.flatnonzero(level == number)
            if not len(here):
                continue
            rows, columns = pattern.shape[:2]
            row = np.minimum((t[here] * rows).astype(np.intp), rows - 1)
            column = np.minimum((s[here] * columns).astype(np.intp), columns - 1)
            found[here] = pattern[row, column]
        return found


class Surfaces:
    """The looks of every geom of one model.

    Attributes:
        colour: shape (ngeom, 3), from 0 to 1.
        gloss: how much of a mirror it is, shape (ngeom,).
        shininess: how sharp a mirror, shape (ngeom,).
        textures: of those geoms that have one, by geom.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        """Read geoms and materials."""
        material = model.geom_matid
        has_one = material >= 0
        rgba = model.geom_rgba.astype(np.float32).copy()
        plain = np.all(rgba == np.array(UNPAINTED, np.float32), axis=1) & has_one
        if model.nmat:
            rgba[plain] = model.mat_rgba[material[plain]]
        self.colour: Floats = rgba[:, :3]
        self.gloss: Floats = np.zeros(model.ngeom, dtype=np.float32)
        self.shininess: Floats = np.full(model.ngeom, 0.5, dtype=np.float32)
        if model.nmat:
            self.gloss[has_one] = model.mat_specular[material[has_one]]
            self.shininess[has_one] = model.mat_shininess[material[has_one]]
        self._size: Array = model.geom_size
        self.textures = {
            geom: Texture(model, texture, _repeat(model, geom))
            for geom in np.flatnonzero(has_one).tolist()
            if (texture := _flat_texture(model, geom)) >= 0
        }

    def paint(
        self,
        colours: Floats,
        geoms: NDArray[np.int32],
        points_W: Array,
        *,
        footprint_m: Array,
        data: mujoco.MjData,
    ) -> None:
        """Lay textures over colours, in place.

        Args:
            colours: of the pixels, shape (n, 3).
            geoms: which each of them shows, shape (n,).
            points_W: of which place [m], shape (n, 3).
            footprint_m: how much of the surface falls into the pixel [m], shape (n,).
            data: says where the geoms are.
        """
        for geom, texture in self.textures.items():
            here = np.flatnonzero(geoms == geom)
            if not len(here):
                continue
            offset = points_W[here] - data.geom_xpos[geom]
            size = self._size[geom, :2]
            across = (offset @ data.geom_xmat[geom].reshape(3, 3))[:, :2] / size
            share = footprint_m[here] / size.max()
            colours[here] *= texture.colours(across, footprint=share)


def _halved(pattern: Floats) -> Floats:
    """A pattern of half the size, each texel the mean of four."""
    even = pattern[: pattern.shape[0] // 2 * 2, : pattern.shape[1] // 2 * 2]
    total = even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]
    return (0.25 * total).astype(np.float32, copy=False)


def _flat_texture(model: mujoco.MjModel, geom: int) -> int:
    """The texture of a geom that is laid over a plane; -1: none."""
    index = int(model.mat_texid[model.geom_matid[geom], RGB])
    flat = index >= 0 and model.tex_type[index] == mujoco.mjtTexture.mjTEXTURE_2D
    return index if flat and model.geom_size[geom, :2].min() > 0.0 else -1


def _repeat(model: mujoco.MjModel, geom: int) -> Array:
    """How often a texture is repeated over a geom's x and y."""
    material = int(model.geom_matid[geom])
    repeat = model.mat_texrepeat[material].astype(np.float64)
    return repeat * model.geom_size[geom, :2] if model.mat_texuniform[material] else repeat
