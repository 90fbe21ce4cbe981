"""One run of an evaluation, in `--fast`, from its case to its record."""

from __future__ import annotations

import tempfile
import time
import traceback
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import msgspec

from executive.engine import loop
from executive.engine.executive import Executive
from executive.evaluation.campaign import Run, Settings, meant
from executive.evaluation.record import Record
from executive.journal.journal import Journal
from executive.missions import fault_plans
from executive.runs import agreement, faults, runtimes
from executive.runs.session import RATES_HZ
from executive.skills.context import SkillContext
from executive.skills.resources import needed_by
from executive.trees.build import Done, build
from executive.trees.parts import errands
from robot.errors import Failure, failure
from robot.planning.worker import Planner
from robot.reality import truth
from robot.reality.contract import Plant, Reality

SETTLE_S = 2.0
"""Let pass before the judge looks: a robot that falls has to hit the floor."""
RESTART_S = 3.0
"""How long an executive that was killed is away before the next one goes on."""


def perform(run: Run, reality: Reality) -> Record:
    """Do a run to its end, whatever that is; never raises."""
    begin_s = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory(prefix="humanoid-eval-") as folder:
            record = _Trial(run, reality, Path(folder)).carry_out()
    except Exception as error:  # a run that breaks is a result as well
        text = traceback.format_exception_only(error)[-1].strip()
        record = Record(
            key=run.key, case=run.case.name, seed=run.seed, recovery=run.recovery, ok=False,
            code="exception", cause=text, unsafe=True,
        )  # fmt: skip
    return msgspec.structs.replace(record, wall_s=round(time.perf_counter() - begin_s, 2))


class _Trial:
    """A robot in its world, an executive that may die, and a judge."""

    def __init__(self, run: Run, reality: Reality, folder: Path) -> None:
        self.run, self.folder = run, folder
        case, seed = run.case, run.seed
        given = meant(case, Settings(reality, run.robot))
        world = given.where.world.nudged(seed, start=case.start)
        self.given = given
        self.where = msgspec.structs.replace(given.where, world=world)
        self.codes: list[str] = []
        self.recoveries = 0
        self.killed = False

    def carry_out(self) -> Record:
        """The run, and what became of it."""
        run, where = self.run, self.where
        with ExitStack() as stack:
            runtime, planner = stack.enter_context(runtimes.fast(where, seed=run.seed))
            journal = stack.enter_context(Journal(self.folder))
            journal.listen(lambda event: self._note(event.event, event.data))
            slow = faults.SlowPlanner(planner)
            injector = faults.Injector(
                (*self.given.faults, *(fault_plans.plan(data) for data in run.case.faults)),
                runtime,
                journal,
                begin_s=runtime.clock.now_s(),
                seed=run.seed,
                planner=slow,
                kill=self._kill,
            )
            stack.callback(injector.close)
            reason = self._work(runtime, slow, journal, injector)
            took_s = runtime.clock.now_s()
            runtime.advance(SETTLE_S)
            return self._record(runtime.plant, reason, took_s=took_s, struck=len(injector.struck))

    def _work(
        self,
        runtime: loop.Runtime,
        planner: Planner,
        journal: Journal,
        injector: faults.Injector,
    ) -> Failure | None:
        """Executives one after the other until one of them comes to an end."""
        end_s = runtime.clock.now_s() + self.run.case.limit_s
        while True:
            executive = self._executive(runtime, planner, journal)

            def over(of: Executive = executive) -> bool:
                late = runtime.clock.now_s() > end_s
                return self.killed or late or of.outcome is not None

            def on_tick(of: Executive = executive) -> None:
                injector.tick(runtime.clock.now_s())
                if self.run.case.helped and of.question:
                    of.answer("continue")

            loop.run(runtime, executive, interrupts=loop.Interrupts(), on_tick=on_tick, until=over)
            if executive.outcome is not None:
                return executive.outcome.failure
            if not self.killed:
                return failure("timeout", f"hanging after {self.run.case.limit_s:g} s")
            self.killed = False
            if not self.run.recovery:
                return failure("internal", "the executive was killed")
            runtime.advance(RESTART_S)

    def _executive(self, runtime: loop.Runtime, planner: Planner, journal: Journal) -> Executive:
        """An executive with the task; a second one knows only what journal and world tell it."""
        where, task = self.where, self.given.understood.task
        context = SkillContext(
            link=runtime.link, planner=planner, description=where.description, seed=self.run.seed
        )
        done: Done = frozenset()
        if journal.recent:  # somebody was here before
            found = agreement.look(
                list(journal.recent),
                task,
                link=runtime.link,
                knowledge=where.knowledge,
                robot=where.description,
            )
            done = found.done
            for held in found.held:
                context.holdings.take(held)
        executive = Executive(context, journal, rates_hz=RATES_HZ)
        executive.stage.recovers = self.run.recovery
        executive.submit(
            lambda stage: build(task, stage, done=done),
            text=self.given.understood.text,
            resources=needed_by(errand.params for errand in errands(task)),
            limits=self.given.limits,
        )
        return executive

    def _kill(self) -> None:
        self.killed = True

    def _note(self, event: str, data: dict[str, Any]) -> None:
        if event == "failure":
            self.codes.append(str(data["code"]))
        self.recoveries += event in ("recovery", "hold")

    def _record(
        self, plant: Plant, reason: Failure | None, *, took_s: float, struck: int
    ) -> Record:
        """Judge by the simulator's truth."""
        run, case = self.run, self.run.case
        verdict = plant.judge(truth.read(case.truth, self.where.world_map))
        safe = verdict.upright or (case.damped and verdict.damped)
        code, cause = (reason.code, reason.cause) if reason else ("done", "")
        wrong = verdict.wrong if code == "done" else ()
        done = code == "done" and not wrong and (case.recovers or bool(case.truth))
        as_expected = done or code in case.codes
        return Record(
            key=run.key,
            case=case.name,
            seed=run.seed,
            recovery=run.recovery,
            ok=as_expected and safe,
            code=code,
            cause=cause or "; ".join(wrong),
            unsafe=not safe,
            recoveries=self.recoveries,
            codes=tuple(self.codes),
            took_s=round(took_s, 2),
            struck=struck,
            source=verdict.source,
        )
