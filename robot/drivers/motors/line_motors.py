"""What every driver of motors over lines does alike: buses, ports, boards or chips.

Each period a command goes out once, limited; what motors tell until the period ends is its state.
What they tell, and that they do not, sounds alarms; at HOLD it is those that decide what is sent.

A family adds what is its own: how its motors are asked who they are (`_meet`), enabled (`_enable`)
and left (`_damp`, `_let_go`), how a command is said (`_send`), and what is heard in a period
(`_before`, `_hear`, `_end`). It is then a row of `LineFamily`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any, ClassVar, Generic, Protocol, Self, TypeVar

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MIT_MODE, Capability, MotorCommand, MotorState
from robot.drivers.motors.alarms import Alarms, News, untold
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.heard import Heard
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.life import Life, not_let_go, unheard
from robot.drivers.motors.limiter import Limiter, Measured
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.motors.periods import LOOKS, Periods
from robot.drivers.motors.plant_behind import PlantBehind
from robot.drivers.motors.speed_check import SpeedCheck
from robot.drivers.motors.transmission import Transmission
from robot.drivers.motors.watching import SILENT_PERIODS, Watch
from robot.errors import DriverError
from robot.se3 import Array

LEFT_ON = "the motors were left enabled: they are commanded as they are"


class Lines(Closing, Protocol):
    """Buses, ports, boards or chips, opened by entering and closed by leaving."""

    @property
    def gone(self) -> Mapping[str, str]:
        """Those that went away while the others went on, and why."""
        ...


M = TypeVar("M", bound=MotorMap)
L = TypeVar("L", bound=Lines)
H = TypeVar("H", bound=Heard)
W = TypeVar("W", bound=Watch[Any, Any])


class LineMotors(Closing, Generic[M, L, H, W]):
    """All motors of a joint map: a `MotorBus`.

    Attributes:
        capabilities: what these motors can do.
        title: of the family, for people.
        losses: what it calls replies that did not come.
        scheme: under which the claim of a line is known on this machine.
        says_law: whether what is sent says targets and gains, and not torque alone.
        brakes: whether motors can be left so that they damp on by themselves.
        joints: the map, in the order of every array.
        alarms: what is wrong now.
        limiter: the last word on commands.
        reception: what motors told last.
    """

    capabilities: frozenset[Capability] = MIT_MODE
    title: ClassVar[str]
    losses: ClassVar[str] = "replies late"
    scheme: ClassVar[str]
    says_law: ClassVar[bool] = True
    brakes: ClassVar[bool] = True
    reception: H
    _watch: W
    _at: tuple[Array, Array, Array]

    def __init__(
        self,
        joints: M,
        clock: Clock,
        *,
        ports: Callable[[], L],
        tell: Callable[[str], None] = untold,
        waits: bool = True,
        lets_go: bool = False,
        behind: PlantBehind | None = None,
    ) -> None:
        """Know the motors; nothing is opened.

        Args:
            joints: the map.
            clock: of its periods.
            ports: opens its lines.
            tell: hears a line of every alarm, and at the end how well replies came.
            waits: whether `read` waits for the end of a period; False where another driver of the
                same robot sets the pace.
            lets_go: whether motors are disabled at the end, and so give no torque, in place of
                damping on by themselves: for one joint on a bench, not for a robot on its feet.
            behind: the simulated plant behind emulated lines.
        """
        self.joints = joints
        self.alarms = Alarms()
        self._tell, self._news = tell, News(self.alarms, tell)
        self._waits, self._lets_go = waits, lets_go or not self.brakes
        self._clock, self._periods = clock, Periods(clock, joints.period_s)
        self._transmission, self.limiter = Transmission(joints), Limiter(joints)
        self._claim = Claim(self._claimed(joints))
        self._life = Life(ports, self._claim, behind)
        self._is_armed = False
        self._sent: MotorCommand | None = None
        self._obeyed: MotorCommand | None = None
        self._holding = Holding()
        self._commanded = self._lost_before = 0
        self._prepare()

    def _prepare(self) -> None:
        """Get ready what a family keeps beside; nothing is opened."""

    def _claimed(self, joints: M) -> Iterable[str]:
        """What its lines are called on this machine."""
        return (f"{self.scheme}:{at}" for at in joints.channels.values())

    # --- its life --------------------------------------------------------------------------------

    def __enter__(self) -> Self:
        """Open the lines, and ask every motor who it is; nothing is enabled.

        Raises:
            DriverError: if a line cannot be opened, or a motor is not what the map says: with
                everything that disagrees.
        """
        if not self._life.open(partial(self._meet, is_free=True)):
            try:
                self._meet(self._life.lines, is_free=False)
            except DriverError:
                self._life.close(lambda _: None, lambda: None)
                raise
        self._watch = self._watches(self._life.lines)
        self._periods.begin()
        for _ in range(SILENT_PERIODS if self._measures else 0):
            self._read(waits=True)
        return self

    @abstractmethod
    def _meet(self, lines: L, *, is_free: bool) -> None:
        """Ask every motor who it is, on lines that were just opened.

        Args:
            lines: of the motors.
            is_free: whether nobody else commands them; questions may disturb who does.

        Raises:
            DriverError: with everything that disagrees with the map.
        """

    @abstractmethod
    def _watches(self, lines: L) -> W:
        """What looks at motors and lines, and sounds the alarms."""

    @property
    def _measures(self) -> bool:
        """Whether motors say where they are."""
        return "position" in self.capabilities

    def close(self) -> None:
        """Leave motors damping for themselves, if they are commanded from here, and close.

        Raises:
            DriverError: if they were to be disabled, and one was not seen to be.
        """
        self._life.close(self._leave, self._left)

    def _leave(self, lines: L) -> None:
        if not self._is_armed:
            return
        if not self._lets_go:
            self._damp(lines)
        elif on := self._let_go(lines):
            raise not_let_go(on)

    @abstractmethod
    def _damp(self, lines: L) -> None:
        """Leave all motors damping for themselves."""

    @abstractmethod
    def _let_go(self, lines: L) -> list[str]:
        """Disable all motors; the joints of those that were not seen to be."""

    def _left(self) -> None:
        self._is_armed = False
        if self._commanded:
            self._tell(self._summary())

    def _summary(self) -> str:
        """How well replies came since the motors were enabled."""
        joints, lost = len(self.joints.joints), self.reception.lost - self._lost_before
        share = lost / (self._commanded * joints)
        return (
            f"{self.title}: {self._where}, {self._commanded} periods at {self.joints.rate_hz} Hz, "
            f"{lost} {self.losses} ({share:.3%}), {self._more}{self.late} periods late"
        )

    @property
    def _where(self) -> str:
        """How many joints, for people."""
        return f"{len(self.joints.joints)} joints"

    @property
    def _more(self) -> str:
        """What a family counts beside, with a comma at its end."""
        return ""

    def claim(self) -> bool:
        """Become the one that commands these motors; False while another one does."""
        return self._life.claim(self._begin)

    def _begin(self, lines: L) -> None:
        self._drop(lines)
        self._periods.begin()
        self.reception.forget_where()

    @abstractmethod
    def _drop(self, lines: L) -> None:
        """Drop what came in and nobody read: it is of the past."""

    @property
    def late(self) -> int:
        """Periods that began late by more than one."""
        return self._periods.late

    @property
    def speeds(self) -> SpeedCheck:
        """How reported speeds compare with reported positions."""
        return self._watch.joints.speeds

    @abstractmethod
    def status_of(self, index: int) -> str:
        """What a joint's motor says of itself, in one word."""

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command arms the motors anew.

        What is still wrong sounds again.
        """
        self.alarms.reset()
        self._watch.forget()
        self._is_armed, self._sent, self._obeyed = False, None, None
        self._holding.forget()
        self.limiter.forget()

    # --- read ------------------------------------------------------------------------------------

    def read(self) -> MotorState:
        """The state at the end of this period. Raises DriverError if all lines went away."""
        return self._read(waits=self._waits)

    def _read(self, *, waits: bool) -> MotorState:
        lines = self._life.lines
        self._before(lines)
        if waits:
            self._periods.wait(self._hear, looks=self._looks)
        self._end(lines)
        for line, why in lines.gone.items():
            self._watch.unplugged(line, why)
        return self._state()

    @property
    def _looks(self) -> int:
        """How often in this period it is looked what came in."""
        return LOOKS

    def _before(self, lines: L) -> None:
        """Ask motors for their state, where no command did in this period."""

    def _hear(self) -> None:
        """Take what came in, in the middle of a period."""

    def _end(self, lines: L) -> None:
        """Take the last that came in; the period is over for `reception`."""

    def _state(self) -> MotorState:
        now_s, heard = self._clock.now_s(), self.reception
        self._at = q, qd, tau = heard.at_joints(self._transmission)
        self._watch.joints.linkages(self._transmission.unsolved)
        self._watch.look(now_s, heard, q, qd, is_armed=self._is_armed)
        self._commanded += self._is_armed
        if self._is_armed:
            self._news.say(now_s)
        left_on = self._is_left_enabled
        return MotorState(
            stamp_s=now_s,
            q=q.copy(),
            qd=qd.copy(),
            tau=tau.copy(),
            temperature_c=heard.temperature_c.copy(),
            age_s=now_s - heard.heard_s,
            watchdog=not (self._is_armed or left_on) or self._has_let_go,
            command_stamp_s=self._commanded_s(now_s, left_on=left_on),
            alarms=self.alarms.messages() if self._is_armed else (),
        )

    def _commanded_s(self, now_s: float, *, left_on: bool) -> float:
        """Of the last command; that of another program is no older than the motors' watchdog."""
        if self._sent is not None:
            return self._sent.stamp_s
        return now_s if left_on else -float("inf")

    @property
    def _is_left_enabled(self) -> bool:
        """Whether a program that commanded until a moment ago left all motors enabled."""
        return False

    @property
    def _has_let_go(self) -> bool:
        """Whether motors that were enabled stopped by themselves: their watchdog expired."""
        return False

    # --- write -----------------------------------------------------------------------------------

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command, limited; returns what is really said.

        While an alarm says HOLD, the last targets are sent in its place.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), another
                driver commands, or a motor cannot be enabled.
        """
        lines = self._life.lines
        self.limiter.check(command)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        self.arm()
        self._sent = self._obey(lines, command)
        return self._sent

    def _obey(self, lines: L, command: MotorCommand) -> MotorCommand:
        q, qd, _ = self._at
        measured = Measured(q, qd, self.reception.temperature_c)
        wanted = self._holding.decided(command, self.alarms.level, obeyed=self._obeyed, q=q)
        limited = self.limiter.apply(wanted, measured)
        said = self._send(lines, limited)
        self._obeyed = said if self.says_law else limited
        return said

    @abstractmethod
    def _send(self, lines: L, command: MotorCommand) -> MotorCommand:
        """Send a command that is inside all limits; what is really said."""

    def arm(self) -> None:
        """Enable all motors, with no torque, unless they are.

        Raises:
            DriverError: if one is not what the map says, does not, or then says nothing.
        """
        lines = self._life.lines
        if self._is_armed:
            return
        was_left = self._enable(lines)
        if was_left:
            self._tell(LEFT_ON)
        self._is_armed = True
        if self._measures and (silent := self._silent()):
            self._is_armed = False
            if not was_left:  # else their watchdog does it
                self._let_go(lines)
            raise DriverError(f"nothing is commanded: no word of {', '.join(silent)}")
        self._count_anew()

    @abstractmethod
    def _enable(self, lines: L) -> bool:
        """Enable all motors or none; whether they were left enabled, and go on as they are.

        Raises:
            DriverError: if one is not what the map says, or does not.
        """

    def _silent(self) -> list[str]:
        """Joints whose motors, just enabled, do not say where they are."""
        self._periods.begin()
        names = self.joints.joints
        return unheard(names, lambda: self._read(waits=True), lambda: self.reception.heard_s)

    def _count_anew(self) -> None:
        """What was lost before motors were enabled does not count."""
        self._lost_before, self._commanded = self.reception.lost, 0
