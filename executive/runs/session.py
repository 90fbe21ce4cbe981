"""A robot at work: one runtime, one executive, one journal, and any number of jobs.

    with runtimes.opened(setup) as robot, Session(setup, robot) as session:
        session.begin("what it is about")
        session.submit(understood)
        session.run()                    # until nothing is left to do
        session.submit(another)
        session.run(until=lambda: gone)  # or until somebody has had enough

Sentences, missions, the prompt, replays and evaluations all work in a session. `run` belongs to one
thread; jobs, pauses and stops come through `session.executive` from any thread
(`executive.engine.executive`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import msgspec

from executive.engine import loop
from executive.engine.executive import Executive
from executive.engine.jobs import UNLIMITED, Limits
from executive.engine.motion_watch import MotionWatch
from executive.engine.recorder import Recorder
from executive.engine.sensed_watch import SensedWatch
from executive.engine.teleoperation import Teleoperation
from executive.engine.told_planner import ToldPlanner
from executive.journal import motion, sensed
from executive.journal.files import BackgroundFile, LineFile, Lines, Nowhere
from executive.journal.journal import FILE as JOURNAL_FILE
from executive.journal.journal import Journal
from executive.meaning.request import Understood
from executive.missions.fault_plans import FaultPlan
from executive.runs import run_folder
from executive.runs.faults import Injector, SlowPlanner
from executive.runs.runtimes import Opened, Setup
from executive.skills.context import SkillContext
from executive.skills.resources import queued_for
from executive.trees.build import build
from executive.trees.parts import errands
from intents.goals import to_builtins
from robot import shots
from robot.bus.topics import TOPICS
from robot.closing import Closing
from robot.planning.requests import PlanRequest, PlanResult

MOST_MOMENTS_WAITING = 1200
"""Of lines of `motion.jsonl` for a disk that takes none: a minute."""

RATES_HZ = {topic.name: topic.rate_hz for topic in TOPICS if topic.rate_hz}

OnTick = Callable[[], None]


class Session(Closing):
    """An executive on a runtime; a context manager that closes the journal.

    Attributes:
        setup: what the run is set up with.
        runtime: the robot's.
        interrupts: looked at every tick.
        journal: of the run.
        faults: lets things go wrong on purpose.
        executive: at work.
        teleoperation: by which it is driven by hand while the executive has nothing to do.
    """

    executive: Executive
    teleoperation: Teleoperation

    def __init__(
        self,
        setup: Setup,
        robot: Opened,
        *,
        interrupts: loop.Interrupts | None = None,
        journal: Journal | None = None,
        time_of_day: Callable[[], float] | None = None,
        first: int = 0,
        jobs_before: int = 0,
        faults: tuple[FaultPlan, ...] = (),
        kill: Callable[[], None] | None = None,
        attended: bool = False,
    ) -> None:
        """Build the executive; nothing moves before a job is submitted and `run` called.

        Args:
            setup: of the run.
            robot: that is up.
            interrupts: of somebody who listens to signals; by default nobody does.
            journal: to use in place of a new one in the run's folder.
            time_of_day: for the journal's sibling file.
            first: number of the journal's first event, where it is gone on with.
            jobs_before: the highest number of a job in that journal.
            faults: what goes wrong on purpose.
            kill: what it means to kill the executive, see `Injector`.
            attended: whether a person is there, to ask for more and to help.
        """
        self.setup = setup
        self.runtime = robot.runtime
        self.interrupts = interrupts or loop.Interrupts()
        live = isinstance(robot.runtime, loop.Wakeable)  # no disk may hold it up
        self.journal = journal or Journal(
            setup.folder, wall_s=time_of_day, background=live, first=first
        )
        self._motion = _lines(setup, motion.FILE, background=live)
        self._sensed = _lines(setup, sensed.FILE, background=live)
        self._depths = _lines(setup, shots.DEPTH_FILE, background=live)
        self._planner = SlowPlanner(robot.planner)
        self.faults = Injector(
            faults, robot.runtime, self.journal, begin_s=self.now_s, seed=setup.seed,
            planner=self._planner, kill=kill,
        )  # fmt: skip
        self._listeners: list[OnTick] = []
        self._attended = attended
        self.replace_executive(jobs_before=jobs_before)

    @property
    def now_s(self) -> float:
        """The runtime's time."""
        return self.runtime.clock.now_s()

    def replace_executive(self, *, jobs_before: int = 0) -> None:
        """Put a new executive in the place of one that is gone; it knows nothing of the past.

        `jobs_before` is the highest number that a job has had.
        """
        context = SkillContext(
            link=self.runtime.link,
            planner=ToldPlanner(self._planner, self._hear_plan),
            description=self.setup.where.description,
            seed=self.setup.seed,
        )
        self.holdings = context.holdings
        self.executive = Executive(
            context, self.journal, rates_hz=RATES_HZ, jobs_before=jobs_before
        )
        self.executive.attended = self._attended
        self.teleoperation = Teleoperation(self.executive, context)
        self._recorder = Recorder(self.executive)
        after_s = motion.last_s(self.setup.folder) if self.setup.folder else -math.inf
        self._mover = MotionWatch(self.executive.board, context.link, self._motion, after_s=after_s)
        self._watcher = SensedWatch(
            self.executive.board, context.link, context.description,
            lines=self._sensed, depths=self._depths, after_s=after_s,
        )  # fmt: skip

    def begin(self, text: str) -> None:
        """Write what the run is started with into its folder, and as the journal's first event."""
        header = run_folder.header(self.setup, text=text, attended=self._attended)
        if self.setup.folder is not None:
            run_folder.save(self.setup.folder, "run.json", header)
        self.journal.write(self.now_s, "run", **msgspec.to_builtins(header))

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
        number: int | None = None,
    ) -> int:
        """Queue a task; returns the job's number. From any thread.

        Args:
            understood: what a sentence asks for, or a task made otherwise.
            urgent: see `Executive.submit`.
            limits: what it may take.
            origin: what the task is made from, for the journal (default: the goals).
            done: paths of steps that are done already.
            number: of a job that is gone on with.
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
            resources=queued_for(errand.params for errand in errands(task)),
            limits=limits,
            origin={**(origin or made_from), **({"done": sorted(done)} if done else {})},
            number=number,
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
        self.teleoperation.update(self.now_s)
        self._recorder.update()
        self._mover.update(self.now_s)
        self._watcher.update(self.now_s)
        self.faults.tick(self.now_s)
        for listener in self._listeners:
            listener()

    def _hear_plan(self, request: PlanRequest, result: PlanResult) -> None:
        self._watcher.planned(request, result)

    def unwritten(self) -> tuple[str, ...]:
        """What the run's folder lacks because the disk did not take it, a line a file."""
        kept = (
            (JOURNAL_FILE, "what happened", self.journal.problem, self.journal.dropped),
            (motion.FILE, "how everything moved", self._motion.problem, self._motion.dropped),
            (sensed.FILE, "what was sensed", self._sensed.problem, self._sensed.dropped),
        )
        return tuple(
            f"{file} ({what}) {f'is cut: {problem}' if problem else f'lacks {dropped} lines'}"
            for file, what, problem, dropped in kept
            if problem or dropped
        )

    def close(self) -> None:
        """Undo the faults that last, and close the journal."""
        self.faults.close()
        self._motion.close()
        self._sensed.close()
        self._depths.close()
        self.journal.close()


def _lines(setup: Setup, name: str, *, background: bool) -> Lines:
    """A file of lines beside the journal, if there is one."""
    if setup.folder is None:
        return Nowhere()
    kind = BackgroundFile if background else LineFile
    return kind(setup.folder / name, capacity=MOST_MOMENTS_WAITING)
