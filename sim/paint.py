"""Materials and textures of a scene, each made once."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.palette import COLORS, FLOORS, Rgb

GLOSS = {"steel": 0.8, "worktop": 0.4, "wall": 0.0, "skin": 0.1}


class Paint:
    """Makes the materials that a scene asks for."""

    def __init__(self, spec: mujoco.MjSpec) -> None:
        """Start without any."""
        self._spec = spec
        self._made: set[str] = set()

    def color(self, name: str) -> str:
        """The material of a palette colour."""
        return self.plain(name, COLORS[name], gloss=GLOSS.get(name, 0.25))

    def plain(self, name: str, rgb: Rgb, *, gloss: float = 0.0) -> str:
        """A one-colour material."""
        full = f"paint/{name}"
        if self.is_first(full):
            self._spec.add_material(
                name=full, rgba=[*rgb, 1.0], specular=gloss, shininess=0.2 + 0.5 * gloss
            )
        return full

    def is_first(self, name: str) -> bool:
        """Whether nothing was made by this name before; from now on it is."""
        fresh = name not in self._made
        self._made.add(name)
        return fresh

    def glossy(self, name: str, gloss: float) -> str:
        """The material of a palette colour with a gloss of its own."""
        full = f"paint/{name}/{gloss:g}"
        if self.is_first(full):
            self._spec.add_material(
                name=full, rgba=[*COLORS[name], 1.0], specular=gloss, shininess=0.2 + 0.5 * gloss
            )
        return full

    def picture(self, name: str, pixels: NDArray[np.uint8], *, gloss: float) -> str:
        """A picture for a mesh that says how it lies on it; shape (height, width, 3)."""
        full = f"picture/{name}"
        if self.is_first(full):
            texture = self._spec.add_texture(
                name=full, type=mujoco.mjtTexture.mjTEXTURE_2D, nchannel=3,
                height=pixels.shape[0], width=pixels.shape[1],
            )  # fmt: skip
            texture.data = pixels.tobytes()
            material = self._spec.add_material(
                name=full, specular=gloss, shininess=0.2 + 0.5 * gloss
            )
            material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = full
        return full

    def floor(self, name: str, size_m: tuple[float, float]) -> str:
        """A checker of a floor covering's two colours, at its tile size on a floor of `size_m`."""
        covering = FLOORS[name]
        full = f"floor/{name}/{size_m[0]:g}x{size_m[1]:g}"
        if full in self._made:
            return full
        self._made.add(full)
        self._spec.add_texture(
            name=full, type=mujoco.mjtTexture.mjTEXTURE_2D,
            builtin=mujoco.mjtBuiltin.mjBUILTIN_CHECKER,
            rgb1=list(covering.light), rgb2=list(covering.dark), width=256, height=256,
            mark=mujoco.mjtMark.mjMARK_EDGE, markrgb=[0.9 * value for value in covering.dark],
        )  # fmt: skip
        repeat = [size / (2 * tile) for size, tile in zip(size_m, covering.tile_m, strict=True)]
        material = self._spec.add_material(name=full, texrepeat=repeat, specular=0.1, shininess=0.2)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = full
        return full
