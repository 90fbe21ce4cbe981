"""All chips of a map: told by threads of their own, as I2C makes whoever writes wait.

A controller hands pulses over and goes on. Each bus has a thread that writes the newest to its
chips, once a frame at most; what was not written by then is never written.
"""
# pyright: basic
# smbus2 is optional (extra: pwm), and nothing else in the project opens it.

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from importlib import import_module
from typing import NamedTuple, Protocol, Self

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motors.pwm.joint_map import Chip
from robot.drivers.motors.pwm.pca9685 import Pca9685, SmBus
from robot.errors import DriverError

INSTALL = "pip install 'humanoid-executive[pwm]'"
LOOKS_EVERY = 10
"""Frames, between two looks at whether a chip is still awake."""
ENDS_WITHIN_S = 2.0
"""Linux gives a bus that is held up again after 1 s, for most adapters."""


class Health(NamedTuple):
    """Of one chip.

    Attributes:
        failures: writes in a row that it did not take.
        why: the last of these failed; "" if none has.
        waits_s: for so long the write has not ended that is under way; 0: none is.
        has_restarted: whether it was found asleep: it was without power.
        writes: that it took.
    """

    failures: int = 0
    why: str = ""
    waits_s: float = 0.0
    has_restarted: bool = False
    writes: int = 0


class Chips(Closing, Protocol):
    """The chips, reached by entering; they give pulses from `start` on."""

    @property
    def gone(self) -> Mapping[str, str]:
        """Nothing: a chip that is not there any more refuses what is written (`health`)."""
        return {}

    def start(self) -> Mapping[str, Sequence[int]]:
        """Start chips that do not run; ticks of each one's outputs that are ours, as they are.

        Those that another program left running go on. Raises DriverError if one does not start.
        """
        ...

    def outputs(self) -> Mapping[str, Sequence[int] | None]:
        """What each chip outputs, as `start`; None of one that sleeps. Nothing is written.

        Raises:
            DriverError: if one does not answer.
        """
        ...

    def put(self, chip: str, counts: Sequence[int]) -> None:
        """Hand over pulses of all outputs of a chip that are ours: never waits."""
        ...

    def health(self, chip: str) -> Health:
        """How a chip is."""
        ...

    def off(self) -> list[str]:
        """Take all pulses away, now; the chips that were not seen to do so."""
        ...


class Writer:
    """Tells one chip the newest, when its frame is due; for one thread alone."""

    def __init__(self, name: str, chip: Chip, channels: Sequence[int]) -> None:
        """Of a chip and the outputs of it that are ours; nothing is opened."""
        self.name, self.chip = name, chip
        self.channels = sorted(channels)
        self.health = Health()
        self._device: Pca9685 | None = None
        self._newest: tuple[int, ...] | None = None
        self._began_s: float | None = None
        self._due_s, self._frames = 0.0, 0

    @property
    def first(self) -> int:
        """The first output that is written."""
        return self.channels[0]

    def reach(self, bus: SmBus) -> None:
        """See whether the chip answers; nothing is written. Raises DriverError if not."""
        device = Pca9685(bus, self.chip.address, self.chip.scale)
        try:
            device.is_awake()
        except OSError as error:
            raise self._silent(error) from None
        self._device = device

    def start(self, sleep_s: Callable[[float], None]) -> list[int]:
        """Start the chip if it does not run; what it outputs. Raises DriverError if it does not."""
        device = self._device
        if device is None:
            raise DriverError("the chips are not open")
        try:
            if not device.is_awake() and not device.start(sleep_s):
                text = f"{self._where} does not keep what is written: is it a PCA9685?"
                raise DriverError(f"{text} (i2cdetect -y {self.chip.bus} shows who is there)")
        except OSError as error:
            raise self._silent(error) from None
        self._newest, self.health = None, Health()
        return self.outputs() or []

    def outputs(self) -> list[int] | None:
        """Ticks of its outputs; None: it sleeps. Raises DriverError if it does not answer."""
        if self._device is None:
            raise DriverError("the chips are not open")
        try:
            if not self._device.is_awake():
                return None
            return self._device.read(self.first, self.channels[-1] - self.first + 1)
        except OSError as error:
            raise self._silent(error) from None

    @property
    def _where(self) -> str:
        return f"the chip {self.name!r} ({self.chip.channel})"

    def _silent(self, error: OSError) -> DriverError:
        text = f"{self._where} does not answer: {error.strerror or error}"
        cure = f"power, wires, address: i2cdetect -y {self.chip.bus} shows who is there"
        return DriverError(f"{text} ({cure})")

    def put(self, counts: Sequence[int]) -> None:
        """What is written from the next frame on; replaces what was not written yet."""
        self._newest = tuple(counts)

    def frame(self, now_s: float) -> float:
        """Write the newest if a frame is due; when the next one is. Never raises."""
        if self._device is None or now_s < self._due_s:
            return self._due_s
        self._due_s = max(self._due_s + self.chip.frame_s, now_s)
        counts, before = self._newest, self.health
        if counts is None:
            return self._due_s
        self._began_s = now_s
        self._frames += 1
        try:
            self._device.write(self.first, counts)
            asleep = self._frames % LOOKS_EVERY == 0 and not self._device.is_awake()
        except OSError as error:
            why = error.strerror or str(error)
            self.health = before._replace(failures=before.failures + 1, why=why)
        else:
            has_restarted = before.has_restarted or asleep
            self.health = Health(0, "", 0.0, has_restarted, before.writes + 1)
        self._began_s = None
        return self._due_s

    def health_at(self, now_s: float) -> Health:
        """How the chip is."""
        began_s = self._began_s
        return self.health._replace(waits_s=0.0 if began_s is None else now_s - began_s)

    def off(self) -> bool:
        """No pulses; whether the chip was seen to do so."""
        self._newest = None
        if self._device is None:
            return True
        for _ in range(3):
            with suppress(OSError):
                self._device.all_off()
                if self._device.are_off(self.channels):
                    return True
        return False


