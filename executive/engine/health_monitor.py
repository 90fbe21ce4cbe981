"""How well the robot is, from the ages and rates of its messages and from what they say.

Everything here is a table. The row of a topic (`robot.bus.topics`) says when it is late or thin,
and what that means for the robot; `GRADES` says from which value of a measurement on it has to go
slower, to stand, or to end its task. Nothing here knows how messages travel: the newest stamps are
arguments. docs/health.md is made of these tables.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence

import msgspec

from executive.engine.estop import EmergencyStop
from executive.health import Finding, Health, Level
from robot.bus.topics import TOPICS, Silence
from robot.failures import failure
from robot.messages import IMU, BodyState, CameraState, LoopTiming, PowerState, WorldState

START_UP_S = 10.0
"""How long the first message of a topic may take after the start."""
WINDOW_TICKS = 40
"""Ticks over which the rate of a topic is judged: 2 s."""
THIN, WELL = 0.6, 0.8
"""A topic that brings less than this part of what it promises is thin, until it brings that."""
COOL_C = 70.0
"""A motor that has tripped has to cool down to this before anything moves again."""
OVERLOAD_SHARE = 0.15
"""More late periods than this are too many to go on with, once all else makes room."""
PACE_WELL = 0.95
"""A simulation whose time was said to be slow is well again from here on."""
THIN_SPEED = 0.6
"""The part of the speed that is left while a topic is thin."""
DERATED_SPEED = 0.6
"""The part of the speed that is left while a motor gives less torque."""
DOWN = ("fallen", "rising")
"""Modes of a body without a foot that says where it is: its pose has to be found again anyway."""
JUMP_REST_S = 2.0
"""How long the pose has to be steady after it has jumped."""
CONCERNS: dict[str, Silence] = {
    topic.name: topic.silence for topic in TOPICS if topic.silence is not None
}
"""Topic name to what its silence means. Topics that are not in it are not missed."""


class Grade(msgspec.Struct, frozen=True, kw_only=True):
    """From which value on a measurement means a level, and what speed is left (part of the most).

    `ends` is the part that is left where the next grade begins: in between it falls linearly.
    """

    at: float
    level: Level
    speed: float = 1.0
    ends: float | None = None


class Scale(msgspec.Struct, frozen=True, kw_only=True):
    """The grades of one measurement, mild first; `falling` where less is worse."""

    code: str
    unit: str
    grades: tuple[Grade, ...]
    falling: bool = False

    def grade(self, value: float) -> tuple[Level, float]:
        """The level of a value, and the part of the speed that is left."""
        sign = -1.0 if self.falling else 1.0
        reached = [grade for grade in self.grades if sign * value >= sign * grade.at]
        if not reached:
            return Level.OK, 1.0
        grade = reached[-1]
        if grade.ends is None or len(reached) == len(self.grades):
            return grade.level, grade.speed
        following = self.grades[len(reached)]
        share = (value - grade.at) / (following.at - grade.at)
        return grade.level, grade.speed + share * (grade.ends - grade.speed)


GRADES: dict[str, Scale] = {
    "temperature": Scale(
        code="overheated",
        unit="°C",
        grades=(
            Grade(at=80.0, level=Level.DERATE, speed=1.0, ends=0.4),
            Grade(at=100.0, level=Level.SIT),
        ),
    ),
    "battery": Scale(
        code="battery_low",
        unit="of the charge",
        falling=True,
        grades=(
            Grade(at=0.20, level=Level.WARN),
            Grade(at=0.10, level=Level.RETURN, speed=0.5),
            Grade(at=0.05, level=Level.SIT),
        ),
    ),
    "fix": Scale(
        code="localisation_lost",
        unit="s old",
        grades=(Grade(at=0.5, level=Level.WARN), Grade(at=1.5, level=Level.HOLD)),
    ),
    "lateness": Scale(
        code="overloaded",
        unit="of the controller's periods late and not waited for",
        grades=(
            Grade(at=0.05, level=Level.WARN),
            Grade(at=0.30, level=Level.DERATE, speed=0.6),
            Grade(at=0.90, level=Level.HOLD),
        ),
    ),
    "overload": Scale(
        code="overloaded",
        unit=f"s of more than {100 * OVERLOAD_SHARE:.0f} % late, though all else makes room",
        grades=(Grade(at=3.0, level=Level.HOLD),),
    ),
    "pace": Scale(
        code="overloaded",
        unit="x real time, of a simulation that waits for the controller",
        falling=True,
        grades=(Grade(at=0.8, level=Level.WARN),),
    ),
}
"""Measurement to what its values mean."""


class HealthMonitor:
    """Turns stamps and states into `Health`, once a tick."""

    def __init__(
        self,
        rates_hz: Mapping[str, float],
        *,
        start_s: float,
        motors: Sequence[str] = (),
        speed_m_s: float = math.inf,
        estop: EmergencyStop | None = None,
    ) -> None:
        """Watch those topics of `CONCERNS` that have a promised rate.

        Args:
            rates_hz: topic name to promised rate.
            start_s: now.
            motors: names in motor order, for people.
            speed_m_s: the robot's fastest walk, of which a part is left when it is unwell.
            estop: the emergency stop.
        """
        self._concerns = {
            name: (CONCERNS[name], rate_hz)
            for name, rate_hz in rates_hz.items()
            if name in CONCERNS and rate_hz > 0.0
        }
        self._start_s = start_s
        self._motors = motors
        self._speed_m_s = speed_m_s
        self._estop = estop or EmergencyStop()
        self._flows = {name: _Flow(rate_hz) for name, (_, rate_hz) in self._concerns.items()}
        self._tripped = False
        self._jumps: int | None = None
        self._jumped_s = -math.inf
        self._fit_s = start_s
        self._slow = False

    def look(
        self,
        now_s: float,
        stamps_s: Mapping[str, float | None],
        *,
        body: BodyState | None,
        world: WorldState | None,
        camera: CameraState | None = None,
        power: PowerState | None = None,
        timing: LoopTiming | None = None,
    ) -> Health:
        """Assess the robot.

        Args:
            now_s: the time of this tick.
            stamps_s: stamp of the newest message of each topic, None before the first.
            body: the newest body state.
            world: the newest world model.
            camera: how the camera of pictures is.
            power: the newest state of the battery.
            timing: how well the controller keeps its time.
        """
        findings: list[Finding] = []
        ages_s: dict[str, float] = {}
        for name, (concern, rate_hz) in self._concerns.items():
            stamp_s = stamps_s.get(name)
            ages_s[name] = round(now_s - (self._start_s if stamp_s is None else stamp_s), 4)
            finding = self._silence(name, concern, rate_hz, ages_s[name], came=stamp_s is not None)
            thin = self._flows[name].judge(name, now_s, stamp_s)
            findings += [one for one in (finding or thin,) if one is not None]
        findings += filter(None, [self._estop.finding])
        if body is not None:
            findings += [*_fall(body), *self._heat(body), *_alarms(body)]
        if world is not None:
            place = [*_fix(world, now_s), *self._jump(world, now_s)]
            findings += [] if body is not None and body.mode in DOWN else place
        if camera is not None and camera.code:
            reason = failure(camera.code, camera.cause)  # nothing is done by pictures yet
            findings.append(Finding(name="camera", level=Level.WARN, failure=reason))
        if power is not None:
            findings += _battery(power)
        if timing is not None:
            findings += [*self._lateness(timing, now_s), *self._pace(timing)]
        findings.sort(key=lambda finding: -finding.level)
        left = min((finding.speed for finding in findings), default=1.0)
        speed_m_s = left * self._speed_m_s if left < 1.0 else math.inf
        return Health(
            findings=tuple(findings),
            ages_s=ages_s,
            speed_m_s=speed_m_s,
            pressed=self._slow or (timing is not None and timing.pressed),
        )

    @staticmethod
    def _silence(
        name: str, concern: Silence, rate_hz: float, age_s: float, *, came: bool
    ) -> Finding | None:
        """What the age of a topic's newest message means; before the first one, wait for it."""
        if came and age_s <= max(concern.periods / rate_hz, concern.at_least_s):
            return None
        starting = not came and age_s <= START_UP_S
        text = concern.starting if starting else f"{concern.text} for {age_s:.1f} s"
        level = Level.HOLD if starting else Level[concern.level]
        reason = failure(concern.code, text, topic=name, age_s=age_s, promised_hz=rate_hz)
        return Finding(name=name, level=level, failure=reason, beginning=starting)

    def _heat(self, body: BodyState) -> list[Finding]:
        """Hot motors; one that tripped has to cool down well below before it counts as well."""
        hottest_c = max(body.temperature_c, default=0.0)
        scale = GRADES["temperature"]
        level, speed = scale.grade(hottest_c)
        self._tripped = level is Level.SIT or (self._tripped and hottest_c > COOL_C)
        if self._tripped:
            level = Level.SIT
        if level is Level.OK:
            return []
        index = body.temperature_c.index(hottest_c)
        motor = self._motors[index] if index < len(self._motors) else f"motor {index}"
        text = f"the {motor} motor is at {hottest_c:.0f} °C"
        if self._tripped:
            text += f", it has to cool down to {COOL_C:.0f} °C"
        reason = failure(scale.code, text, motor=motor, temperature_c=round(hottest_c, 1))
        return [Finding(name="temperature", level=level, failure=reason, speed=speed)]

    def _jump(self, world: WorldState, now_s: float) -> list[Finding]:
        """A pose that was thrown over is not walked on before it has been steady for a while."""
        if self._jumps is not None and world.jumps > self._jumps:
            self._jumped_s = now_s
        self._jumps = world.jumps
        if now_s - self._jumped_s >= JUMP_REST_S:
            return []
        text = "the robot's pose has jumped; waiting until it is steady"
        reason = failure("localisation_lost", text, jumps=float(world.jumps))
        return [Finding(name="jump", level=Level.HOLD, failure=reason)]

    def _lateness(self, timing: LoopTiming, now_s: float) -> list[Finding]:
        """The part of the controller's periods that were late since its last report.

        Those that the body's time waited for are as good as those in time.
        """
        if not timing.pressed or timing.missed_share <= OVERLOAD_SHARE:
            self._fit_s = now_s
        text = f"{100.0 * timing.missed_share:.0f} % of the controller's periods are late"
        if timing.waited_for:
            text += f" by more than simulated time waits ({timing.pace:.1f} x real time)"
        if timing.pressed:
            text += "; camera, lidar and drawing go slower"
        late = _graded("lateness", timing.missed_share, text)
        return [*_graded("overload", now_s - self._fit_s, text), *late]

    def _pace(self, timing: LoopTiming) -> list[Finding]:
        """How fast simulated time goes by, where it waits for the controller."""
        scale = GRADES["pace"]
        level, _ = scale.grade(timing.pace)
        self._slow = timing.waited_for and (
            level is not Level.OK or (self._slow and timing.pace < PACE_WELL)
        )
        if not self._slow:
            return []
        text = (
            f"simulated time runs at {timing.pace:.1f} x: this machine is too slow for this "
            "simulation in real time; the robot does the same, later by the clock on the wall"
        )
        reason = failure(scale.code, text, pace=round(timing.pace, 2))
        return [Finding(name="pace", level=scale.grades[0].level, failure=reason)]


