"""A board that drives motors, behind Ethernet: states, commander, watchdog, heat, its flaws."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple, get_args

from sim.devices import ethernet_codec as codec
from sim.devices.ethernet_codec import Asked
from sim.devices.shaft import LET_GO, Order, Shaft

AMBIENT_C = 25.0
SAME_S = 1e-9
LEAST_VOLTS, MOST_VOLTS = 36.0, 60.0
DRIVER_TRIPS_C = 110.0
DISABLED, ENABLED, BRAKING, FAULT = range(4)
UNDER_VOLTAGE, OVER_VOLTAGE, OVER_CURRENT, WINDING_HOT, DRIVER_HOT, ENCODER, OVERLOAD = (
    1 << bit for bit in range(7)
)

Flaw = Literal[
    "silent", "loses_replies", "late_replies", "doubles", "swaps", "spoils", "old_version",
    "wrong_board", "not_a_number", "frozen_time", "slow_speed", "wrong_model", "weak",
    "no_watchdog", "hot", "low_volts", "over_current", "unplugged_slot",
]  # fmt: skip
"""What can be wrong from the start, by name: with a joint's drive, or with its board and cable."""
FLAWS: tuple[Flaw, ...] = get_args(Flaw)


class Kind(NamedTuple):
    """What a drive is, at its motor's output."""

    model: str
    velocity_rad_s: float
    torque_nm: float
    kp: float = 500.0
    kd: float = 5.0
    trips_c: float = 120.0


@dataclass
class Trouble:
    """What goes wrong with one drive: fault bits of its own, speeds and numbers that are wrong."""

    faults: int = 0
    speed_scale: float = 1.0
    not_a_number: bool = False
    unplugged: bool = False


class Drive:
    """One motor of a board.

    Attributes:
        kind, shaft: what it is, and what it turns.
        trouble: what is wrong with it.
        state, faults: as it tells.
        winding_c: as it measures.
        damping_nm_s: with so much it brakes when its board had no command.
        zero_rad: its shaft's angle where it says 0.
    """

    def __init__(self, kind: Kind, shaft: Shaft, *, heat_k_s: float = 4.0) -> None:
        """Switch on: disabled."""
        self.kind, self.shaft, self.heat_k_s = kind, shaft, heat_k_s
        self.trouble = Trouble()
        self.state, self.faults = DISABLED, 0
        self.winding_c = AMBIENT_C
        self.damping_nm_s = 1.0
        self.zero_rad = self.tau_nm = 0.0
        self.order: Order = LET_GO

    @property
    def is_on(self) -> bool:
        """Whether it gives torque by commands."""
        return self.state == ENABLED

    def obey(self, q: float, qd: float, kp: float, kd: float, tau: float) -> None:
        """An order; gains are no larger than it takes."""
        kp, kd = min(max(kp, 0.0), self.kind.kp), min(max(kd, 0.0), self.kind.kd)
        order = Order(q + self.zero_rad, qd, kp, kd, tau)
        self.order = self.order if self.order == order else order

    def watch(self, volts: float, driver_c: float) -> None:
        """Fall into a fault, which stays until it is cleared."""
        found = self.trouble.faults
        found |= UNDER_VOLTAGE if volts < LEAST_VOLTS else 0
        found |= OVER_VOLTAGE if volts > MOST_VOLTS else 0
        found |= WINDING_HOT if self.winding_c > self.kind.trips_c else 0
        found |= DRIVER_HOT if driver_c > DRIVER_TRIPS_C else 0
        if found:
            self.faults |= found
            self.state = FAULT

    def turn(self, span_s: float) -> None:
        """A step of its loop."""
        if self.state == ENABLED:
            order = self.order
        elif self.state == BRAKING:
            order = Order(kd=self.damping_nm_s)
        else:
            order = LET_GO
        most_nm = self.kind.torque_nm
        self.tau_nm = self.shaft.turn(order, most_nm, span_s)
        load = abs(self.tau_nm) / most_nm
        cooling = 0.02 * (self.winding_c - AMBIENT_C)
        self.winding_c += span_s * (self.heat_k_s * load * load - cooling)

    def says(self) -> bytes:
        """What it measures."""
        q_rad = math.nan if self.trouble.not_a_number else self.shaft.q_rad - self.zero_rad
        return codec.joint(
            q_rad,
            self.shaft.qd_rad_s * self.trouble.speed_scale,
            self.tau_nm,
            celsius=self.winding_c,
            faults=self.faults,
            state=self.state,
        )


