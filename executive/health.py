"""How well the robot is, from the ages of its messages and from what they say.

The promised rate of a topic (`robot.bus.topics`) says when it is late; `CONCERNS` says what a late
topic means for the robot. Nothing here knows how messages travel: the newest stamps are arguments.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from executive.ladder import Finding, Health, Level
from robot.errors import failure
from robot.messages import BodyState, WorldState

START_UP_S = 10.0
"""How long the first message of a topic may take after the start."""
FIX_LATE_S, FIX_LOST_S = 0.5, 1.5
TEMPERATURE_WARM_C, TEMPERATURE_TRIP_C = 80.0, 100.0


class Concern(msgspec.Struct, frozen=True, kw_only=True):
    """What silence of a topic means: after how many periods (and seconds at least) which level."""

    code: str
    level: Level
    text: str
    periods: float = 3.0
    at_least_s: float = 0.3


CONCERNS: dict[str, Concern] = {
    "body/state": Concern(
        code="controller_lost",
        level=Level.SIT,
        text="the controller stopped reporting; the motors damp by themselves",
        periods=10.0,
        at_least_s=0.5,
    ),
    "sensors/lidar": Concern(
        code="sensor_silent", level=Level.HOLD, text="the lidar is silent", at_least_s=0.5
    ),
    "sensors/depth": Concern(
        code="sensor_silent", level=Level.HOLD, text="the camera is silent", at_least_s=0.5
    ),
    "world/state": Concern(
        code="localisation_lost", level=Level.HOLD, text="the world model is silent",
        at_least_s=0.5,
    ),
}  # fmt: skip
"""Topic name to what its silence means. Topics that are not listed are not missed."""


class HealthMonitor:
    """Turns stamps and states into `Health`, once a tick."""

    def __init__(
        self, rates_hz: Mapping[str, float], *, start_s: float, motors: Sequence[str] = ()
    ) -> None:
        """Watch those topics of `CONCERNS` that have a promised rate.

        Args:
            rates_hz: topic name to promised rate.
            start_s: now.
            motors: names in motor order, for people.
        """
        self._concerns = {
            name: (CONCERNS[name], rate_hz)
            for name, rate_hz in rates_hz.items()
            if name in CONCERNS and rate_hz > 0.0
        }
        self._start_s = start_s
        self._motors = motors

    def look(
        self,
        now_s: float,
        stamps_s: Mapping[str, float | None],
        *,
        body: BodyState | None,
        world: WorldState | None,
    ) -> Health:
        """Assess the robot.

        Args:
            now_s: the time of this tick.
            stamps_s: stamp of the newest message of each topic, None before the first.
            body: the newest body state.
            world: the newest world model.
        """
        findings: list[Finding] = []
        ages_s: dict[str, float] = {}
        for name, (concern, rate_hz) in self._concerns.items():
            stamp_s = stamps_s.get(name)
            ages_s[name] = round(now_s - (self._start_s if stamp_s is None else stamp_s), 4)
            finding = self._silence(name, concern, rate_hz, ages_s[name], came=stamp_s is not None)
            if finding is not None:
                findings.append(finding)
        if body is not None:
            findings += _body_findings(body, self._motors)
        if world is not None:
            findings += _world_findings(world, now_s)
        findings.sort(key=lambda finding: -finding.level)
        return Health(findings=tuple(findings), ages_s=ages_s)

    @staticmethod
    def _silence(
        name: str, concern: Concern, rate_hz: float, age_s: float, *, came: bool
    ) -> Finding | None:
        """What the age of a topic's newest message means; before the first one, wait for it."""
        if came and age_s <= max(concern.periods / rate_hz, concern.at_least_s):
            return None
        starting = not came and age_s <= START_UP_S
        text = f"waiting for {name}" if starting else f"{concern.text} for {age_s:.1f} s"
        level = Level.HOLD if starting else concern.level
        reason = failure(concern.code, text, topic=name, age_s=age_s, promised_hz=rate_hz)
        return Finding(name=name, level=level, failure=reason)


def _body_findings(body: BodyState, motors: Sequence[str]) -> list[Finding]:
    """What the body's own state says: a fall, a failure of the controller, hot motors."""
    findings: list[Finding] = []
    if body.mode == "fallen":
        reason = body.failure or failure("fallen", "the robot lies on the floor")
        findings.append(Finding(name="fall", level=Level.DAMP, failure=reason))
    elif body.failure is not None:
        findings.append(Finding(name="controller", level=Level.SIT, failure=body.failure))
    hottest_c = max(body.temperature_c, default=0.0)
    if hottest_c >= TEMPERATURE_WARM_C:
        tripped = hottest_c >= TEMPERATURE_TRIP_C
        index = body.temperature_c.index(hottest_c)
        motor = motors[index] if index < len(motors) else f"motor {index}"
        text = f"the {motor} motor is at {hottest_c:.0f} °C"
        reason = failure("overheated", text, motor=motor, temperature_c=round(hottest_c, 1))
        level = Level.SIT if tripped else Level.WARN
        findings.append(Finding(name="temperature", level=level, failure=reason))
    return findings


def _world_findings(world: WorldState, now_s: float) -> list[Finding]:
    """What the world model says of itself: how old the last absolute fix of the pose is."""
    age_s = world.fix_age_s + max(0.0, now_s - world.stamp_s)
    if age_s <= FIX_LATE_S:
        return []
    level = Level.HOLD if age_s > FIX_LOST_S else Level.WARN
    text = f"no fix of the robot's pose for {age_s:.1f} s"
    reason = failure("localisation_lost", text, fix_age_s=round(age_s, 3))
    return [Finding(name="localisation", level=level, failure=reason)]