class _Flow:
    """Whether a topic brings what it promises: the part of the ticks that see a new message."""

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._ticks: deque[tuple[float, bool]] = deque(maxlen=WINDOW_TICKS)
        self._stamp_s: float | None = None
        self._thin = False

    def judge(self, name: str, now_s: float, stamp_s: float | None) -> Finding | None:
        """Look once a tick; None while all is well, or while it is too early to tell."""
        if stamp_s is None:
            return None  # it has not begun, which is another finding
        self._ticks.append((now_s, stamp_s != self._stamp_s))
        self._stamp_s = stamp_s
        if len(self._ticks) < WINDOW_TICKS:
            return None
        span_s = now_s - self._ticks[0][0]
        seen = sum(new for _, new in self._ticks) - 1
        wanted = min(span_s * self._rate_hz, len(self._ticks) - 1.0)
        self._thin = seen < (WELL if self._thin else THIN) * wanted
        if not self._thin:
            return None
        text = f"{name} brings {max(0, seen)} messages where {wanted:.0f} are promised"
        reason = failure(CONCERNS[name].code, text, topic=name, part=round(seen / wanted, 2))
        return Finding(name=f"{name} rate", level=Level.DERATE, failure=reason, speed=THIN_SPEED)


def _graded(name: str, value: float, text: str, **evidence: float) -> list[Finding]:
    """A finding out of the table, or none."""
    scale = GRADES[name]
    level, speed = scale.grade(value)
    if level is Level.OK:
        return []
    reason = failure(scale.code, text, suggestion="", **evidence)
    return [Finding(name=name, level=level, failure=reason, speed=speed)]


