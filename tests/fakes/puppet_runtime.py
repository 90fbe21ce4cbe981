"""A runtime whose robot is a puppet: the whole executive without physics or processes."""

from __future__ import annotations

from dataclasses import dataclass, field

from robot import messages as m
from robot.failures import Failure
from tests.fakes.oracle_planner import RulePlanner
from tests.fakes.puppet import TICK_S, Puppet


@dataclass
class SensingPuppet(Puppet):
    """A puppet whose sensors answer."""

    def lidar(self) -> m.LidarScan:
        return m.LidarScan(stamp_s=self.time_s, angle_min_rad=0, angle_step_rad=1, ranges_m=())

    def depth(self) -> m.DepthImage:
        return m.DepthImage(stamp_s=self.time_s, width=0, height=0, fovy_rad=1, depth_m=b"")


class PuppetClock:
    """The puppet's time."""

    def __init__(self, puppet: Puppet) -> None:
        self._puppet = puppet

    def now_s(self) -> float:
        return self._puppet.time_s

    def sleep_until(self, time_s: float) -> None:
        raise AssertionError("nothing sleeps here")


@dataclass
class PuppetRuntime:
    """Advances a puppet; `at` calls something when a time has come."""

    puppet: Puppet
    planner: RulePlanner = field(default_factory=RulePlanner)
    at: list[tuple[float, object]] = field(default_factory=list)
    lost: Failure | None = None

    def __post_init__(self) -> None:
        self.clock = PuppetClock(self.puppet)
        self.link = self.puppet

    def advance(self, duration_s: float) -> None:
        for _ in range(round(duration_s / TICK_S)):
            self.puppet.tick()
            while self.at and self.at[0][0] <= self.puppet.time_s:
                self.at.pop(0)[1]()  # type: ignore

    def failure(self) -> Failure | None:
        return self.lost
