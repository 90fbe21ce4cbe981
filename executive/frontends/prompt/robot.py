"""The robot behind the prompt: a session in a thread of its own, and what can be asked of it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNLIMITED, Limits
from executive.engine.loop import Interrupts, Runtime
from executive.frontends.prompt.continuation import return_to
from executive.frontends.prompt.view import Observer, View, view_of_lost
from executive.journal.journal import Event, Journal, read
from executive.meaning.request import Setting, Understood
from executive.runs import run_folder
from executive.runs.faults import Injector, SlowPlanner
from executive.runs.session import Session
from robot.clock import Clock
from robot.closing import Closing
from robot.errors import Failure, ProcessError
from robot.planning.worker import Planner

Opened = Callable[[], AbstractContextManager[tuple[Runtime, Planner]]]
LEAVE_S = 20.0
"""How long leaving may take: the robot comes to a stand first."""


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
    """

    session: Session

    def __init__(
        self,
        opened: Opened,
        *,
        where: Setting,
        seed: int,
        folder: Path,
        wall: Clock,
        time_of_day: Callable[[], float],
        idles: bool,
        returning: bool = False,
        left_by: Path | None = None,
    ) -> None:
        """Start nothing yet.

        Args:
            opened: opens the runtime and its planner.
            where: robot and world.
            seed: of every planning request.
            folder: of the run, for the journal.
            wall: for the pace shown.
            time_of_day: for the journal's sibling file.
            idles: whether time passes while there is nothing to do (`live`).
            returning: whether an executive before this one died in this run: its jobs go on.
            left_by: folder of a run that was cut off with its robot: its jobs go on here.
        """
        self.where = where
        self.view = View()
        self.observer = Observer()
        self.interrupts = Interrupts()
        self._opened = opened
        self._seed = seed
        self._folder = folder
        self._wall = wall
        self._time_of_day = time_of_day
        self._idles = idles
        self._returning = returning
        self._left_by = left_by
        self._up = threading.Event()
        self._wake = threading.Event()
        self._leaving = threading.Event()
        self._error: BaseException | None = None
        self._faults: deque[dict[str, Any]] = deque()
        self._thread = threading.Thread(target=self._live, name="robot", daemon=True)

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
        self._wake.set()
        return number

    def inject(self, fault: dict[str, Any]) -> None:
        """Let a fault happen with the next tick; `executive.runs.faults.verify` it first."""
        self._faults.append(fault)

    def wait(self, *, poll_s: float = 0.02) -> None:
        """Return when nothing is left to do, or the robot is gone."""
        while self.busy and self._thread.is_alive() and self.lost is None:
            self._leaving.wait(poll_s)

    # --- the thread ---

    def _live(self) -> None:
        try:
            with self._opened() as (runtime, planner):
                self._work(runtime, planner)
        except BaseException as error:  # told to whoever entered, or leaves
            self._error = error
        finally:
            self._up.set()

    def _work(self, runtime: Runtime, planner: Planner) -> None:
        slow = SlowPlanner(planner)
        before = read(self._folder) if self._returning else []
        first = before[-1].n + 1 if before else 0
        session = Session(
            runtime,
            slow,
            description=self.where.description,
            interrupts=self.interrupts,
            seed=self._seed,
            journal=Journal(
                self._folder, wall_s=self._time_of_day, background=self._idles, first=first
            ),
        )
        session.executive.attended = True
        self._injector = Injector(
            (), runtime, session.journal, begin_s=runtime.clock.now_s(), planner=slow
        )
        session.on_tick(self._look)
        with session:
            self.session = session
            self._begin(before)
            self._up.set()
            while not self._over():
                if self._idles:
                    session.run(until=self._over)
                elif self.busy:
                    session.run()
                else:
                    self._wake.wait(0.1)
                    self._wake.clear()
            lost = runtime.failure()
            self.view = self.view if lost is None else view_of_lost(self.view, lost)

    def _begin(self, before: list[Event]) -> None:
        """Open the journal of a new run; in one that is returned to, go on with its jobs."""
        now_s = self.session.runtime.clock.now_s()
        if before:
            return_to(self.session, before, where=self.where, folder=self._folder)
            return
        runtime = "live" if self._idles else "fast"
        header = run_folder.header(
            self.where, text="prompt", seed=self._seed, runtime=runtime, attended=True
        )
        run_folder.begin(self.session.journal, header, now_s=now_s, folder=self._folder)
        if self._left_by is not None:
            run_folder.carry_missions_over(self._left_by, self._folder)
            return_to(
                self.session, read(self._left_by), where=self.where, folder=self._left_by, anew=True
            )

    def _over(self) -> bool:
        gone = self.session.runtime.failure() is not None
        return gone or (self._leaving.is_set() and not self.busy)

    def _look(self) -> None:
        now_s = self.session.runtime.clock.now_s()
        while self._faults:
            self._injector.strike(self._faults.popleft(), now_s)
        self._injector.tick(now_s)
        self.view = self.observer.look(self.executive, now_s=now_s, wall_s=self._wall.now_s())

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
        if self.busy and self.lost is None:
            self.executive.stop("the operator leaves")
        self._leaving.set()
        self._wake.set()
        self._thread.join(LEAVE_S)
        if self._thread.is_alive():
            raise ProcessError(f"the robot did not come to rest within {LEAVE_S:.0f} s")
        if self._error is not None:
            raise self._error
