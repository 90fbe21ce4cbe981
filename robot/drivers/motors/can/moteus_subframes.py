"""What stands in the frames of a moteus: registers, written, asked for and told, in subframes.

A frame is a chain of them. Each begins with what it does and the kind of its numbers,

    write 0x00, ask 0x10, tell 0x20 | kind 0 to 3, times four | how many, if 1 to 3

then, if that is more than three, how many; the first register; and the numbers of consecutive ones.
Kinds are integers of 8, 16 and 32 bits, whose steps depend on what the register measures, and
single floats. The least integer of a kind stands for "none" (NaN). 0x50 fills frames up. Other
subframes carry a stream of text, to and from the motor's console (0x40, 0x41, 0x42).

Source: mjbots, moteus "CAN protocol" and "register reference"; mjlib multiplex/format.h; compared
with the maker's client `moteus` 1.1.1 in the tests.
"""

from __future__ import annotations

import math
import struct
from enum import IntEnum
from typing import Final, NamedTuple

from robot.drivers.motors.can.frames import FD_SIZES, MAX_FD_DATA
from robot.errors import DriverError

WRITE, ASK, TELL, REFUSED_WRITE, REFUSED_ASK = 0x00, 0x10, 0x20, 0x30, 0x31
TO_CONSOLE, FROM_CONSOLE, ASK_CONSOLE = 0x40, 0x41, 0x42
FILLER: Final = 0x50
CONSOLE: Final = 1
"""The channel of a motor's console."""
MOST_TEXT: Final = MAX_FD_DATA - 3


class Kind(IntEnum):
    """Of numbers in a subframe."""

    INT8 = 0
    INT16 = 1
    INT32 = 2
    FLOAT = 3


LAYOUTS: Final = ("b", "h", "i", "f")
MOST: Final = (127, 32767, 2147483647)
"""The largest integer of a kind; one below its negative is the least, which stands for none."""


class Steps(NamedTuple):
    """What one step of an integer of 8, 16 and 32 bits stands for, in the register's unit."""

    of_8: float
    of_16: float
    of_32: float

    def of(self, kind: Kind) -> float:
        """Of a kind; a float is the value itself."""
        return (*self, 1.0)[kind]


WHOLE: Final = Steps(1.0, 1.0, 1.0)
POSITION: Final = Steps(0.01, 0.0001, 0.00001)
"""In revolutions of the output."""
VELOCITY: Final = Steps(0.1, 0.00025, 0.00001)
"""In revolutions a second."""
ACCELERATION: Final = Steps(0.05, 0.001, 0.00001)
TORQUE: Final = Steps(0.5, 0.01, 0.001)
"""In N m, at the output."""
SCALE: Final = Steps(1.0 / 127.0, 1.0 / 32767.0, 1.0 / 2147483647.0)
"""Of gains and of a modulation: shares of 1."""
VOLTAGE: Final = Steps(0.5, 0.1, 0.001)
TEMPERATURE: Final = Steps(1.0, 0.1, 0.001)
TIME: Final = Steps(0.01, 0.001, 0.000001)
CURRENT: Final = Steps(1.0, 0.1, 0.001)
POWER: Final = Steps(10.0, 0.05, 0.0001)

STEPS: dict[int, Steps] = {
    0x000: WHOLE, 0x001: POSITION, 0x002: VELOCITY, 0x003: TORQUE, 0x004: CURRENT, 0x005: CURRENT,
    0x006: POSITION, 0x007: POWER, 0x00A: TEMPERATURE, 0x00B: WHOLE, 0x00C: WHOLE, 0x00D: VOLTAGE,
    0x00E: TEMPERATURE, 0x00F: WHOLE,
    0x020: POSITION, 0x021: VELOCITY, 0x022: TORQUE, 0x023: SCALE, 0x024: SCALE, 0x025: TORQUE,
    0x026: POSITION, 0x027: TIME, 0x028: VELOCITY, 0x029: ACCELERATION, 0x02B: SCALE,
    0x101: WHOLE, 0x102: WHOLE, 0x130: POSITION, 0x131: POSITION,
}  # fmt: skip
"""Of the registers that are spoken of here."""


class Told(NamedTuple):
    """What a frame of a motor says.

    Attributes:
        registers: their values, NaN for none, in the units of `STEPS`.
        refused: registers that it did not write or does not have.
        text: of its console; None if the frame brought none, not even that there is none.
    """

    registers: dict[int, float]
    refused: tuple[int, ...]
    text: bytes | None


