"""A small kitchen with a puppet in it, and how to run a skill there."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from executive.skills.catalogue import make
from executive.skills.context import SkillContext
from executive.skills.parameters import SkillParams
from executive.skills.skill import Skill, SkillReport
from robot import messages as m
from robot.model.description import load
from robot.se3 import SE3
from tests.fakes.oracle_planner import RulePlanner
from tests.fakes.puppet import Puppet, Thing

DESCRIPTION = load("juno")
TABLE_M = 0.7


def kitchen() -> m.WorldMap:
    """A table with a cup, a counter beside it, a floor spot, a person."""

    def surface(name: str, x_m: float, y_m: float) -> m.Place:
        X_WP = SE3((x_m, y_m, TABLE_M))
        return m.Place(id=name, name=name, X_WP=X_WP, size_m=(0.6, 1.0), of=name)

    shape = m.Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
    return m.WorldMap(
        stamp_s=0.0,
        name="test kitchen",
        obstacles=(),
        places=(
            surface("table", 2.0, 0.0),
            surface("counter", 2.0, 2.5),
            m.Place(id="door", name="door", X_WP=SE3((-1, 1, 0)), size_m=(0.5, 0.5), floor=True),
        ),
        objects=(
            m.ObjectInfo(
                id="cup", name="red cup", category="cup", color="red", shape=shape, mass_kg=0.2
            ),
        ),
        people=(m.PersonInfo(id="ann", name="Ann", X_WO=SE3((0.0, 3.0, 0.0))),),
        categories={},
        bounds_m=(-3, -3, 4, 4),
    )


@dataclass
class Stage:
    """A puppet, a planner, and the reports of the last run."""

    puppet: Puppet = field(
        default_factory=lambda: Puppet(
            DESCRIPTION,
            {"cup": Thing("cup", SE3((1.8, 0.1, TABLE_M + 0.05)), seen_s=0.0)},
            kitchen(),
        )
    )
    planner: RulePlanner = field(default_factory=RulePlanner)
    said: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.context = SkillContext(
            link=self.puppet,
            planner=self.planner,
            description=self.puppet.description,
            say=self.said.append,
        )

    def make(self, parameters: SkillParams) -> Skill:
        return make(parameters, self.context)

    def run(
        self, parameters: SkillParams, *, limit_s: float = 200.0, until_phase: str | None = None
    ) -> SkillReport:
        """Run a skill to its end, or until its phase begins with some words."""
        self.skill = self.make(parameters)
        self.skill.start(self.puppet.time_s)
        self.phases: list[str] = []
        end_s = self.puppet.time_s + limit_s
        while self.puppet.time_s < end_s:
            self.puppet.tick()
            report = self.skill.step(self.puppet.time_s)
            if not self.phases or self.phases[-1] != report.phase:
                self.phases.append(report.phase)
            if report.status != "running":
                return report
            if until_phase is not None and report.phase.startswith(until_phase):
                return report
        raise AssertionError(f"still {report.phase!r} after {limit_s} s")

    def stop(self, *, limit_s: float = 10.0) -> SkillReport:
        """Stop the skill under way and wait until it is over."""
        end_s = self.puppet.time_s + limit_s
        while self.puppet.time_s < end_s:
            report = self.skill.stop(self.puppet.time_s)
            if report.status != "running":
                return report
            self.puppet.tick()
        raise AssertionError("it does not stop")

    def commands(self, kind: type) -> list:
        return [command for command in self.puppet.sent if isinstance(command, kind)]


def distance_m(X_WA: SE3, X_WB: SE3) -> float:
    return math.dist(X_WA.p, X_WB.p)
