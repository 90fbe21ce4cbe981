"""What every geom of a scene looks like: its colour, gloss, and texture, as MuJoCo draws them."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array
from sim.camera.scene_view import Floats

UNPAINTED = (0.5, 0.5, 0.5, 1.0)
"""A geom of this colour has its material's (MuJoCo's default)."""
MESH = mujoco.mjtGeom.mjGEOM_MESH
RGB = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)


class Pattern:
    """A picture out of a model, and ever coarser copies of it.

    A pixel that many texels fall into has their mean: patterns that are far away do not flicker.
    """

    def __init__(self, model: mujoco.MjModel, index: int) -> None:
        """Read it."""
        width, height = int(model.tex_width[index]), int(model.tex_height[index])
        channels, start = int(model.tex_nchannel[index]), int(model.tex_adr[index])
        data = model.tex_data[start : start + width * height * channels]
        pattern: Floats = data.reshape(height, width, channels)[..., :3].astype(np.float32) / 255.0
        self.size = max(pattern.shape[:2])
        self._levels: list[Floats] = [pattern]
        while min(pattern.shape[:2]) > 1:
            pattern = _halved(pattern)
            self._levels.append(pattern)

    def colours(self, s: Array, t: Array, *, texels: Array) -> Floats:
        """What is at a place, from 0 to 1 each, where so many texels fall into a pixel: (n, 3)."""
        level = np.log2(np.maximum(texels, 1.0)).astype(np.intp)
        level = np.minimum(level, len(self._levels) - 1)
        found = np.empty((len(s), 3), dtype=np.float32)
        for number, pattern in enumerate(self._levels):
            here = np.flatnonzero(level == number)
            if not len(here):
                continue
            rows, columns = pattern.shape[:2]
            row = np.minimum((t[here] * rows).astype(np.intp), rows - 1)
            column = np.minimum((s[here] * columns).astype(np.intp), columns - 1)
            found[here] = pattern[row, column]
        return found


class FlatTexture:
    """A pattern that is laid over the x-y plane of a geom."""

    def __init__(self, model: mujoco.MjModel, index: int, geom: int) -> None:
        """Of a geom whose material has it."""
        self._pattern = Pattern(model, index)
        self._repeat = _repeat(model, geom)
        self._size = model.geom_size[geom, :2].copy()

    def colours(self, points: Array, *, footprint_m: Array) -> Floats:
        """The pattern's colours at points of the geom's frame, shape (n, 3)."""
        # MuJoCo: s = repeat / 2 * x / size - 1 / 2, t = repeat / 2 * y / size - 1 / 2
        across, repeat = points[:, :2] / self._size, self._repeat
        s = (0.5 * repeat[0] * across[:, 0] - 0.5) % 1.0
        t = (0.5 * repeat[1] * across[:, 1] - 0.5) % 1.0
        share = footprint_m / self._size.max()
        return self._pattern.colours(s, t, texels=0.5 * repeat.max() * self._pattern.size * share)


class MeshTexture:
    """A picture that is wrapped around a mesh, which says where each of its corners is on it."""

    def __init__(self, model: mujoco.MjModel, index: int, geom: int) -> None:
        """Of a mesh whose material has it."""
        self._pattern = Pattern(model, index)
        mesh = int(model.geom_dataid[geom])
        corner, corners = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        face, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
        place, places = int(model.mesh_texcoordadr[mesh]), int(model.mesh_texcoordnum[mesh])
        points = model.mesh_vert[corner : corner + corners].astype(np.float64)
        uv = model.mesh_texcoord[place : place + places].astype(np.float64)
        a, b, c = points[model.mesh_face[face : face + faces]].transpose(1, 0, 2)
        of_a, of_b, of_c = uv[model.mesh_facetexcoord[face : face + faces]].transpose(1, 0, 2)
        ab, ac = b - a, c - a
        normal = np.cross(ab, ac)
        area = np.maximum(np.einsum("ij,ij->i", normal, normal), 1e-24)[:, None]
        self._start, self._of_a = a, of_a
        self._along_b: Array = np.cross(ac, normal) / area
        self._along_c: Array = np.cross(normal, ab) / area
        self._normal: Array = normal / np.sqrt(area)
        self._to_b, self._to_c = of_b - of_a, of_c - of_a
        width_m = float(np.median(np.linalg.norm(ab, axis=1)))
        width = float(np.median(np.linalg.norm(self._to_b, axis=1)))
        self._texels_per_m = self._pattern.size * width / max(width_m, 1e-9)
        self._width_m = width_m

    def colours(self, points: Array, *, footprint_m: Array) -> Floats:
        """The picture's colours at points of the geom's frame, shape (n, 3)."""
        along_b = _from(points, self._start, self._along_b)  # shares of the way, (n, faces)
        along_c = _from(points, self._start, self._along_c)
        off_m = np.abs(_from(points, self._start, self._normal))
        beside = np.maximum(np.maximum(-along_b, -along_c), along_b + along_c - 1.0)
        face = np.argmin(off_m + self._width_m * np.maximum(beside, 0.0), axis=1)
        row = np.arange(len(points))
        uv = self._of_a[face] + along_b[row, face, None] * self._to_b[face]
        uv += along_c[row, face, None] * self._to_c[face]
        s, t = np.clip(uv, 0.0, 1.0).T
        return self._pattern.colours(s, t, texels=self._texels_per_m * footprint_m)


def _from(points: Array, starts: Array, directions: Array) -> Array:
    """How far points (n, 3) are from starts (k, 3) along their directions (k, 3): shape (n, k)."""
    return points @ directions.T - np.einsum("ij,ij->i", starts, directions)


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
        self.textures = {
            geom: (MeshTexture if model.geom_type[geom] == MESH else FlatTexture)(
                model, texture, geom
            )
            for geom in np.flatnonzero(has_one).tolist()
            if (texture := _texture(model, geom)) >= 0
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
            points = offset @ data.geom_xmat[geom].reshape(3, 3)
            colours[here] *= texture.colours(points, footprint_m=footprint_m[here])


def _halved(pattern: Floats) -> Floats:
    """A pattern of half the size, each texel the mean of four."""
    even = pattern[: pattern.shape[0] // 2 * 2, : pattern.shape[1] // 2 * 2]
    total = even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]
    return (0.25 * total).astype(np.float32, copy=False)


def _texture(model: mujoco.MjModel, geom: int) -> int:
    """The texture of a geom that is laid over a plane, or on a mesh that says how; -1: none."""
    index = int(model.mat_texid[model.geom_matid[geom], RGB])
    if index < 0 or model.tex_type[index] != mujoco.mjtTexture.mjTEXTURE_2D:
        return -1
    if model.geom_type[geom] == MESH:
        return index if model.mesh_texcoordnum[model.geom_dataid[geom]] > 0 else -1
    return index if model.geom_size[geom, :2].min() > 0.0 else -1


def _repeat(model: mujoco.MjModel, geom: int) -> Array:
    """How often a texture is repeated over a geom's x and y."""
    material = int(model.geom_matid[geom])
    repeat = model.mat_texrepeat[material].astype(np.float64)
    return repeat * model.geom_size[geom, :2] if model.mat_texuniform[material] else repeat
