"""A robot at work: one runtime, one executive, one journal, and any number of jobs.

    with Session(runtime, planner, ...) as session:
        session.submit(understood)
        session.run()                    # until nothing is left to do
        session.submit(another)
        session.run(until=lambda: gone)  # or until somebody has had enough

`humanoid do`, missions and the prompt all work in a session. `run` belongs to one thread; jobs,
pauses and stops come through `session.executive` from any thread (`executive.engine.executive`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Self

import msgspec

from executive.engine import loop
from executive.engine.executive import Executive
from executive.engine.jobs import UNLIMITED, Limits
from executive.engine.recorder import Recorder
from executive.journal.journal import Journal
from executive.meaning.request import Understood
from executive.skills.context import SkillContext
from executive.skills.resources import needed_by
from executive.trees.build import build
from executive.trees.parts import errands
from intents.goals import to_builtins
from robot.bus.topics import TOPICS
from robot.closing import Closing
from robot.model.description import RobotDescription
from robot.planning.worker import Planner

RATES_HZ = {topic.name: topic.rate_hz for topic in TOPICS if topic.rate_hz}

OnTick = Callable[[], None]


class Session(Closing):
    """An executive on a runtime; a context manager that closes the journal."""

    def __init__(
        self,
        runtime: loop.Runtime,
        planner: Planner,
        *,
        description: RobotDescription,
        interrupts: loop.Interrupts,
        seed: int = 0,
        folder: Path | None = None,
        time_of_day: Callable[[], float] | None = None,
        journal: Journal | None = None,
    ) -> None:
        """Build the executive; nothing moves before a job is submitted and `run` called.

        Args:
            runtime: entered.
            planner: answers the skills' requests.
            description: of the robot.
            interrupts: looked at every tick.
            seed: of every planning request.
            folder: where the journal goes (None: it is kept in memory).
            time_of_day: for the journal's sibling file.
            journal: to use in place of a new one: a run is replayed, or gone on with.
        """
        self.runtime = runtime
        self.interrupts = interrupts
        live = isinstance(runtime, loop.Wakeable)  # no disk may hold it up
        self.journal = journal or Journal(folder, wall_s=time_of_day, background=live)
        context = SkillContext(
            link=runtime.link, planner=planner, description=description, seed=seed
        )
        self.holdings = context.holdings
        self.executive = Executive(context, self.journal, rates_hz=RATES_HZ)
        self._listeners: list[OnTick] = [Recorder(self.executive).update]
        self._open = ExitStack()

    def on_tick(self, listener: OnTick) -> None:
        """Call `listener` after every tick, in the thread of `run`."""
        self._listeners.append(listener)

    def submit(
        self,
        understood: Understood,
        *,
        urgent: bool = False,
        limits: Limits = UNLIMITED,
        origin: Mapping[str, Any] | None = None,
        done: frozenset[str] = frozenset(),
    ) -> int:
        """Queue a task; returns the job's number. From any thread.

        Args:
            understood: what a sentence asks for, or a task made otherwise.
            urgent: see `Executive.submit`.
            limits: what it may take.
            origin: what the task is made from, for the journal (default: the goals).
            done: paths of steps that are done already.
        """
        task, whereabouts = understood.task, msgspec.to_builtins(understood.whereabouts)
        made_from: dict[str, Any] = {
            "goals": to_builtins(understood.goals),
            **({"held": understood.held} if understood.held else {}),
            **({"whereabouts": whereabouts} if whereabouts is not None else {}),
        }
        return self.executive.submit(
            lambda stage: build(task, stage, done=done),
            text=understood.text,
            urgent=urgent,
            resources=needed_by(errand.params for errand in errands(task)),
            limits=limits,
            origin={**(origin or made_from), **({"done": sorted(done)} if done else {})},
        )

    def run(self, *, until: Callable[[], bool] | None = None) -> None:
        """Let time pass until nothing is left to do, or until `until` says so."""
        loop.run(
            self.runtime,
            self.executive,
            interrupts=self.interrupts,
            on_tick=self._tell,
            until=until,
        )

    def _tell(self) -> None:
        for listener in self._listeners:
            listener()

    def __enter__(self) -> Self:
        """Open the journal's files."""
        self._open.enter_context(self.journal)
        return self

    def close(self) -> None:
        """Close the journal."""
        self._open.close()
