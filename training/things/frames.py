"""One picture to learn from, with what is in it, and its file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.se3 import SE3, Array

DEPTH_STEP_M = 2e-4
"""Of the depth in files: a fifth of a millimetre, up to 13 m."""


class Truth(NamedTuple):
    """What stands in a picture, one row a thing, whether it shows or not.

    Attributes:
        kinds: names; empty of what has none.
        colors: the word of its colour; empty of what has none.
        p_W: its middle [m], shape (n, 3).
        R_WO: which way it stands, shape (n, 3, 3); an upright thing's third column is up.
        size_m: of its upright cylinder or box, shape (n, 3).
        pixels: how many show it, shape (n,).
    """

    kinds: tuple[str, ...]
    colors: tuple[str, ...]
    p_W: Array
    R_WO: Array
    size_m: Array
    pixels: NDArray[np.int64]


class Frame(NamedTuple):
    """A picture to learn from.

    Attributes:
        image: the picture.
        X_WC: where it was taken from.
        who: which thing each pixel shows, -1 for none, shape (height, width).
        truth: of all things.
        target: the one that is looked at.
    """

    image: RgbdImage
    X_WC: SE3
    who: NDArray[np.int8]
    truth: Truth
    target: int


def save(frames: list[Frame], path: Path) -> None:
    """Write the pictures of one scene; the file is there whole or not at all."""
    arrays: dict[str, np.ndarray] = {}
    for number, one in enumerate(frames):
        image, depth_m = one.image, one.image.depth()
        assert depth_m is not None
        shape = image.height, image.width
        arrays |= {
            f"{number}/colours": np.frombuffer(image.colours, np.uint8).reshape(*shape, 3),
            f"{number}/depth": np.rint(depth_m / DEPTH_STEP_M).clip(0, 65535).astype(np.uint16),
            f"{number}/who": one.who,
            f"{number}/camera": np.array([*image.focal_px, *image.centre_px, image.stamp_s]),
            f"{number}/X_WC": one.X_WC.matrix(),
            f"{number}/kinds": np.array(one.truth.kinds),
            f"{number}/colors": np.array(one.truth.colors),
            f"{number}/p_W": one.truth.p_W,
            f"{number}/R_WO": one.truth.R_WO,
            f"{number}/size_m": one.truth.size_m,
            f"{number}/target": np.array(one.target),
        }
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(".part.npz")
    np.savez(part, **arrays)  # pyright: ignore[reportArgumentType]
    part.rename(path)


def load(path: Path) -> Iterator[Frame]:
    """The pictures of one scene."""
    with np.load(path) as file:
        for number in range(sum(name.endswith("/who") for name in file.files)):
            item = {name: file[f"{number}/{name}"] for name in
                    ("colours", "depth", "who", "camera", "X_WC", "kinds", "colors", "p_W", "R_WO",
                     "size_m", "target")}  # fmt: skip
            fx, fy, cx, cy, stamp_s = item["camera"].tolist()
            who, X_WC = item["who"], item["X_WC"]
            image = RgbdImage(
                stamp_s=stamp_s, width=who.shape[1], height=who.shape[0], focal_px=(fx, fy),
                centre_px=(cx, cy), frame="head_camera", colours=item["colours"].tobytes(),
                depth_m=(item["depth"] * np.float32(DEPTH_STEP_M)).tobytes(), exposure_s=0.0,
            )  # fmt: skip
            kinds, colors = tuple(item["kinds"].tolist()), tuple(item["colors"].tolist())
            counts = np.bincount(who[who >= 0].ravel(), minlength=len(kinds))
            truth = Truth(kinds, colors, item["p_W"], item["R_WO"], item["size_m"], counts)
            yield Frame(
                image, SE3.from_rotation(X_WC[:3, :3], X_WC[:3, 3]), who, truth, int(item["target"])
            )
