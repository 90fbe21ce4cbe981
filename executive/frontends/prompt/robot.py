"""The robot behind the prompt: a session in a thread of its own, and what can be asked of it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNLIMITED, Limits
from executive.engine.loop import Interrupts
from executive.frontends.prompt.view import Observer, View, view_of_lost
from executive.meaning.request import Setting, Understood
from executive.runs import runtimes
from executive.runs.again.continuation import Left, return_to
from executive.runs.again.orders import orders_in
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from robot.bringup.mailbox import Handle
from robot.clock import Clock
from robot.closing import Closing
from robot.errors import ProcessError
from robot.failures import Failure
from robot.model.description import RobotDescription

CRIED = "the operator cried to halt"
"""Why it is paused that has halted for a cry."""
LEAVE_S = 20.0
"""How long leaving may take: the robot comes to a stand first."""


def nobody_counts(_number: int) -> None:
    """Note no job."""


class AtWork(Protocol):
    """A robot that is up and can be spoken to, whoever lets its time pass; from any thread.

    Attributes:
        session: with its executive.
        where: robot and world.
        view: the newest view.
        observer: set `observer.tree_wanted` to have the tree in the views.
        interrupts: counts signals.
        on_submit: is called with the number of every job, in the thread that asked for it.
    """

    session: Session
    where: Setting
    view: View
    observer: Observer
    interrupts: Interrupts
    on_submit: Callable[[int], None]

    @property
    def executive(self) -> Executive:
        """The executive of the session."""
        ...

    @property
    def ended_before(self) -> tuple[tuple[int, str, str], ...]:
        """The jobs of this run that were over before this executive took its place."""
        ...

    @property
    def lost(self) -> Failure | None:
        """Why the robot is gone, None while it is there."""
        ...

    @property
    def busy(self) -> bool:
        """Whether a job is under way or waits."""
        ...

    def submit(
        self,
        understood: Understood,
        *,
        urgent: bool = False,
        limits: Limits = UNLIMITED,
        origin: Mapping[str, Any] | None = None,
    ) -> int:
        """Queue a task, as `Session.submit` does; returns its number."""
        ...

    def inject(self, fault: dict[str, Any]) -> None:
        """Let a fault happen with the next tick; `executive.runs.faults.verify` it first."""
        ...

    def wait(self, *, poll_s: float = 0.02, asked: bool = False) -> None:
        """Return when nothing is left to do, the robot is gone, or waits to be told to go on.

        With `asked` also when it asks a person for help.
        """
        ...


class Robot(Closing):
    """A context manager: the robot is up inside, and at rest and gone afterwards.

    The thread that opens the runtime also ticks the executive and closes the runtime. Every
    method may be called from any thread.

    Attributes:
        session: the session, from entering on.
        where: robot and world.
        view: the newest view.
        observer: set `observer.tree_wanted` to have the tree in the views.
        interrupts: counts signals; whoever leaves on them listens.
        on_submit: as of any `AtWork`.
    """

    session: Session

    def __init__(
        self,
        setup: Setup,
        *,
        wall: Clock,
        time_of_day: Callable[[], float],
        handle: Handle | None = None,
        left: Left | None = None,
    ) -> None:
        """Start nothing yet.

        Args:
            setup: of the run; in `live`, time passes while there is nothing to do.
            wall: for the pace shown.
            time_of_day: for the journal's sibling file.
            handle: of a live run whose processes the process above looks after.
            left: by a run that was cut off, or by an executive before this one: its jobs go on.
        """
        self.where = setup.where
        self.view = View()
        self.observer = Observer(low_base_m=low_base_m(setup.where.description))
        self.interrupts = Interrupts()
        self.on_submit: Callable[[int], None] = nobody_counts
        self._setup = setup
        self._wall = wall
        self._time_of_day = time_of_day
        self._idles = setup.kind == "live"
        self._handle = handle
        self._left = left
        self._up = threading.Event()
        self._wake = threading.Event()
        self._leaving = threading.Event()
        self._admits = threading.Lock()
        self._error: BaseException | None = None
        self._faults: deque[dict[str, Any]] = deque()
        self._thread = threading.Thread(target=self._live, name="robot", daemon=True)

    @property
    def executive(self) -> Executive:
        """The executive of the session."""
        return self.session.executive

    @property
    def ended_before(self) -> tuple[tuple[int, str, str], ...]:
        """The jobs of this run that were over before this executive took its place."""
        left = self._left
        returned = left is not None and left.folder == self._setup.folder
        return left.ended if left is not None and returned else ()

    @property
    def halted_before(self) -> bool:
        """Whether it was halted when this executive took the place of one that died."""
        left = self._left
        returned = left is not None and left.folder == self._setup.folder
        return left is not None and returned and orders_in(left.events).paused == CRIED

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
        """Queue a task, as `Session.submit` does; returns its number.

        Raises:
            ProcessError: the robot is being closed, and a job would keep it from its end.
        """
        with self._admits:
            if self._leaving.is_set():
                raise ProcessError("the robot comes to its end, and nothing begins any more")
            number = self.session.submit(understood, urgent=urgent, limits=limits, origin=origin)
        self.on_submit(number)
        self._wake.set()
        return number

    def inject(self, fault: dict[str, Any]) -> None:
        """Let a fault happen with the next tick; `executive.runs.faults.verify` it first."""
        self._faults.append(fault)

    def wait(self, *, poll_s: float = 0.02, asked: bool = False) -> None:
        """Return when nothing is left to do, the robot is gone, or waits to be told to go on.

        With `asked` also when it asks a person for help.
        """
        while self.busy and self._thread.is_alive() and self.lost is None:
            if self.executive.awaits_operator or (asked and self.executive.awaits_help):
                return
            self._leaving.wait(poll_s)

    # --- the thread ---

    def _live(self) -> None:
        try:
            with runtimes.opened(self._setup, handle=self._handle) as robot:
                self._work(robot)
        except BaseException as error:  # told to whoever entered, or leaves
            self._error = error
        finally:
            self._up.set()

    def _work(self, robot: Opened) -> None:
        left = self._left if self._left is not None and self._left.events else None
        returns = left is not None and left.folder == self._setup.folder
        with Session(
            self._setup,
            robot,
            interrupts=self.interrupts,
            time_of_day=self._time_of_day,
            first=left.next_number if left is not None and returns else 0,
            jobs_before=left.jobs if left is not None and returns else 0,
            attended=True,
        ) as session:
            self.session = session
            session.on_tick(self._look)
            if not returns:
                session.begin("prompt")
            if left is not None:
                return_to(session, left)
            self._up.set()
            while not self._over():
                if self._idles:
                    session.run(until=self._over)
                elif self.busy:
                    session.run()
                else:
                    self._wake.wait(0.1)
                    self._wake.clear()
                    if self.executive.health.level != self.view.level:
                        self._see()  # the emergency stop acts without a tick, too
            lost = robot.runtime.failure()
            self.view = self.view if lost is None else view_of_lost(self.view, lost)

    def _over(self) -> bool:
        gone = self.session.runtime.failure() is not None
        return gone or (self._leaving.is_set() and not self.busy)

    def _look(self) -> None:
        now_s = self.session.now_s
        while self._faults:
            self.session.faults.strike(self._faults.popleft(), now_s)
        self._see()

    def _see(self) -> None:
        now_s, wall_s = self.session.now_s, self._wall.now_s()
        self.view = self.observer.look(self.executive, now_s=now_s, wall_s=wall_s)

    # --- entering and leaving ---

    def __enter__(self) -> Robot:
        """Wait until the robot is up. Raises what kept it from that."""
        self._thread.start()
        self._up.wait()
        if self._error is not None:
            raise self._error
        return self

    def close(self) -> None:
        """Bring the robot to rest, and close everything."""
        with self._admits:
            self._leaving.set()
        if self.busy and self.lost is None:
            self.executive.stop("the operator leaves")
        self._wake.set()
        self._thread.join(LEAVE_S)
        if self._thread.is_alive():
            raise ProcessError(f"the robot did not come to rest within {LEAVE_S:.0f} s")
        if self._error is not None:
            raise self._error


def low_base_m(robot: RobotDescription) -> float:
    """A base below this is that of a squat: half way down to it."""
    return 0.5 * (robot.balance.squat_base_m + robot.walking.base_height_m)
