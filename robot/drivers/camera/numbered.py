"""Numbered pictures in a camera's place: `frames/%04d.png`, from the first number to a gap."""

from __future__ import annotations

import re
from pathlib import Path

from robot.drivers.camera.capture import Pixels
from robot.errors import ConfigError, DriverError
from robot.files.ordinary_files import is_within
from robot.files.pictures import read_colour

NUMBER = re.compile(r"%0?([1-9])?d")
FIRST = (0, 1)
"""Where counting may begin."""
MOST_PIXELS = 4_000_000


class NumberedPictures:
    """One after the other."""

    def __init__(self, pattern: Path, *, folder: Path) -> None:
        """Look for the first.

        Args:
            pattern: a path whose last part has one `%d` or `%04d` (9 digits at most).
            folder: that they do not lead out of.

        Raises:
            DriverError: the first is not there.
        """
        if len(NUMBER.findall(pattern.name)) != 1 or pattern.name.count("%") != 1:
            raise DriverError(f"{pattern} does not say where the number stands: 0001 is %04d")
        self._pattern, self._folder = pattern, folder
        found = [number for number in FIRST if self._path(number).is_file()]
        if not found:
            raise DriverError(f"there is no picture {self._path(0)}, and no {self._path(1)}")
        self._number = found[0]

    def read(self) -> Pixels | None:
        """The next picture (red, green, blue); None after the last."""
        path = self._path(self._number)
        if not path.is_file():
            return None
        self._number += 1
        if not is_within(self._folder, path):
            raise DriverError(f"{path} leads out of the robot's folder")
        try:
            return read_colour(path, most_pixels=MOST_PIXELS)
        except ConfigError as error:
            raise DriverError(str(error)) from None

    def close(self) -> None:
        """Nothing is open between two pictures."""

    def _path(self, number: int) -> Path:
        def digits(found: re.Match[str]) -> str:
            return str(number).rjust(int(found[1] or 1), "0")

        return self._pattern.with_name(NUMBER.sub(digits, self._pattern.name))
