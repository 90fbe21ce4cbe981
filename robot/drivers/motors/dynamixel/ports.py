"""Serial ports with servos behind them, over pyserial: nothing else in the project imports it."""
# pyright: basic

from __future__ import annotations

import termios
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Protocol, Self

import serial

from robot.closing import Closing
from robot.drivers.motors.dynamixel.joint_map import Port
from robot.errors import DriverError

SYSFS = Path("/sys/bus/usb-serial/devices")


class Ports(Closing, Protocol):
    """The ports, opened by entering and closed by leaving; nothing here ever waits."""

    @property
    def gone(self) -> Mapping[str, str]:
        """Ports that were unplugged, and why that is thought."""
        ...

    def write(self, port: str, data: bytes) -> None:
        """Hand bytes over; what is for a port that is gone is dropped.

        Raises:
            DriverError: if all ports are gone.
        """
        ...

    def read(self, port: str) -> bytes:
        """What has come in by now. Raises DriverError if all ports are gone."""
        ...


def latency_timer_s(device: str) -> float | None:
    """For how long an adapter holds back what it has; None where the system does not say."""
    with suppress(OSError, ValueError):
        name = Path(device).resolve().name
        return int((SYSFS / name / "latency_timer").read_text()) / 1000.0
    return None


class SerialPorts(Closing):
    """Ports of this machine, or pseudo terminals of emulated ones."""

    def __init__(self, ports: Mapping[str, Port]) -> None:
        """Know them; nothing is opened."""
        self._ports = dict(ports)
        self._opened: dict[str, serial.Serial] = {}
        self._gone: dict[str, str] = {}

    def __enter__(self) -> Self:
        """Open all.

        Raises:
            DriverError: naming the one that cannot be, or whose adapter holds answers back for
                longer than the map says, with the cure.
        """
        for name, port in self._ports.items():
            try:
                opened = serial.Serial(port.device, port.baud_hz, timeout=0, write_timeout=0)
            except (OSError, ValueError, termios.error) as error:
                self.close()
                cure = "is it plugged in, and may you open it (group dialout)?"
                raise DriverError(
                    f"{name}: {port.device} cannot be opened: {error} ({cure})"
                ) from None
            self._opened[name] = opened
            with suppress(Exception):  # of adapters that have such a thing; what came of it is read
                opened.set_low_latency_mode(True)
            told_s = latency_timer_s(port.device)
            if told_s is not None and told_s > port.latency_s + 1e-9:
                self.close()
                file = SYSFS / Path(port.device).resolve().name / "latency_timer"
                text = f"{name}: its adapter holds answers back for {1000 * told_s:g} ms"
                allowed_ms = 1000 * port.latency_s
                cure = f"echo {allowed_ms:.0f} | sudo tee {file}"
                raise DriverError(f"{text}, the map says {allowed_ms:g} ({cure})")
        return self

    @property
    def gone(self) -> Mapping[str, str]:
        """Ports that were unplugged, and why that is thought."""
        return self._gone

    def write(self, port: str, data: bytes) -> None:
        """Hand bytes over."""
        if (opened := self._there(port)) is None:
            return
        try:
            opened.write(data)
        except (OSError, serial.SerialException) as error:
            self._lose(port, f"it takes nothing any more: {error}")

    def read(self, port: str) -> bytes:
        """What has come in by now."""
        if (opened := self._there(port)) is None:
            return b""
        try:
            return opened.read(4096)
        except (OSError, serial.SerialException) as error:
            self._lose(port, f"it went away: {error}")
            return b""

    def _there(self, port: str) -> serial.Serial | None:
        if not self._opened:
            raise DriverError("the ports are not open")
        return None if port in self._gone else self._opened[port]

    def _lose(self, port: str, why: str) -> None:
        self._gone[port] = why
        if len(self._gone) == len(self._opened):
            raise DriverError(f"all ports of the servos are gone; {port}: {why}")

    def close(self) -> None:
        """Close all."""
        for opened in self._opened.values():
            with suppress(OSError, serial.SerialException):
                opened.close()
        self._opened.clear()
