"""What a real camera makes of a view: holes and noise in its depth, bad light, grain, blur.

What a camera is like is drawn once, by the run's seed; what a picture is like, by that seed and the
time it was taken at. So a picture is the same whichever others were taken before it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array
from sim.camera.filters import moved, patches, steps
from sim.camera.scene_view import Floats, Pinhole, SceneView
from sim.realities import Camera

GREY = 0.5
"""Exposure brings the mean of a picture to this."""
LEAST_GAIN, MOST_GAIN = 0.4, 4.0
"""What a sensor's amplifier can do when exposure cannot any more; grain grows with it."""
BLACK, LIT = 0.03, 0.2
"""Light that comes back: none of it counts up to the first, all is well from the second on."""
FLAT, STEEP = 0.05, 0.3
"""Cosines of 87 and 73 degrees: a surface seen along itself, and one seen well."""
MATT = 0.3
"""Up to this gloss enough light is scattered: paint, wood, skin."""
EDGE_SHARE = 0.06
"""A step of so much of the depth is an edge."""
PATCH_PX = 3
"""Holes come in patches of about that size."""
BLUR_STEPS = 7
CAMERA_STREAM = 7
"""Of the run's seed; the first six are the plant's (`sim.plant`)."""


class Shot(NamedTuple):
    """What the camera gives: colours of 0 to 255, depth [m] with 0 for none, and its exposure."""

    colours: NDArray[np.uint8]
    depth_m: Floats
    exposure_s: float


class CameraFlaws:
    """One camera of a reality.

    Attributes:
        brightness: of the light around it.
        gain: of red, green and blue, shape (3,).
    """

    def __init__(self, reality: Camera, pinhole: Pinhole, *, seed: int) -> None:
        """Draw what this camera is like."""
        rng = np.random.default_rng((seed, CAMERA_STREAM))
        low, high = reality.brightness
        self.brightness = math.exp(rng.uniform(math.log(low), math.log(high)))
        red, blue = np.exp(reality.colour_cast * rng.standard_normal(2)).tolist()
        self.gain: Floats = np.array([red, 1.0, blue], dtype=np.float32)
        self._reality, self._pinhole, self._seed = reality, pinhole, seed

    def shoot(self, view: SceneView, *, stamp_s: float, turning_C: Array) -> Shot:
        """A picture of a view.

        Args:
            view: what is there.
            stamp_s: when it is taken.
            turning_C: how fast the camera turns, in its own frame [rad/s], shape (3,).
        """
        rng = np.random.default_rng((self._seed, CAMERA_STREAM, round(1e6 * stamp_s)))
        depth_m = self._depth(view, rng)
        colours, exposure_s = self._colours(view.light, turning_C, rng)
        return Shot(colours, depth_m, exposure_s)

    def late_s(self, stamp_s: float) -> float | None:
        """How long a picture of that time takes to come; None: it never does."""
        rng = np.random.default_rng((self._seed, CAMERA_STREAM, round(1e6 * stamp_s), 1))
        if rng.random() < self._reality.drops:
            return None
        return 1e-3 * rng.uniform(*self._reality.late_ms)

    def _colours(
        self, light: Floats, turning_C: Array, rng: np.random.Generator
    ) -> tuple[NDArray[np.uint8], float]:
        """Expose for the light there is, by time and then by gain; what is too much is white."""
        reality = self._reality
        wanted = GREY / max(self.brightness * float(light.mean()), 1e-6)
        exposure_s = 1e-3 * reality.exposure_ms
        longest = max(reality.longest_exposure_ms / reality.exposure_ms, 1.0) if exposure_s else 1.0
        stretch = float(np.clip(wanted, LEAST_GAIN, longest))
        amplified = float(np.clip(wanted / stretch, LEAST_GAIN, MOST_GAIN))
        exposure_s *= stretch
        gain = self.gain * np.float32(self.brightness * stretch * amplified)
        seen: Floats = (light * gain).astype(np.float32, copy=False)
        seen = blurred(seen, turning_C, focal_px=self._pinhole.focal_px, exposure_s=exposure_s)
        grain = np.float32(reality.grain * math.sqrt(max(1.0, amplified)))
        seen += grain * rng.standard_normal(seen.shape, dtype=np.float32)
        return to_bytes(seen), exposure_s

    def _depth(self, view: SceneView, rng: np.random.Generator) -> Floats:
        """Depth with noise and holes."""
        reality, depth_m = self._reality, view.depth_m
        is_there = np.isfinite(depth_m) & (depth_m >= reality.least_m)
        depth_m = np.where(is_there, depth_m, np.float32(1e3))
        noise = rng.standard_normal(depth_m.shape, dtype=np.float32)
        luma = view.light.mean(axis=-1)  # it brings a light of its own
        lost = np.maximum.reduce([
            reality.dark * np.clip((LIT - luma) / (LIT - BLACK), 0.0, 1.0),
            reality.shiny * np.clip((view.gloss - MATT) / (1.0 - MATT), 0.0, 1.0),
            reality.grazing * np.clip((STEEP - view.facing) / (STEEP - FLAT), 0.0, 1.0),
            reality.ragged * beside_edges(depth_m),
        ])  # fmt: skip
        is_there &= patches(depth_m.shape, size_px=PATCH_PX, rng=rng) >= lost
        if reality.baseline_m > 0.0:
            shift_px = self._pinhole.focal_px * reality.baseline_m / depth_m
            is_there &= ~half_occluded(shift_px.astype(np.float32, copy=False))
        measured = depth_m + reality.noise_per_m * depth_m * depth_m * noise
        return np.where(is_there, measured, 0.0).astype(np.float32)


def to_bytes(light: Floats) -> NDArray[np.uint8]:
    """Colours of 0 to 255."""
    return (np.clip(light, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)


def beside_edges(depth_m: Floats) -> NDArray[np.bool_]:
    """Where the depth within 3 x 3 pixels steps by more than a slope would, shape (h, w)."""
    least, most = steps(depth_m)
    return most - least > EDGE_SHARE * least


def half_occluded(shift_px: Floats) -> NDArray[np.bool_]:
    """What the right eye of a stereo camera does not see of the left one's picture, shape (h, w).

    What the left eye has at u the right one has at u - shift. Whatever is further right in the
    left picture, and not in the right one, is nearer and stands before it: so the shadow of what is
    near lies to the left of it.

    Args:
        shift_px: focal length times baseline over depth, shape (h, w).
    """
    there = np.arange(shift_px.shape[1], dtype=np.float32) - shift_px
    nearest = np.minimum.accumulate(there[:, ::-1], axis=1)[:, ::-1]
    hidden = np.zeros(shift_px.shape, dtype=np.bool_)
    hidden[:, :-1] = nearest[:, 1:] < there[:, :-1] - 0.5
    return hidden


def blurred(light: Floats, turning_C: Array, *, focal_px: float, exposure_s: float) -> Floats:
    """What a camera sees that turns while it gathers light: the mean along the way of its pixels.

    The middle of the picture moves by (-wy, wx) f pixels a second; that is taken for all of it.
    """
    way = focal_px * exposure_s * np.array([-turning_C[1], turning_C[0]])
    if float(np.hypot(*way)) < 0.5:
        return light
    total: Floats = np.zeros_like(light)
    for share in np.linspace(-0.5, 0.5, BLUR_STEPS).tolist():
        total += moved(light, share * float(way[1]), share * float(way[0]))
    total /= BLUR_STEPS
    return total
