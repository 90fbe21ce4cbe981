"""An emulated bus of I2C, with the methods of `smbus2.SMBus`: whoever has one can have this."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Self

from sim.devices.pca9685 import Pca9685Chip

BLOCK_MAX = 32


@dataclass
class BusTrouble:
    """What goes wrong.

    Attributes:
        refuses: so many of the next transfers nobody takes (NAK).
        is_stuck: somebody holds SDA or SCL down: no transfer ends before the system gives it up.
    """

    refuses: int = 0
    is_stuck: bool = False


class I2cBus:
    """Chips by address.

    Attributes:
        chips: by address.
        trouble: what goes wrong on it.
        transfers: that were begun.
    """

    def __init__(self, now_s: Callable[[], float]) -> None:
        """Nobody is on it. `now_s`: tells the time."""
        self.chips: dict[int, Pca9685Chip] = {}
        self.trouble = BusTrouble()
        self.transfers = 0
        self._now_s = now_s

    def write(self, address: int, register: int, data: Sequence[int]) -> None:
        """One transfer. Raises OSError as Linux does."""
        self._chip(address).write(register, data, self._now_s())

    def read(self, address: int, register: int, length: int) -> bytes:
        """One transfer. Raises OSError as Linux does."""
        return self._chip(address).read(register, length)

    def _chip(self, address: int) -> Pca9685Chip:
        self.transfers += 1
        if self.trouble.is_stuck:
            raise TimeoutError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT))
        if self.trouble.refuses:
            self.trouble.refuses -= 1
            raise OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
        chip = self.chips.get(address)
        if chip is None or not chip.is_powered:
            raise OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
        return chip


class EmulatedSmbus:
    """What a program has in place of `smbus2.SMBus(1)`."""

    def __init__(self, bus: I2cBus) -> None:
        """On a bus."""
        self._bus: I2cBus | None = bus

    def __enter__(self) -> Self:
        """As smbus2's."""
        return self

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        """As smbus2's."""
        self.close()

    def close(self) -> None:
        """No transfer after it."""
        self._bus = None

    def write_byte_data(
        self,
        i2c_addr: int,
        register: int,
        value: int,
        force: bool | None = None,  # noqa: ARG002 - smbus2's
    ) -> None:
        """Write a register."""
        self._opened().write(i2c_addr, register, [value])

    def read_byte_data(self, i2c_addr: int, register: int, force: bool | None = None) -> int:  # noqa: ARG002 - smbus2's
        """Read a register."""
        return self._opened().read(i2c_addr, register, 1)[0]

    def write_i2c_block_data(
        self,
        i2c_addr: int,
        register: int,
        data: Sequence[int],
        force: bool | None = None,  # noqa: ARG002 - smbus2's
    ) -> None:
        """Write registers, one after the other."""
        if len(data) > BLOCK_MAX:
            raise ValueError(f"Data length cannot exceed {BLOCK_MAX} bytes")
        self._opened().write(i2c_addr, register, data)

    def read_i2c_block_data(
        self,
        i2c_addr: int,
        register: int,
        length: int,
        force: bool | None = None,  # noqa: ARG002 - smbus2's
    ) -> list[int]:
        """Read registers, one after the other."""
        if length > BLOCK_MAX:
            raise ValueError(f"Requested block length over {BLOCK_MAX} bytes")
        return list(self._opened().read(i2c_addr, register, length))

    def _opened(self) -> I2cBus:
        if self._bus is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        return self._bus
