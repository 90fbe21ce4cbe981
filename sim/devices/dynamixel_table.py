"""A servo's memory, from the e-manual's control table of the X series: what may be written, when.

Addresses that nobody here asks for (indirect ones, external ports) read 0 and take nothing.
"""

from __future__ import annotations

from typing import NamedTuple

SIZE = 700
EEPROM_END = 64
RESULT_FAIL, RANGE, LENGTH, LIMIT, ACCESS = 1, 4, 5, 6, 7


class Field(NamedTuple):
    """A value: bytes, whether it is two's complement, the least and the most that it takes."""

    size: int
    signed: bool = False
    least: int | None = None
    most: int | None = None


WRITABLE: dict[int, Field] = {
    7: Field(1, least=0, most=252), 8: Field(1, least=0, most=7), 9: Field(1, least=0, most=254),
    10: Field(1), 11: Field(1), 12: Field(1), 13: Field(1, least=2, most=2),
    20: Field(4, signed=True, least=-1_044_479, most=1_044_479), 24: Field(4, least=0, most=1023),
    31: Field(1, least=0, most=100), 32: Field(2, least=55, most=160),
    34: Field(2, least=35, most=160), 36: Field(2, least=0, most=885),
    38: Field(2, least=0, most=2352), 44: Field(4, least=0, most=2047),
    48: Field(4, least=0, most=4095), 52: Field(4, least=0, most=4095), 63: Field(1),
    64: Field(1, least=0, most=1), 65: Field(1, least=0, most=1), 68: Field(1, least=0, most=2),
    76: Field(2, least=0, most=16_383), 78: Field(2, least=0, most=16_383),
    80: Field(2, least=0, most=16_383), 82: Field(2, least=0, most=16_383),
    84: Field(2, least=0, most=16_383), 88: Field(2), 90: Field(2),
    98: Field(1, signed=True, least=0, most=127), 100: Field(2, signed=True),
    102: Field(2, signed=True), 104: Field(4, signed=True), 108: Field(4, least=0, most=32_767),
    112: Field(4, least=0, most=32_767), 116: Field(4, signed=True),
}  # fmt: skip
GOALS = range(100, 120)
MODES = (0, 1, 3, 4, 5, 16)


class Memory:
    """The bytes of one control table.

    Attributes:
        changes: how often anything was set that is not measured.
    """

    def __init__(self, model: int, number: int, current_limit: int) -> None:
        """As it is sold, but for its identifier and its baud rate, which is up to the line."""
        self._bytes = bytearray(SIZE)
        self.changes = 0
        sold = {
            (0, 2): model, (6, 1): 46, (7, 1): number, (8, 1): 1, (9, 1): 250, (11, 1): 3,
            (12, 1): 255, (13, 1): 2, (24, 4): 10, (31, 1): 80, (32, 2): 160, (34, 2): 95,
            (36, 2): 885, (38, 2): current_limit, (44, 4): 1023, (48, 4): 4095, (63, 1): 52,
        }  # fmt: skip
        for (address, size), value in sold.items():
            self.put(address, size, value)
        self.switch_on()

    def switch_on(self) -> None:
        """What is kept without power is kept; the rest begins anew."""
        self._bytes[EEPROM_END:] = bytes(SIZE - EEPROM_END)
        for address, size, value in (
            (68, 1, 2), (76, 2, 1920), (78, 2, 100), (84, 2, 800),
            (100, 2, self.get(36, 2)), (102, 2, self.get(38, 2)),
        ):  # fmt: skip
            self.put(address, size, value)

    def get(self, address: int, size: int, *, signed: bool = False) -> int:
        """A value."""
        return int.from_bytes(self._bytes[address : address + size], "little", signed=signed)

    def put(self, address: int, size: int, value: int) -> None:
        """Set a value, as the firmware does by itself."""
        self.changes += 1
        self.measure(address, size, value)

    def measure(self, address: int, size: int, value: int) -> None:
        """Set a value that is measured."""
        low, high = (-(1 << 8 * size - 1), (1 << 8 * size) - 1)
        value = max(low, min(high, value))
        self._bytes[address : address + size] = value.to_bytes(size, "little", signed=value < 0)

    def read(self, address: int, size: int) -> bytes | None:
        """Bytes for who asked; None if it has not got them."""
        if size <= 0 or address + size > SIZE:
            return None
        return bytes(self._bytes[address : address + size])

    def write(self, address: int, data: bytes) -> int:
        """Bytes from outside: all of them or none; returns the number of the error, or 0."""
        found: list[tuple[int, Field, int]] = []
        at = 0
        while at < len(data):
            field = WRITABLE.get(address + at)
            if field is None:
                return ACCESS
            part = data[at : at + field.size]
            if len(part) < field.size:
                return LENGTH
            value = int.from_bytes(part, "little", signed=field.signed)
            if error := self._refused(address + at, field, value):
                return error
            found.append((address + at, field, value))
            at += field.size
        for where, field, value in found:
            self.put(where, field.size, value)
        return 0

    def _refused(self, address: int, field: Field, value: int) -> int:
        if address < EEPROM_END and self.get(64, 1):
            return ACCESS
        if address in GOALS and self.get(98, 1, signed=True) == -1:
            return RANGE
        if (field.least is not None and value < field.least) or (
            field.most is not None and value > field.most
        ):
            return RANGE
        if address == 11 and value not in MODES:
            return RANGE
        limits = {100: self.get(36, 2), 102: self.get(38, 2), 104: self.get(44, 4)}
        if address in limits and abs(value) > limits[address]:
            return LIMIT
        is_position = address == 116 and self.get(11, 1) == 3
        if is_position and not self.get(52, 4) <= value <= self.get(48, 4):
            return LIMIT
        return 0