def _fall(body: BodyState) -> list[Finding]:
    """A fall, or a failure of the controller."""
    if body.mode == "fallen":
        reason = body.failure or failure("fallen", "the robot lies on the floor")
        return [Finding(name="fall", level=Level.DAMP, failure=reason)]
    if body.mode == "damping" and body.failure is not None and body.failure.code == "lost_balance":
        return [Finding(name="fall", level=Level.DAMP, failure=body.failure)]
    if body.failure is not None:
        return [Finding(name="controller", level=Level.SIT, failure=body.failure)]
    return []


def _alarms(body: BodyState) -> list[Finding]:
    """What the motors' driver says is wrong, or the controller of its IMU, at its own level."""
    return [
        Finding(
            name=alarm.who if alarm.who == IMU else f"motor {alarm.who}",
            level=Level.SIT if alarm.level == "OFF" else Level[alarm.level],
            failure=failure(
                "imu_fault" if alarm.who == IMU else "motor_fault",
                f"{alarm.who}: {alarm.cause}",
                suggestion=alarm.cure,
                who=alarm.who,
                alarm=alarm.code,
            ),
            speed=DERATED_SPEED if alarm.level == "DERATE" else 1.0,
        )
        for alarm in body.alarms
    ]


def _battery(power: PowerState) -> list[Finding]:
    text = f"the battery is at {100.0 * power.charge:.0f} % ({power.source})"
    charge, power_w = round(power.charge, 3), round(power.power_w, 0)
    return _graded("battery", power.charge, text, charge=charge, power_w=power_w)


def _fix(world: WorldState, now_s: float) -> list[Finding]:
    """Whether it knows where it is, and how old the last absolute fix of the pose is."""
    if world.lost:
        reason = failure("localisation_lost", world.lost)
        return [Finding(name="localisation", level=Level.HOLD, failure=reason)]
    age_s = world.fix_age_s + max(0.0, now_s - world.stamp_s)
    text = f"no fix of the robot's pose for {age_s:.1f} s"
    found = _graded("fix", age_s, text, fix_age_s=round(age_s, 3))
    return [msgspec.structs.replace(one, name="localisation") for one in found]