def raw(value: float, register: int, kind: Kind) -> float:
    """A value as the number that stands in a subframe: to the nearest step; NaN is "none".

    Raises:
        DriverError: if it is infinite or does not fit, or the register is unknown.
    """
    if register not in STEPS:
        raise DriverError(f"register {register:#05x} is not known here")
    if kind == Kind.FLOAT:
        return value
    most = MOST[kind]
    if math.isnan(value):
        return -most - 1
    steps = value / STEPS[register].of(kind)
    if not abs(steps) <= most + 0.5:
        text = f"{value:g} does not fit into register {register:#05x}"
        raise DriverError(f"{text}, up to {most * STEPS[register].of(kind):g}")
    return min(most, math.floor(steps + 0.5))


def value(number: float, register: int, kind: Kind) -> float:
    """What a number in a subframe stands for; NaN is "none"."""
    if kind == Kind.FLOAT:
        return number
    if number == -MOST[kind] - 1 and STEPS.get(register, WHOLE) != WHOLE:
        return math.nan
    return number * STEPS.get(register, WHOLE).of(kind)


def write(first: int, values: list[float], kind: Kind) -> bytes:
    """A subframe that writes consecutive registers.

    Raises:
        DriverError: as `raw`.
    """
    numbers = [raw(one, first + index, kind) for index, one in enumerate(values)]
    packed = struct.pack(f"<{len(numbers)}{LAYOUTS[kind]}", *numbers)
    return _head(WRITE, len(values), first, kind) + packed


def ask(first: int, count: int, kind: Kind) -> bytes:
    """A subframe that asks for consecutive registers."""
    return _head(ASK, count, first, kind)


def say(text: str) -> bytes:
    """A subframe with a line for the motor's console. Raises DriverError if it is too long."""
    line = text.encode("ascii") + b"\n"
    if len(line) > MOST_TEXT:
        raise DriverError(f"a line of {len(line)} bytes does not fit into a frame: {text}")
    return bytes((TO_CONSOLE, CONSOLE, len(line))) + line


def ask_console(most: int = 48) -> bytes:
    """A subframe that asks what the console says."""
    return bytes((ASK_CONSOLE, CONSOLE, most))


def filled(data: bytes) -> bytes:
    """The same as long as a frame can be."""
    return data.ljust(next(size for size in FD_SIZES if size >= len(data)), bytes((FILLER,)))


def _head(what: int, count: int, first: int, kind: Kind) -> bytes:
    begin = what | kind << 2
    head = bytes((begin | count,)) if count <= 3 else bytes((begin, count))
    return head + _varuint(first)


def _varuint(number: int) -> bytes:
    """Seven bits a byte, the lowest first; the highest bit says that more come."""
    found = bytearray()
    while number > 0x7F:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes((*found, number))


# --- what motors tell ------------------------------------------------------------------------


def told(data: bytes) -> Told | None:
    """What a frame of a motor says; None if it is cut short, or says what a motor does not."""
    reader = _Reader(data)
    registers: dict[int, float] = {}
    refused: list[int] = []
    text: bytes | None = None
    while (what := reader.byte()) is not None:
        if what == FILLER:
            continue
        if what & 0xF0 == TELL:
            count = what & 0x3 or reader.varuint()
            first, kind = reader.varuint(), Kind(what >> 2 & 0x3)
            numbers = reader.numbers(kind, count)
            if numbers is None or first is None:
                return None
            registers |= {first + k: value(one, first + k, kind) for k, one in enumerate(numbers)}
        elif what in (REFUSED_WRITE, REFUSED_ASK):
            register, error = reader.varuint(), reader.varuint()
            if register is None or error is None:
                return None
            refused.append(register)
        elif what == FROM_CONSOLE:
            _, size = reader.varuint(), reader.varuint()
            part = None if size is None else reader.bytes(size)
            if part is None:
                return None
            text = (text or b"") + part
        else:
            return None
    return Told(registers, tuple(refused), text)


class _Reader:
    """Bytes, from the first on; None where they end too early."""

    def __init__(self, data: bytes) -> None:
        self._data, self._at = data, 0

    def byte(self) -> int | None:
        found = self.bytes(1)
        return None if found is None else found[0]

    def bytes(self, count: int) -> bytes | None:
        end = self._at + count
        if end > len(self._data):
            return None
        found, self._at = self._data[self._at : end], end
        return found

    def varuint(self) -> int | None:
        number = 0
        for place in range(5):
            found = self.byte()
            if found is None:
                return None
            number |= (found & 0x7F) << 7 * place
            if found < 0x80:
                return number
        return None

    def numbers(self, kind: Kind, count: int | None) -> tuple[float, ...] | None:
        if count is None or count > MAX_FD_DATA:
            return None
        layout = f"<{count}{LAYOUTS[kind]}"
        found = self.bytes(struct.calcsize(layout))
        return None if found is None else struct.unpack(layout, found)