def writers_of(
    chips: Mapping[str, Chip], channels: Mapping[str, Sequence[int]]
) -> dict[str, Writer]:
    """One for each chip of which an output is ours."""
    return {
        name: Writer(name, chip, channels[name]) for name, chip in chips.items() if channels[name]
    }


class ThreadedChips(Chips):
    """Chips of this machine, or of a simulation in another process."""

    def __init__(
        self,
        chips: Mapping[str, Chip],
        channels: Mapping[str, Sequence[int]],
        clock: Clock,
        *,
        opens: Callable[[Chip], SmBus],
    ) -> None:
        """Know them; nothing is opened.

        Args:
            chips: by name.
            channels: outputs that are ours, by chip.
            clock: of frames: the wall's, as a bus goes by it, whatever is simulated.
            opens: the bus of a chip; raises OSError.
        """
        self._writers = writers_of(chips, channels)
        self._clock, self._opens = clock, opens
        self._buses: dict[str, SmBus] = {}
        self._threads: list[threading.Thread] = []
        self._ends = threading.Event()

    def __enter__(self) -> Self:
        """Reach all. Raises DriverError if a bus or a chip is not there, with the cure."""
        try:
            for writer in self._writers.values():
                writer.reach(self._bus(writer.chip))
        except DriverError:
            self.close()
            raise
        return self

    def start(self) -> Mapping[str, Sequence[int]]:
        """Start chips that do not run, and the threads that tell them."""
        self._stop()
        found = {name: writer.start(self._sleep) for name, writer in self._writers.items()}
        self._ends.clear()
        by_bus: dict[str, list[Writer]] = {}
        for writer in self._writers.values():
            by_bus.setdefault(writer.chip.emulated or writer.chip.device, []).append(writer)
        self._threads = [
            threading.Thread(target=self._run, args=(some,), daemon=True)
            for some in by_bus.values()
        ]
        for thread in self._threads:
            thread.start()
        return found

    def _bus(self, chip: Chip) -> SmBus:
        where = chip.emulated or chip.device
        if where not in self._buses:
            try:
                self._buses[where] = self._opens(chip)
            except OSError as error:
                text = f"{where} cannot be opened: {error.strerror or error}"
                cure = "switch I2C on (raspi-config, dtparam=i2c_arm=on), be in the group i2c"
                raise DriverError(f"{text} ({cure})") from None
        return self._buses[where]

    def _sleep(self, span_s: float) -> None:
        self._clock.sleep_until(self._clock.now_s() + span_s)

    def _run(self, writers: Sequence[Writer]) -> None:
        while not self._ends.is_set():
            now_s = self._clock.now_s()
            due_s = min(writer.frame(now_s) for writer in writers)
            self._ends.wait(max(0.001, min(due_s, now_s + 0.02) - self._clock.now_s()))

    def outputs(self) -> Mapping[str, Sequence[int] | None]:
        """What each chip outputs."""
        return {name: writer.outputs() for name, writer in self._writers.items()}

    def put(self, chip: str, counts: Sequence[int]) -> None:
        """Hand over pulses."""
        self._writers[chip].put(counts)

    def health(self, chip: str) -> Health:
        """How a chip is."""
        return self._writers[chip].health_at(self._clock.now_s())

    def off(self) -> list[str]:
        """Take all pulses away; waits for a write that is under way."""
        self._stop()
        return [name for name, writer in self._writers.items() if not writer.off()]

    def _stop(self) -> None:
        self._ends.set()
        for thread in self._threads:
            thread.join(ENDS_WITHIN_S)
        self._threads = []

    def close(self) -> None:
        """Tell nothing any more, and close their buses; pulses go on unless they were taken off."""
        self._stop()
        for bus in self._buses.values():
            with suppress(OSError):
                bus.close()
        self._buses.clear()


def real_bus(chip: Chip) -> SmBus:
    """A bus of this machine. Raises OSError, and DriverError where smbus2 is not installed."""
    try:
        smbus2 = import_module("smbus2")
    except ImportError:
        raise DriverError(f"hobby servos need smbus2: {INSTALL}") from None
    return smbus2.SMBus(chip.bus)
