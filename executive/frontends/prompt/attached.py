"""A robot that somebody else has set to work, spoken to beside that: what is asked for is queued.

Its run ends when nothing is left to do, as it would have without.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from typing import Any

from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNLIMITED, Limits
from executive.frontends.console.attending import attended
from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import low_base_m, nobody_counts
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.view import Observer, View
from executive.meaning.request import Understood
from executive.runs.session import Session
from intents.context import of_goals
from intents.goals import Goal
from robot.bringup.mailbox import Handle
from robot.clock import Clock, WallClock
from robot.failures import Failure


class Attached:
    """An `AtWork` on a session whose `run` is called by somebody else.

    Attributes:
        session, where, view, observer, interrupts, on_submit: as of any `AtWork`.
        ended_before: nothing is known of that.
    """

    ended_before: tuple[tuple[int, str, str], ...] = ()

    def __init__(self, session: Session, *, wall: Clock) -> None:
        """Look on after every tick of the session."""
        self.session = session
        self.where = session.setup.where
        self.view = View()
        self.observer = Observer(low_base_m=low_base_m(self.where.description))
        self.interrupts = session.interrupts
        self.on_submit: Callable[[int], None] = nobody_counts
        self._wall = wall
        self._faults: deque[dict[str, Any]] = deque()
        session.on_tick(self._look)

    @property
    def executive(self) -> Executive:
        """The executive of the session."""
        return self.session.executive

    @property
    def lost(self) -> Failure | None:
        """Why the robot is gone, None while it is there."""
        return self.session.runtime.failure()

    @property
    def busy(self) -> bool:
        """Whether a job is under way or waits."""
        return any(job.state not in OVER for job in self.executive.jobs)

    def submit(
        self,
        understood: Understood,
        *,
        urgent: bool = False,
        limits: Limits = UNLIMITED,
        origin: Mapping[str, Any] | None = None,
    ) -> int:
        """Queue a task, as `Session.submit` does; returns its number."""
        number = self.session.submit(understood, urgent=urgent, limits=limits, origin=origin)
        self.on_submit(number)
        return number

    def inject(self, fault: dict[str, Any]) -> None:
        """Let a fault happen with the next tick; `executive.runs.faults.verify` it first."""
        self._faults.append(fault)

    def wait(self, *, poll_s: float = 0.02, asked: bool = False) -> None:
        """Return when nothing is left to do, the robot is gone, or waits to be told to go on.

        With `asked` also when it asks a person for help.
        """
        while self.busy and self.lost is None and not self.executive.awaits_operator:
            if asked and self.executive.awaits_help:
                return
            time.sleep(poll_s)

    def _look(self) -> None:
        while self._faults:
            self.session.faults.strike(self._faults.popleft(), self.session.now_s)
        self.view = self.observer.look(
            self.executive, now_s=self.session.now_s, wall_s=self._wall.now_s()
        )


@contextmanager
def attached(
    session: Session,
    handle: Handle | None,
    out: Callable[[str], None],
    goals: tuple[Goal, ...] = (),
) -> Generator[None]:
    """Let pages steer a session that somebody else runs, inside the block.

    Args:
        session: of a run that has a folder, or nobody finds it.
        handle: of a live robot.
        out: says a line to people.
        goals: that the session was asked for: "now the blue one" goes on from them.
    """
    folder = session.setup.folder
    if folder is None:
        yield
        return
    robot = Attached(session, wall=WallClock())
    shell = Shell(robot, out, table=table.commands, folder=folder)
    shell.dialogue.context = of_goals(goals)
    with attended(shell, folder, handle):
        yield
