"""The skill contract on top of two scripts: what to do, and how to come to rest.

When a script fails or is stopped, the body is brought to rest before the report says that it is
over; so a failed skill, too, leaves the robot standing.
"""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from typing import Generic, TypeVar

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.body_access import Body
from executive.skills.motions.rest import come_to_rest
from executive.skills.motions.script import GaveUp, Script
from executive.skills.parameters import SkillParams
from executive.skills.skill import Resource, SkillReport
from robot.failures import Failure, failure
from robot.messages import WorldMap
from robot.model.description import RobotDescription

BEYOND_HELP = ("fallen", "lost_balance", "sensor_silent")
"""Failures after which the body cannot be brought to rest by commands."""

P = TypeVar("P", bound=SkillParams)

log = logging.getLogger(__name__)


class ScriptedSkill(ABC, Generic[P]):
    """The skill contract (`executive.skills.skill.Skill`) on top of two scripts.

    Subclasses write `script` (what to do) and may write `halt` (how to come to rest).

    Attributes:
        name: what the skill is called, as its file.
        summary: what it does, in one line for people.
        takes: its parameters.
        resources: the parts of the body that it takes at most.
    """

    name: str
    summary: str
    takes: type[P]
    resources: frozenset[Resource]

    def __init__(self, parameters: P, context: SkillContext) -> None:
        """Prepare; nothing moves before `start`."""
        self.parameters = parameters
        self.context = context
        self.resources = self.needs(parameters)
        self.body = Body(context)
        self._running: Script[None] | None = None
        self._ended: Failure | None = None
        self._halting = False
        self._report = SkillReport(status="running", phase="not started")

    @classmethod
    def needs(cls, wanted: P) -> frozenset[Resource]:
        """The parts of the body that it takes for these parameters."""
        return cls.resources

    @classmethod
    def lack(cls, wanted: P, robot: RobotDescription) -> str:
        """What a robot has no body for, in words that follow its name; empty if nothing."""
        del wanted, robot
        return ""

    @classmethod
    def refusal(
        cls,
        wanted: P,
        world_map: WorldMap,
        robot: RobotDescription,
    ) -> Failure | None:
        """Why this cannot work wherever things turn out to stand; None: nothing speaks against it.

        What depends on where they stand is found out by the planners. Below it stand the limits in
        the controller.
        """
        return None

    @classmethod
    @abstractmethod
    def forecast(cls, wanted: P, outlook: Outlook) -> Forecast:
        """What this would take; leaves the outlook as the step leaves the world."""

    @abstractmethod
    def script(self) -> Script[None]:
        """What the skill does."""

    def halt(self) -> Script[None]:
        """How the body comes to rest when the skill fails or is stopped."""
        yield from come_to_rest(self.body, self.resources)

    def start(self, now_s: float) -> None:
        """Begin; the first step does the first work."""
        if self._running is None and self._report.status == "running":
            self.body.now_s = now_s
            self._running = self.script()

    def step(self, now_s: float) -> SkillReport:
        """Go on until the script has to wait."""
        if self._report.status != "running":
            return self._report
        if self._running is None:
            self.start(now_s)
        self.body.now_s = now_s
        self._report = self._resume()
        return self._report

    def stop(self, now_s: float) -> SkillReport:
        """Leave the script and bring the body to rest; call again until it is done."""
        if self._report.status != "running":
            return self._report
        if self._running is None:
            self._report = self._over(failure("cancelled", "stopped before it began"))
        elif not self._halting:
            self._leave(failure("cancelled", f"stopped while {self.body.phase or 'starting'}"))
        return self.step(now_s)

    def _resume(self) -> SkillReport:
        """Run to the next wait; a script that ends badly goes on as the halting one."""
        assert self._running is not None
        try:
            next(self._running)
        except StopIteration:
            return self._over(self._ended)
        except GaveUp as end:
            return self._fail(end.failure)
        except Exception as error:  # a bug must end this skill, not the tick loop
            log.exception("skill %s broke while %s", type(self).__name__, self.body.phase)
            return self._fail(failure("internal", f"{type(error).__name__}: {error}"))
        return SkillReport(
            status="running", phase=self.body.phase, progress=round(self.body.progress, 3)
        )

    def _fail(self, reason: Failure) -> SkillReport:
        if self._halting or reason.code in BEYOND_HELP:
            return self._over(self._ended or reason)
        self._leave(reason)
        return self._resume()

    def _leave(self, reason: Failure) -> None:
        """Close the script (its `finally` clauses run) and go on with the halting one."""
        assert self._running is not None
        self._running.close()
        self._ended = reason
        self._halting = True
        self._running = self.halt()

    def _over(self, reason: Failure | None) -> SkillReport:
        if reason is None:
            return SkillReport(status="succeeded", phase="done", progress=1.0)
        return SkillReport(
            status="failed",
            phase=self.body.phase,
            progress=round(self.body.progress, 3),
            failure=reason,
        )