@dataclass
class BoardTrouble:
    """What goes wrong with a whole board."""

    silent: bool = False
    wrong_number: bool = False
    frozen_us: int | None = None
    no_watchdog: bool = False
    old_version: bool = False


@dataclass
class Board:
    """One board with its drives, by slot.

    Attributes:
        number: its own.
        drives: by slot.
        on_s: when it was switched on, by whoever's clock.
        trouble: what is wrong with it.
        volts, driver_c: what it measures.
        refused: datagrams that it did not take.
        heard: commands that it took.
    """

    number: int
    drives: Mapping[int, Drive]
    on_s: float
    trouble: BoardTrouble = field(default_factory=BoardTrouble)
    volts: float = 48.0
    driver_c: float = AMBIENT_C
    refused: int = 0
    heard: int = 0
    serial: int = 1000

    def __post_init__(self) -> None:
        """Switch on: nobody commands it, its watchdog is off."""
        self._lived_s = self._spoken_s = self.on_s
        self._timeout_us = 0
        self._commander: int | None = None
        self._sequence = 0
        self.is_expired = False

    def restart(self, now_s: float) -> None:
        """Its power went away and came back."""
        self.on_s = now_s
        for drive in self.drives.values():
            drive.state, drive.faults, drive.order = DISABLED, 0, LET_GO
        self.__post_init__()

    @property
    def is_on(self) -> bool:
        """Whether any drive waits for commands."""
        return any(drive.is_on for drive in self.drives.values())

    @property
    def timeout_s(self) -> float:
        """Of its watchdog; 0: off."""
        return 1e-6 * self._timeout_us

    # --- the wire ------------------------------------------------------------------------------

    def hear(self, data: bytes, now_s: float) -> bytes | None:
        """A datagram came in; what is answered, if anything."""
        question = codec.asked(data)
        if question is None or self.trouble.silent:
            self.refused += 1
            return None
        if question.board != self.number and not (
            question.kind == codec.HELLO and question.board == codec.ANYBODY
        ):
            self.refused += 1
            return None
        self.live(now_s)
        body = self._obeyed(question, now_s)
        if body is None:
            self.refused += 1
            return None
        time_us = int(1e6 * (now_s - self.on_s)) + 1
        if self.trouble.frozen_us is not None:
            self.trouble.frozen_us = self.trouble.frozen_us or time_us
            time_us = self.trouble.frozen_us
        mask = question.mask
        if question.kind == codec.HELLO:
            mask = sum(1 << slot for slot in self._there())
        number = self.number ^ 1 if self.trouble.wrong_number else self.number
        said = codec.answer(question, board=number, mask=mask, time_us=time_us, body=body)
        return said[:4] + b"\0" + said[5:] if self.trouble.old_version else said

    def _there(self) -> list[int]:
        return sorted(slot for slot, drive in self.drives.items() if not drive.trouble.unplugged)

    def _obeyed(self, question: Asked, now_s: float) -> bytes | None:
        """The body of the answer; None of what is refused."""
        if question.kind == codec.HELLO:
            drives = [self.drives[slot].kind for slot in self._there()]
            return codec.made(
                self.serial, 0x0102, [(kind.model, list(kind[1:])) for kind in drives]
            )
        slots = [slot for slot in range(16) if question.mask >> slot & 1]
        if not slots or set(slots) - set(self._there()):
            return None
        drives = [self.drives[slot] for slot in slots]
        match question.kind:
            case codec.STATE:
                return self._feedback(question, drives) if not question.body else None
            case codec.COMMAND:
                return self._commanded(question, drives, now_s)
            case codec.WATCHDOG:
                return self._guarded(question, drives)
            case codec.ENABLE:
                self._enable(question, drives, now_s)
            case codec.DISABLE | codec.CLEAR | codec.ZERO:
                self._switch(question.kind, drives)
            case _:
                return None
        on = sum(1 << slot for slot, drive in self.drives.items() if drive.is_on)
        return on.to_bytes(4, "little")

    def _switch(self, kind: int, drives: list[Drive]) -> None:
        for drive in drives:
            if kind == codec.DISABLE:
                drive.state, drive.order = DISABLED, LET_GO
            elif kind == codec.CLEAR:
                drive.faults = 0
                drive.state = DISABLED if drive.state == FAULT else drive.state
                drive.watch(self.volts, self.driver_c)
            elif drive.state == DISABLED:
                drive.zero_rad = drive.shaft.q_rad

    def _enable(self, question: Asked, drives: list[Drive], now_s: float) -> None:
        """The asker commands from now on; drives that are on stay as they are."""
        self._commander, self._sequence = question.session, question.sequence
        self._spoken_s, self.is_expired = now_s, False
        for drive in drives:
            if drive.state in (DISABLED, BRAKING):
                drive.state, drive.order = ENABLED, LET_GO

    def _commanded(self, question: Asked, drives: list[Drive], now_s: float) -> bytes | None:
        orders = codec.orders(question.body, len(drives))
        if orders is None or not all(math.isfinite(one) for order in orders for one in order):
            return None
        if question.session == self._commander:
            newer = (question.sequence - self._sequence) % (1 << 32)
            if not 0 < newer < 1 << 31:
                return None  # it was overtaken, or comes for the second time
            self._sequence, self._spoken_s = question.sequence, now_s
            self.heard += 1
            for drive, order in zip(drives, orders, strict=True):
                drive.obey(*order)
        return self._feedback(question, drives)

    def _guarded(self, question: Asked, drives: list[Drive]) -> bytes | None:
        body = question.body
        if len(body) != 4 + 4 * len(drives):
            return None
        found = codec.floats(body[4:])
        if not all(math.isfinite(one) and one >= 0.0 for one in found):
            return None
        if not self.trouble.no_watchdog:
            self._timeout_us = int.from_bytes(body[:4], "little")
        for drive, damping_nm_s in zip(drives, found, strict=True):
            drive.damping_nm_s = min(damping_nm_s, drive.kind.kd)
        said = [drive.damping_nm_s for drive in drives]
        return self._timeout_us.to_bytes(4, "little") + codec.packed_floats(said)

    def _feedback(self, question: Asked, drives: list[Drive]) -> bytes:
        is_other = self.is_on and question.session != self._commander
        return codec.itself(
            obeyed=self._sequence,
            volts=self.volts,
            celsius=self.driver_c,
            refused=self.refused,
            flags=self.is_expired | is_other << 1,
        ) + b"".join(drive.says() for drive in drives)

    # --- the firmware's loop -------------------------------------------------------------------

    def live(self, until_s: float) -> None:
        """Let time go by up to a moment, in whole steps of the drives' loops."""
        drives = self.drives.values()
        span_s = min((drive.shaft.step_s for drive in drives), default=0.001)
        while self._lived_s + span_s <= until_s + SAME_S:
            self._lived_s += span_s
            silent_s = self._lived_s - self._spoken_s
            if self._timeout_us and self.is_on and silent_s > self.timeout_s + SAME_S:
                self.is_expired = True
                for drive in drives:
                    drive.state = BRAKING if drive.is_on else drive.state
            for drive in drives:
                drive.watch(self.volts, self.driver_c)
                drive.turn(span_s)
