"""What emulated motors on CAN have in common: a shaft, heat, what goes wrong, a loop."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field
from typing import ClassVar, Literal, get_args

from sim.devices.shaft import LET_GO, Order, Shaft
from sim.devices.wire import CanFrame, Node, Wire

AMBIENT_C = 25.0
ANSWERS_AFTER_S = 40e-6
SAME_S = 1e-9
"""Sums of steps are not exact."""

Flaw = Literal[
    "silent", "loses_replies", "short_frames", "slow_speed", "wrong_range", "no_watchdog",
    "hot", "low_volts", "over_current", "wrong_mode", "twin",
]  # fmt: skip
"""What can be wrong from the start, by name; what `twin` means is up to who builds the bus."""
FLAWS: tuple[Flaw, ...] = get_args(Flaw)


@dataclass
class Trouble:
    """What goes wrong with one motor.

    Attributes:
        silent: it never answers.
        loses: so many of its next replies do not go out.
        short: its replies lack their last two bytes.
        speed_scale: it reports its speed times this.
        status: a status code, or fault bits, that it falls into, None of its own accord.
    """

    silent: bool = False
    loses: int = 0
    short: bool = False
    speed_scale: float = 1.0
    status: int | None = None


@dataclass
class CanMotor:
    """One motor on a wire.

    Attributes:
        wire, shaft: what it is plugged into, and what it turns.
        motor_id: whom it listens for.
        reply_id: as whom it answers; a family whose replies say whose they are has no use for it.
        position_rad, velocity_rad_s, torque_nm: what its frames stand for as it is sold.
        kp, kd: the largest gains in its frames.
        later_s: by how much later it answers than others do.
        trouble: what is wrong with it.
        winding_c, driver_c, volts: what it measures.
        zero_rad: its shaft's angle where it says 0.
        knows_fd: whether its controller is one of CAN FD.
    """

    wire: Wire
    shaft: Shaft
    motor_id: int
    reply_id: int
    position_rad: float
    velocity_rad_s: float
    torque_nm: float
    kp: float = 500.0
    kd: float = 5.0
    later_s: float = 0.0
    trouble: Trouble = field(default_factory=Trouble)
    winding_c: float = AMBIENT_C
    driver_c: float = AMBIENT_C
    volts: float = 24.0
    heat_k_s: float = 4.0
    zero_rad: float = 0.0
    knows_fd: ClassVar[bool] = False

    def __post_init__(self) -> None:
        """Switch on: disabled, watchdog off, as delivered."""
        self.status = 0
        self.tau_nm = 0.0
        self._ordered, self._last = LET_GO, b""
        self._heard_s = self._lived_s = self.wire.now_s
        self._node: Node = self.wire.attach(self.hear, knows_fd=self.knows_fd)

    @property
    @abstractmethod
    def is_on(self) -> bool:
        """Whether it gives torque."""

    @abstractmethod
    def hear(self, frame: CanFrame, now_s: float) -> None:
        """A frame of somebody else's went by."""

    @property
    @abstractmethod
    def _most_nm(self) -> float:
        """More than this it does not give."""

    @abstractmethod
    def _watch(self) -> None:
        """Fall into a fault; also a disabled motor tells of heat and volts."""

    def suffer(self, flaw: Flaw) -> None:
        """Have something wrong; families say more."""
        match flaw:
            case "silent":
                self.trouble.silent = True
            case "loses_replies":
                self.trouble.loses = 1_000_000_000
            case "short_frames":
                self.trouble.short = True
            case "slow_speed":
                self.trouble.speed_scale = 0.5
            case _:
                pass

    @property
    def _in_force(self) -> Order:
        """What its loop does now."""
        return self._ordered if self.is_on else LET_GO

    @property
    def _q_rad(self) -> float:
        return self.shaft.q_rad - self.zero_rad

    def _answer(self, frame: CanFrame, now_s: float) -> None:
        if self.trouble.silent:
            return
        if self.trouble.loses:
            self.trouble.loses -= 1
            return
        if self.trouble.short:
            frame = frame._replace(data=frame.data[:6])
        self._node.send(frame, now_s + ANSWERS_AFTER_S + self.later_s)

    def live(self, until_s: float) -> None:
        """Let time go by up to a moment, in whole steps of the firmware's loop."""
        span_s = self.shaft.step_s
        while self._lived_s + span_s <= until_s + SAME_S:
            self._lived_s += span_s
            self._watch()
            order = self._in_force
            most_nm = self._most_nm
            self.tau_nm = self.shaft.turn(order, most_nm, span_s)
            load = abs(self.tau_nm) / most_nm
            cooling = 0.02 * (self.winding_c - AMBIENT_C)
            self.winding_c += span_s * (self.heat_k_s * load * load - cooling)
