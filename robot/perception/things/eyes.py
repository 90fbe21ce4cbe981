"""What is seen in one picture with depth: things with a name or none, place, size and colours."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.perception.things import colours
from robot.perception.things.crops import CHANNELS as PLANES
from robot.perception.things.crops import NUMBERS, SIDE_PX, Crop, crop
from robot.perception.things.inputs import Floats, Sight, sight, tensor
from robot.perception.things.instances import HALF, Instance, instances
from robot.perception.things.naming import Name, Sure, chances
from robot.perception.things.networks import Finder, Namer
from robot.se3 import SE3, Array

PLACE_M, SIZE_M = 0.05, 0.1
"""Units of places and sizes in what the namer says."""
LEAST_SIZE_M = 0.005
LIKELY_NOTHING = 0.5
NO_ODDS = -30.0


class SeenThing(NamedTuple):
    """A thing in a picture.

    Attributes:
        name: what it is taken for.
        chances: probabilities of the namer's classes by its looks alone, shape (n,).
        colours: one or two words.
        p_W: the middle of it [m], shape (3,).
        covariance_W: of that [m²], shape (3, 3).
        size_m: its longer and its shorter side, and its height, as it stands upright.
        upright: how likely its own axis is up.
        pixels: which show it, shape (height, width).
        range_m: from the camera.
        warmth: how much of the hue of cream it has, which tells cream from white (`colours`).
    """

    name: Name
    chances: Array
    colours: tuple[str, ...]
    p_W: Array
    covariance_W: Array
    size_m: tuple[float, float, float]
    upright: float
    pixels: NDArray[np.bool_]
    range_m: float
    warmth: float = 0.0

    @property
    def words(self) -> str:
        """For people: "red mug", "green thing of the bottles", "unknown white thing, 12 cm"."""
        colour = " and ".join(self.colours)
        if self.name.kind:
            return f"{colour} {self.name.kind.replace('_', ' ')}"
        if self.name.family:
            return f"{colour} thing of the {self.name.family}"
        return f"unknown {colour} thing, {100.0 * max(self.size_m):.0f} cm"

    @property
    def box(self) -> tuple[int, int, int, int]:
        """The first column and row that show it, and the first after it."""
        rows, columns = np.nonzero(self.pixels)
        left, top = int(columns.min()), int(rows.min())
        return left, top, int(columns.max()) + 1, int(rows.max()) + 1


class Eyes:
    """Both networks, and what makes things of their answers."""

    def __init__(self, finder: Finder | None = None, namer: Namer | None = None) -> None:
        """Load them. Raises ConfigError if onnxruntime is missing."""
        self.finder, self.namer = finder or Finder(), namer or Namer()

    def look(
        self,
        image: RgbdImage,
        X_WC: SE3,
        *,
        sure: Sure | None = None,
        but: NDArray[np.bool_] | None = None,
    ) -> list[SeenThing]:
        """The things of a picture, the likeliest first; none where the camera has no depth.

        Args:
            image: the picture.
            X_WC: where its camera was.
            sure: what is taken for certain; the namer's own if left out.
            but: pixels of no thing, as those that show the robot itself, shape (height, width).
        """
        seen = sight(image, X_WC)
        if seen is None:
            return []
        answers = self.finder(tensor(seen))
        if but is not None:
            _, rows, columns = answers.shape
            answers[0][but[: HALF * rows : HALF, : HALF * columns : HALF]] = NO_ODDS
        found = [
            (one, cut)
            for one in instances(answers, seen.depth_m.shape)
            if (cut := crop(seen, one.pixels, one.score)) is not None
        ]
        planes = np.zeros((len(found), SIDE_PX, SIDE_PX, PLANES), dtype=np.float32)
        numbers = np.zeros((len(found), NUMBERS), dtype=np.float32)
        for row, (_, cut) in enumerate(found):
            planes[row], numbers[row] = cut.planes, cut.numbers
        said = self.namer(planes, numbers)
        gain = colours.white_balance(seen.colours)
        told = (
            self._told(seen, (one, cut), row, gain, sure or self.namer.sure)
            for (one, cut), row in zip(found, said, strict=True)
        )
        return [one for one in told if one is not None]

    def _told(
        self, seen: Sight, found: tuple[Instance, Crop], row: Floats, gain: Floats, sure: Sure
    ) -> SeenThing | None:
        (one, cut), namer = found, self.namer
        count = len(namer.classes.names)
        likely = chances(row[:count], namer.heat)
        if namer.classes.nothing(likely) > LIKELY_NOTHING:
            return None
        place = row[count : count + 3].astype(np.float64)
        spread = np.exp(np.clip(row[count + 3 : count + 6].astype(np.float64), -6.0, 4.0))
        variance = spread * (PLACE_M * namer.spread) ** 2
        sizes = np.maximum(SIZE_M * row[count + 6 : count + 9], LEAST_SIZE_M)
        size_m = (float(sizes[0]), float(sizes[1]), float(sizes[2]))
        return SeenThing(
            name=namer.classes.name(likely, sure, size_m),
            chances=likely,
            colours=colours.words(seen.colours, one.pixels, gain),
            p_W=cut.p_W + cut.R_WS @ (PLACE_M * place),
            covariance_W=cut.R_WS @ np.diag(variance) @ cut.R_WS.T,
            size_m=size_m,
            upright=float(1.0 / (1.0 + np.exp(-float(row[count + 9])))),
            pixels=one.pixels,
            range_m=cut.range_m,
            warmth=colours.warmth(seen.colours, one.pixels, gain),
        )
