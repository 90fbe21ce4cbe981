"""The contact of an emergency stop: a line of a GPIO chip, read as Linux shows it, or emulated.

The contact is normally closed: it says 1 as long as nobody presses it and every wire is whole.
Whatever is not that 1 counts as pressed: a 0, a cable that broke, a file that went away, rubbish.
What is read is `/sys/class/gpio/gpioN/value` (Linux, Documentation/admin-guide/gpio/sysfs.rst):
text of one digit, read again from its beginning. An ordinary file that says 1 emulates it.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from robot.closing import Closing
from robot.errors import DriverError
from robot.files.users_own import check_device

RELEASED = b"1"
MOST_BYTES = 8


class StopInput(Closing):
    """One contact."""

    def __init__(self, path: Path, *, is_emulated: bool) -> None:
        """Know it; nothing is opened.

        Raises:
            DeviceNotAllowed: the user does not let robots open it; one that is emulated is no
                device.
        """
        if not is_emulated:
            check_device(str(path))
        self._path = path
        self._file: int | None = None

    def open(self) -> None:
        """Open it. Raises DriverError if it is not there: without its stop no motor is enabled."""
        try:
            self._file = os.open(self._path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        except OSError as error:
            raise DriverError(f"the stop input {self._path}: {error.strerror}") from None

    def is_pressed(self) -> bool:
        """Whether it is pressed, or not known not to be."""
        if self._file is None:
            return True
        with suppress(OSError):
            return os.pread(self._file, MOST_BYTES, 0).strip() != RELEASED
        return True

    def close(self) -> None:
        """Let go of it. Idempotent."""
        file, self._file = self._file, None
        if file is not None:
            os.close(file)
