"""The PCA9685 (NXP, data sheet revision 4): sixteen outputs of pulses, told over I2C by registers.

A counter of 4096 ticks goes round once a frame; an output goes up at its ON count and down at its
OFF count. It has no watchdog: outputs pulse for ever as they were told last.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Protocol

MODE1, MODE2, LED0, ALL_LED_OFF_H, PRE_SCALE = 0x00, 0x01, 0x06, 0xFD, 0xFE
RESTART, AUTO_INCREMENT, SLEEP = 0x80, 0x20, 0x10
TOTEM_POLE = 0x04
"""Of MODE2: outputs drive both ways; they change together when a transfer stops (OCH = 0)."""
FULL_OFF = 0x10
"""Of a LEDn_OFF_H: no pulse at all, whatever the counts say."""
CHANNELS, BYTES, TICKS = 16, 4, 4096
MOST_BLOCK = 32
"""Bytes of one block of SMBus: eight outputs."""
WAKES_S = 0.0005
"""Of its oscillator, once SLEEP is cleared."""
OSCILLATOR_HZ = 25_000_000.0
OFF = -1
"""In place of ticks: no pulse."""


class SmBus(Protocol):
    """What is used of `smbus2.SMBus`. All raise OSError where nobody answers."""

    def write_byte_data(self, i2c_addr: int, register: int, value: int) -> None:
        """Write a register."""
        ...

    def read_byte_data(self, i2c_addr: int, register: int) -> int:
        """Read a register."""
        ...

    def write_i2c_block_data(self, i2c_addr: int, register: int, data: Sequence[int]) -> None:
        """Write registers, one after the other; 32 at most."""
        ...

    def read_i2c_block_data(self, i2c_addr: int, register: int, length: int) -> list[int]:
        """Read registers, one after the other; 32 at most."""
        ...

    def close(self) -> None:
        """Close it."""
        ...


def pre_scale(frame_hz: float, oscillator_hz: float) -> int:
    """What makes frames as fast as that, and no faster."""
    return math.ceil(oscillator_hz / (TICKS * frame_hz) - 1e-9) - 1


def frame_s(scale: int, oscillator_hz: float) -> float:
    """How long a frame is."""
    return TICKS * (scale + 1) / oscillator_hz


def ticks(pulse_s: float, frame_s: float) -> int:
    """Of a pulse, to the nearest."""
    return round(pulse_s * TICKS / frame_s)


def _registers(count: int) -> bytes:
    """The four of an output whose pulse is so many ticks long, from the beginning of a frame."""
    if count == OFF:
        return bytes((0, 0, 0, FULL_OFF))
    return bytes((0, 0, count & 0xFF, count >> 8))


class Pca9685:
    """One chip. Every method raises OSError where it does not answer."""

    def __init__(self, bus: SmBus, address: int, scale: int) -> None:
        """Know it; nothing is written."""
        self._bus, self._address, self._scale = bus, address, scale

    def start(self, sleep_s: Callable[[float], None]) -> bool:
        """Outputs off, frames as long as they are to be, and awake; whether it took all that.

        The scale can be written only while it sleeps. All-call is switched off: another chip's
        driver would reach this one by it.

        Args:
            sleep_s: waits for so long.
        """
        bus, address = self._bus, self._address
        self.all_off()
        bus.write_byte_data(address, MODE1, AUTO_INCREMENT | SLEEP)
        bus.write_byte_data(address, MODE2, TOTEM_POLE)
        bus.write_byte_data(address, PRE_SCALE, self._scale)
        bus.write_byte_data(address, MODE1, AUTO_INCREMENT)
        sleep_s(WAKES_S)
        return self.is_awake()

    def is_awake(self) -> bool:
        """Whether it still runs as it was started: one that was without power sleeps."""
        mode = self._bus.read_byte_data(self._address, MODE1)
        scale = self._bus.read_byte_data(self._address, PRE_SCALE)
        return mode & ~RESTART == AUTO_INCREMENT and scale == self._scale

    def write(self, first: int, counts: Sequence[int]) -> None:
        """Set outputs, from one on: ticks of each, or OFF."""
        for begin in range(0, len(counts), MOST_BLOCK // BYTES):
            some = counts[begin : begin + MOST_BLOCK // BYTES]
            data = b"".join(map(_registers, some))
            self._bus.write_i2c_block_data(
                self._address, LED0 + BYTES * (first + begin), list(data)
            )

    def read(self, first: int, count: int) -> list[int]:
        """Ticks of outputs, from one on; OFF of those that have no pulse."""
        counts: list[int] = []
        for begin in range(0, count, MOST_BLOCK // BYTES):
            some = min(count - begin, MOST_BLOCK // BYTES)
            data = self._bus.read_i2c_block_data(
                self._address, LED0 + BYTES * (first + begin), BYTES * some
            )
            for place in range(0, BYTES * some, BYTES):
                on, off = (data[one] | data[one + 1] << 8 for one in (place, place + 2))
                pulse = (off - on) % TICKS
                counts.append(OFF if off >> 8 & FULL_OFF or not pulse else pulse)
        return counts

    def all_off(self) -> None:
        """No pulses at all, by one byte."""
        self._bus.write_byte_data(self._address, ALL_LED_OFF_H, FULL_OFF)

    def are_off(self, channels: Sequence[int]) -> bool:
        """Whether it says of all of these that they are fully off."""
        registers = [LED0 + BYTES * channel + 3 for channel in channels]
        return all(self._bus.read_byte_data(self._address, one) & FULL_OFF for one in registers)

    def sleep(self) -> None:
        """Stop its oscillator."""
        self._bus.write_byte_data(self._address, MODE1, AUTO_INCREMENT | SLEEP)

    def close(self) -> None:
        """Close its bus."""
        with suppress(OSError):
            self._bus.close()
