"""A PCA9685 as its data sheet has it (NXP, revision 4): byte registers, and pulses out of them.

Written from the sheet, apart from the driver.
"""

from __future__ import annotations

from collections.abc import Sequence

REGISTERS_AT_POWER = {
    0x00: 0x11,
    0x01: 0x04,
    0x02: 0xE2,
    0x03: 0xE4,
    0x04: 0xE8,
    0x05: 0xE0,
    0xFE: 0x1E,
}
ALL_LEDS = range(0xFA, 0xFE)
LEDS = range(0x06, 0x46)
WAKES_S = 0.0005
LAST = 0x45
"""Auto-increment goes from 0x45 on to 0x00; 0xFA to 0xFF are reached one by one."""


class Pca9685Chip:
    """One chip.

    Attributes:
        registers: 256 bytes.
        oscillator_hz: of this one: it is off by some per cent.
        is_powered: whether it answers, and gives pulses.
    """

    def __init__(self, *, oscillator_hz: float = 25e6) -> None:
        """Power comes."""
        self.oscillator_hz = oscillator_hz
        self.is_powered = True
        self.power_up()

    def power_up(self) -> None:
        """All registers as they are after power: asleep, every output fully off."""
        self.registers = bytearray(256)
        for register, value in REGISTERS_AT_POWER.items():
            self.registers[register] = value
        for channel in range(16):
            self.registers[0x06 + 4 * channel + 3] = 0x10
        self._woken_s = float("inf")

    @property
    def sleeps(self) -> bool:
        """Bit 4 of MODE1."""
        return bool(self.registers[0x00] & 0x10)

    def write(self, register: int, data: Sequence[int], now_s: float) -> None:
        """Bytes of one transfer."""
        for value in data:
            self._put(register, value & 0xFF, now_s)
            register = self._after(register)

    def read(self, register: int, length: int) -> bytes:
        """Bytes of one transfer."""
        found = bytearray()
        for _ in range(length):
            # ALL_LED_* are written only: they read as 0.
            found.append(0 if register in ALL_LEDS else self.registers[register])
            register = self._after(register)
        return bytes(found)

    def _after(self, register: int) -> int:
        if not self.registers[0x00] & 0x20:
            return register
        if register in ALL_LEDS or register >= 0xFE:
            return min(register + 1, 0xFF)
        return 0 if register >= LAST else register + 1

    def _put(self, register: int, value: int, now_s: float) -> None:
        if register == 0x00:
            self._mode(value, now_s)
        elif register == 0xFE:
            if self.sleeps:
                self.registers[0xFE] = max(3, value)
        elif register in ALL_LEDS:
            for channel in range(16):
                self.registers[0x06 + 4 * channel + register - 0xFA] = value & _kept(
                    register - 0xFA
                )
        elif register in LEDS:
            self.registers[register] = value & _kept((register - 0x06) % 4)
        elif register <= 0x05:
            self.registers[register] = value

    def _mode(self, value: int, now_s: float) -> None:
        before = self.registers[0x00]
        restart = before & 0x80
        if not before & 0x10 and value & 0x10:  # it falls asleep while outputs pulse
            restart = 0x80 if any(self.counts(channel) for channel in range(16)) else 0
        elif value & 0x80:  # writing 1 clears it, and outputs go on
            restart = 0
        if before & 0x10 and not value & 0x10:
            self._woken_s = now_s
        self.registers[0x00] = value & 0x3F | restart

    def counts(self, channel: int) -> tuple[int, int] | None:
        """When an output goes up and down in each frame; None of one that gives no pulse."""
        place = 0x06 + 4 * channel
        on_l, on_h, off_l, off_h = self.registers[place : place + 4]
        if off_h & 0x10 or on_h & 0x10:
            return None
        return on_l | on_h << 8, off_l | off_h << 8

    def pulse_s(self, channel: int, now_s: float) -> float | None:
        """How long an output's pulses are; None: it gives none."""
        counts = self.counts(channel)
        if not self.is_powered or self.sleeps or now_s < self._woken_s + WAKES_S or counts is None:
            return None
        if self.registers[0x00] & 0x80:
            return None
        tick_s = (self.registers[0xFE] + 1) / self.oscillator_hz
        return (counts[1] - counts[0]) % 4096 * tick_s or None

    @property
    def frame_hz(self) -> float:
        """Of its frames."""
        return self.oscillator_hz / (4096 * (self.registers[0xFE] + 1))


def _kept(place: int) -> int:
    """Bits of a LED's register that there are."""
    return 0xFF if place % 2 == 0 else 0x1F
