"""The first leaf of every tick: the newest messages onto the blackboard."""

from __future__ import annotations

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.ask import ANSWERS
from executive.behaviours.stage import Stage, beginning_data, failure_data
from executive.blackboard import (
    BODY,
    GIVEN,
    HEALTH,
    HEARD,
    HELD,
    HOME,
    MAP,
    NOW,
    SPEED_LIMIT,
    TAKEN_FROM,
    WORLD,
)
from executive.engine.handled import Handled
from executive.engine.health_monitor import HealthMonitor
from executive.engine.reminder import Reminder
from executive.health import Finding, Health, Level
from executive.skills.hearing import Hearing
from executive.skills.holding import Held, Holdings
from robot.link import BodyLink
from robot.messages import BodyState, Side

HEAT_STEP_C = 5.0
"""By so much a motor gets hotter or cooler before that is journalled again."""


def _stamp(message: object) -> float | None:
    return getattr(message, "stamp_s", None)


class Sense(Behaviour):
    """Reads the link once a tick; always RUNNING."""

    def __init__(
        self,
        stage: Stage,
        link: BodyLink,
        monitor: HealthMonitor,
        *,
        holdings: Holdings,
        hearing: Hearing,
    ) -> None:
        """Become the writer of everything that is sensed."""
        super().__init__("sense")
        self._stage = stage
        self._link = link
        self._monitor = monitor
        self._holdings = holdings
        self._hearing = hearing
        self._handled = Handled(holdings)
        self._reminder = Reminder(link, holdings)
        self._board = stage.board.claim("sense")
        self._health = Health()
        self._held: tuple[Held, ...] = ()
        self._pulls: dict[Side, int] = {}
        self._told_c: dict[str, float] = {}

    def at(self, now_s: float) -> None:
        """Set the time of the tick that comes."""
        self._board.set(NOW, now_s)

    def update(self) -> Status:
        """Put the newest of everything on the board."""
        link, board = self._link, self._board
        body, world = link.body(), link.world()
        board.set(BODY, body)
        board.set(WORLD, world)
        board.set(MAP, link.map())
        if self._stage.board.read(HOME) is None and body is not None and world is not None:
            board.set(HOME, (world.X_WN @ body.X_NS).flat())
        self._feel()
        self._reminder.look(body, self._stage.now_s)
        self._notice_pulls(body)
        self._hear()
        stamps_s = {
            "body/state": _stamp(body),
            "world/state": _stamp(world),
            "sensors/lidar": _stamp(link.lidar()),
            "sensors/depth": _stamp(link.depth()),
        }
        health = self._monitor.look(
            self._stage.now_s,
            stamps_s,
            body=body,
            world=world,
            camera=link.camera(),
            power=link.power(),
            timing=link.timing(),
        )
        board.set(HEALTH, health)
        board.set(SPEED_LIMIT, health.speed_m_s)
        self._journal(health)
        worst = health.failure
        self.feedback_message = worst.cause if worst else "all is well"
        return Status.RUNNING

    def _feel(self) -> None:
        """What the hands hold; how, is journalled for an executive that comes after this one."""
        held, board = self._holdings.all(), self._stage.board
        self._board.set(HELD, {one.side: one.object_id for one in held})
        self._handled.look(board.read(WORLD), board.read(MAP))
        self._board.set(GIVEN, self._handled.given)
        self._board.set(TAKEN_FROM, self._handled.taken_from)
        if held != self._held:
            self._held = held
            hands = {one.side: msgspec.to_builtins(one) for one in held}
            self._stage.record("held", hands=hands)

    def _notice_pulls(self, body: BodyState | None) -> None:
        """Journal that something was about to slip out of a hand."""
        for side, hand in body.hands.items() if body else ():
            if hand.pulls > self._pulls.get(side, 0):
                self._stage.record("slip", side=side)
            self._pulls[side] = hand.pulls

    def _hear(self) -> None:
        """Journal what people say; it answers the open question if it can be an answer to it."""
        for heard in self._link.heard():
            self._hearing.note(heard)
            simulated = heard.source == "oracle"
            self._stage.record("heard", who=heard.person_id, text=heard.text, simulated=simulated)
            desk = self._stage.help
            if desk.asker is not None and desk.answer is None and heard.text in ANSWERS:
                desk.answer = heard.text
        self._board.set(HEARD, self._hearing.newest())

    def _journal(self, health: Health) -> None:
        """Journal what has come up or gone away since the last tick."""
        before = {_kind(finding) for finding in self._health.findings}
        for finding in health.findings:
            heat_c = _heat_c(finding)
            told_c = self._told_c.get(finding.name, heat_c)
            is_new = _kind(finding) not in before
            if is_new or abs(heat_c - told_c) >= HEAT_STEP_C:
                self._told_c[finding.name] = heat_c
                self._stage.record(
                    "health",
                    name=finding.name,
                    level=finding.level.name,
                    **failure_data(finding.failure),
                    **beginning_data(finding.beginning),
                )
        after = {finding.name for finding in health.findings}
        for finding in self._health.findings:
            if finding.name not in after:
                self._stage.record(
                    "health",
                    name=finding.name,
                    level=Level.OK.name,
                    **beginning_data(finding.beginning),
                )
        self._health = health


def _kind(finding: Finding) -> tuple[str, Level, bool]:
    """What has to change about a finding to be news."""
    return finding.name, finding.level, finding.beginning


def _heat_c(finding: Finding) -> float:
    """The temperature that a finding is about; 0 if it is about none."""
    heat_c = finding.failure.evidence.get("temperature_c")
    return float(heat_c) if isinstance(heat_c, int | float) else 0.0


class WindDown(Behaviour):
    """Sees interrupted skills through until the body is at rest; always RUNNING."""

    def __init__(self, stage: Stage) -> None:
        """Watch over the stage's skills."""
        super().__init__("come to rest")
        self._stage = stage

    def update(self) -> Status:
        """Go on with whatever is coming to rest."""
        self.feedback_message = "" if self._stage.wind_down() else "stopping"
        return Status.RUNNING
