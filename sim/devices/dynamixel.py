"""A servo of the X series, from the e-manual: operating modes, watchdog, errors, what can be wrong.

What the e-manual leaves open is assumed here, and named: what an expired bus watchdog does in each
mode (no current; speed zero; hold), when an overload is one, that the position loop's output is a
voltage whose torque falls with speed, also where a goal current limits it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal, get_args

from sim.devices.dynamixel_table import ACCESS, RANGE, RESULT_FAIL, Memory
from sim.devices.shaft import LET_GO, Order, Shaft

AMBIENT_C = 25.0
SAME_S = 1e-9
PULSE_RAD = 2.0 * math.pi / 4096
MIDDLE = 2048
SPEED_RAD_S = 0.229 * 2.0 * math.pi / 60.0
ACCELERATION_RAD_S2 = 214.577 * 2.0 * math.pi / 3600.0
FULL_PWM = 885
WATCHDOG_S = 0.02
LOOP_S = 0.001
OVERLOAD_SHARE, OVERLOAD_S = 0.95, 2.0
"""Assumed: so much of its torque, standing still, for so long."""
STILL_RAD_S = 0.05

Flaw = Literal[
    "silent", "crc_errors", "half_packets", "late", "alert", "wrong_model", "twin", "wrong_mode",
    "hot", "low_volts", "overload", "slow_speed",
]  # fmt: skip
"""What can be wrong from the start, by name."""
FLAWS: tuple[Flaw, ...] = get_args(Flaw)


@dataclass(frozen=True)
class Kind:
    """What a servo is: its number, torque and current at standstill, speed without load."""

    number: int
    stall_nm: float
    stall_a: float
    speed_rad_s: float
    step_a: float
    current_limit: int
    volts: float = 12.0

    @property
    def step_nm(self) -> float:
        """Torque of a step of current."""
        return self.step_a * self.stall_nm / self.stall_a


@dataclass
class Trouble:
    """What goes wrong with one servo.

    Attributes:
        silent: it never answers, and does nothing.
        spoils: so many of its next answers have a wrong byte.
        halves: so many of its next answers end in the middle.
        later_s: it answers so much later.
        error: bits of hardware error that it falls into.
        speed_scale: it reports its speed times this.
    """

    silent: bool = False
    spoils: int = 0
    halves: int = 0
    later_s: float = 0.0
    error: int = 0
    speed_scale: float = 1.0


@dataclass
class Servo:
    """One servo.

    Attributes:
        kind, shaft: what it is, and what it turns.
        number: its identifier.
        now_s: when it is switched on.
        trouble: what is wrong with it.
        winding_c, volts: what it measures.
        heat_k_s: by which its winding gets warmer at full torque; 0: somebody else says how warm.
    """

    kind: Kind
    shaft: Shaft
    number: int
    now_s: float = 0.0
    trouble: Trouble = field(default_factory=Trouble)
    winding_c: float = AMBIENT_C
    heat_k_s: float = 4.0

    def __post_init__(self) -> None:
        """Switch on: torque off, as delivered."""
        self.memory = Memory(self.kind.number, self.number, self.kind.current_limit)
        self.volts = self.kind.volts
        self.tau_nm = 0.0
        self._lived_s = self._heard_s = self.now_s
        self._turns, self._known = 0, -1
        self._wrap()
        self._begin()
        self._learn()

    def suffer(self, flaw: Flaw) -> None:
        """Have something wrong; what `twin` means is up to who builds the line."""
        match flaw:
            case "silent":
                self.trouble.silent = True
            case "crc_errors":
                self.trouble.spoils = 1_000_000_000
            case "half_packets":
                self.trouble.halves = 1_000_000_000
            case "late":
                self.trouble.later_s = 0.1
            case "alert":
                self.trouble.error = 1 << 4
            case "overload":
                self.trouble.error = 1 << 5
            case "slow_speed":
                self.trouble.speed_scale = 0.5
            case "wrong_model":
                self.memory.put(0, 2, 1060)
            case "wrong_mode":
                self.memory.put(11, 1, 1)
            case "hot":
                self.winding_c = 81.0
            case "low_volts":
                self.volts = 9.0
            case "twin":
                pass

    # --- the line ------------------------------------------------------------------------------

    @property
    def is_on(self) -> bool:
        """Whether it gives torque."""
        return bool(self.memory.get(64, 1))

    @property
    def alert(self) -> int:
        """The bit that its status packets carry while it has a hardware error."""
        return 0x80 if self.memory.get(70, 1) else 0

    @property
    def answers_after_s(self) -> float:
        """Its return delay."""
        return self.memory.get(9, 1) * 2e-6 + self.trouble.later_s

    def hear(self, now_s: float) -> None:
        """An instruction went by, for it or for another: its bus watchdog begins anew."""
        self.live(now_s)
        self._heard_s = now_s

    def read(self, address: int, size: int) -> tuple[int, bytes]:
        """Error and bytes."""
        self._measure()
        data = self.memory.read(address, size)
        return (ACCESS, b"") if data is None else (0, data)

    def write(self, address: int, data: bytes) -> int:
        """Bytes into its table; returns the error."""
        was_on, before = self.is_on, self.memory.get(98, 1, signed=True)
        is_torque = address <= 64 < address + len(data)
        if is_torque and data[64 - address] and self._is_shut():
            return RESULT_FAIL  # only a reboot lets it give torque again
        if address == 98 and before == -1 and data[:1] != b"\0":
            return RANGE
        error = self.memory.write(address, data)
        if not error and (self.is_on != was_on or address <= 11 < address + len(data)):
            self._begin()
        if not error and address == 98:
            self._heard_s = self._lived_s
        return error

    def reboot(self) -> None:
        """Off and on again; it knows where it is within one turn only."""
        self.memory.switch_on()
        self._turns = 0
        self._wrap()
        self._begin()

    # --- the firmware's loop -------------------------------------------------------------------

    def live(self, until_s: float) -> None:
        """Let time go by up to a moment, in whole steps of its shaft."""
        span_s, shaft = self.shaft.step_s, self.shaft
        while self._lived_s + span_s <= until_s + SAME_S:
            self._lived_s += span_s
            if self.memory.changes != self._known:
                self._learn()
            self._watch(span_s)
            order, most_nm = self._order(span_s) if self._on else (LET_GO, 0.0)
            self.tau_nm = shaft.turn(order, most_nm, span_s)
            if self.heat_k_s:
                load = self.tau_nm / self.kind.stall_nm
                cooling = 0.02 * (self.winding_c - AMBIENT_C)
                self.winding_c += span_s * (self.heat_k_s * load * load - cooling)

    def _learn(self) -> None:
        """What is set: looked up once, and not in every step."""
        memory = self.memory
        self._on, self._mode = self.is_on, memory.get(11, 1)
        self._watchdog_s = memory.get(98, 1, signed=True) * WATCHDOG_S
        self._most = min(self.kind.stall_nm, memory.get(38, 2) * self.kind.step_nm)
        self._wanted_nm = memory.get(102, 2, signed=True) * self.kind.step_nm
        self._hottest_c = memory.get(31, 1)
        self._least_v, self._most_v = 0.1 * memory.get(34, 2), 0.1 * memory.get(32, 2)
        self._error = memory.get(70, 1)
        self._known = memory.changes

    def _watch(self, span_s: float) -> None:
        memory = self.memory
        if 0.0 < self._watchdog_s < self._lived_s - self._heard_s:
            memory.put(98, 1, -1)
            for address, size in ((102, 2), (104, 4), (108, 4), (112, 4)):
                memory.put(address, size, 0)
            self._hold()
        error = self._error | self.trouble.error
        if not self._least_v - 0.05 < self.volts < self._most_v + 0.05:
            error |= 1 << 0
        if self.winding_c > self._hottest_c:
            error |= 1 << 2
        if self._on and abs(self.tau_nm) >= OVERLOAD_SHARE * self._most:
            still = abs(self.shaft.qd_rad_s) < STILL_RAD_S
            self._strained_s = self._strained_s + span_s if still else 0.0
            if self._strained_s > OVERLOAD_S:
                error |= 1 << 5
        else:
            self._strained_s = 0.0
        if error != self._error:
            memory.put(70, 1, error)
        if self._on and error and self._is_shut():
            memory.put(64, 1, 0)
        if memory.changes != self._known:
            self._learn()

    def _is_shut(self) -> bool:
        return bool(self.memory.get(70, 1) & self.memory.get(63, 1))

    def _order(self, span_s: float) -> tuple[Order, float]:
        """What the loop of its mode makes the motor do, and the most that it can."""
        memory, kind, mode, most = self.memory, self.kind, self._mode, self._most
        if mode == 0:
            tau = _within(self._wanted_nm, most, kind, self.shaft.qd_rad_s)
            return (LET_GO if tau == 0.0 else Order(tau_nm=tau)), most
        back_emf = kind.stall_nm / kind.speed_rad_s
        if mode == 16:
            share = memory.get(100, 2, signed=True) / FULL_PWM
            return Order(kd=back_emf, tau_nm=share * kind.stall_nm), most
        if mode == 1:
            return self._velocity_order(span_s), most
        if mode == 5:
            most = min(most, abs(self._wanted_nm))
        target = self._trajectory(memory.get(116, 4, signed=True), span_s)
        unit = kind.stall_nm / FULL_PWM / PULSE_RAD  # N m/rad of one PWM step a pulse
        kp = memory.get(84, 2) / 128.0 * unit
        kd = memory.get(80, 2) / 16.0 * unit * LOOP_S + back_emf
        error = target - self._position_rad
        self._sum = max(-most, min(most, self._sum + error * self._integral(unit, span_s)))
        return Order(q_rad=self.shaft.q_rad + error, kp=kp, kd=kd, tau_nm=self._sum), most

    def _integral(self, unit: float, span_s: float) -> float:
        return self.memory.get(82, 2) / 65536.0 * unit * span_s / LOOP_S

    def _velocity_order(self, span_s: float) -> Order:
        memory = self.memory
        wanted = memory.get(104, 4, signed=True) * SPEED_RAD_S
        unit = self.kind.step_nm / SPEED_RAD_S
        error = wanted - self.shaft.qd_rad_s
        step = memory.get(76, 2) / 65536.0 * unit * error * span_s / LOOP_S
        self._sum = max(-self._most, min(self._most, self._sum + step))
        return Order(qd_rad_s=wanted, kd=memory.get(78, 2) / 128.0 * unit, tau_nm=self._sum)

    def _trajectory(self, goal: int, span_s: float) -> float:
        """Where its profile is now, on the way to its goal; at once if it has no profile."""
        goal_rad = (goal - MIDDLE) * PULSE_RAD
        fastest = self.memory.get(112, 4) * SPEED_RAD_S
        if not fastest:
            self._profile_rad, self._profile_rad_s = goal_rad, 0.0
            return goal_rad
        rise = self.memory.get(108, 4) * ACCELERATION_RAD_S2 or math.inf
        left = goal_rad - self._profile_rad
        braking = math.sqrt(2.0 * rise * abs(left)) if math.isfinite(rise) else math.inf
        wanted = math.copysign(min(fastest, braking), left)
        change = min(rise * span_s, abs(wanted - self._profile_rad_s))
        self._profile_rad_s += math.copysign(change, wanted - self._profile_rad_s)
        step = self._profile_rad_s * span_s
        self._profile_rad = goal_rad if abs(step) >= abs(left) else self._profile_rad + step
        return self._profile_rad

    # --- what it measures ----------------------------------------------------------------------

    @property
    def _position_rad(self) -> float:
        """As it tells it, from its middle on."""
        offset = self.memory.get(20, 4, signed=True) * PULSE_RAD
        return self.shaft.q_rad + offset + self._turns * 2.0 * math.pi

    def _wrap(self) -> None:
        """It was switched on: it is between 0 and 4095."""
        pulses = math.floor(self._position_rad / PULSE_RAD) + MIDDLE
        self._turns -= pulses // 4096

    def _begin(self) -> None:
        """Torque or mode was changed: nothing is left of what it did before."""
        self._sum = self._strained_s = self._profile_rad_s = 0.0
        self._profile_rad = self._position_rad
        if self.memory.get(11, 1) == 0:
            self.memory.put(102, 2, 0)
        self._hold()

    def _hold(self) -> None:
        pulses = MIDDLE + round(self._position_rad / PULSE_RAD)
        self.memory.put(116, 4, pulses)

    def _measure(self) -> None:
        memory, shaft = self.memory, self.shaft
        amperes = self.tau_nm / self.kind.step_nm
        memory.measure(126, 2, int(amperes))
        memory.measure(128, 4, int(shaft.qd_rad_s * self.trouble.speed_scale / SPEED_RAD_S))
        memory.measure(132, 4, MIDDLE + math.floor(self._position_rad / PULSE_RAD))
        memory.measure(140, 4, MIDDLE + math.floor(self._profile_rad / PULSE_RAD))
        memory.measure(122, 1, int(abs(shaft.qd_rad_s / SPEED_RAD_S) > memory.get(24, 4)))
        memory.measure(144, 2, round(10 * self.volts))
        memory.measure(146, 1, int(self.winding_c))


def _within(tau_nm: float, most_nm: float, kind: Kind, speed_rad_s: float) -> float:
    """What is left of a torque at a speed: pushing on, voltage runs out; braking it does not."""
    left_nm = kind.stall_nm * max(0.0, 1.0 - abs(speed_rad_s) / kind.speed_rad_s)
    pushes = tau_nm * speed_rad_s > 0.0
    most_nm = min(most_nm, left_nm) if pushes else most_nm
    return max(-most_nm, min(most_nm, tau_nm))
