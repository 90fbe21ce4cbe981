"""The way to buses of chips that a simulation emulates, which are sockets."""

from __future__ import annotations

import os
import socket
import struct
from collections.abc import Sequence
from contextlib import suppress

from robot.drivers.motors.pwm.joint_map import Chip
from robot.drivers.motors.pwm.pca9685 import SmBus

ASKED = struct.Struct("<BBB")
"""Address, register, bytes to read (0: what follows is written)."""
ANSWERED = struct.Struct("<H")
"""errno; 0, and what was read follows."""
WAITS_S = 1.0
"""As long as Linux waits for a bus that is held."""
MOST = 64


class SocketBus:
    """An emulated bus, with the methods of `smbus2.SMBus` that a driver uses."""

    def __init__(self, path: str) -> None:
        """Open it. Raises OSError if nobody listens."""
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        try:
            self._socket.settimeout(WAITS_S)
            self._socket.connect(path)
        except OSError:
            self._socket.close()
            raise

    def write_byte_data(self, i2c_addr: int, register: int, value: int) -> None:
        """Write a register."""
        self._ask(i2c_addr, register, 0, bytes((value,)))

    def read_byte_data(self, i2c_addr: int, register: int) -> int:
        """Read a register."""
        return self._ask(i2c_addr, register, 1)[0]

    def write_i2c_block_data(self, i2c_addr: int, register: int, data: Sequence[int]) -> None:
        """Write registers, one after the other."""
        self._ask(i2c_addr, register, 0, bytes(data))

    def read_i2c_block_data(self, i2c_addr: int, register: int, length: int) -> list[int]:
        """Read registers, one after the other."""
        return list(self._ask(i2c_addr, register, length))

    def _ask(self, address: int, register: int, length: int, data: bytes = b"") -> bytes:
        self._socket.send(ASKED.pack(address, register, length) + data)
        answer = self._socket.recv(MOST)
        if len(answer) < ANSWERED.size + length:
            (number,) = ANSWERED.unpack_from(answer) if len(answer) >= ANSWERED.size else (5,)
            raise OSError(number or 5, os.strerror(number or 5))
        (number,) = ANSWERED.unpack_from(answer)
        if number:
            raise OSError(number, os.strerror(number))
        return answer[ANSWERED.size :]

    def close(self) -> None:
        """Close it."""
        with suppress(OSError):
            self._socket.close()


def emulated_bus(chip: Chip) -> SmBus:
    """The bus of an emulated chip. Raises OSError if nobody listens."""
    return SocketBus(chip.emulated)
