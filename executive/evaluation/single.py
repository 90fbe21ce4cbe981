"""One run of an evaluation, in `--fast`, from its case to its record."""

from __future__ import annotations

import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

import msgspec

from executive.evaluation import keeping
from executive.evaluation.campaign import REFUSED, Meant, Run, Settings, meant
from executive.evaluation.record import Record
from executive.journal import journal
from executive.missions import fault_plans
from executive.runs import runtimes
from executive.runs.again import continuation
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from robot.failures import Failure, failure
from robot.reality import truth
from robot.reality.contract import Plant, Reality

SETTLE_S = 2.0
"""Let pass before the judge looks: a robot that falls has to hit the floor."""
RESTART_S = 3.0
"""How long an executive that was killed is away before the next one goes on."""


def perform(run: Run, reality: Reality, keep: Path | None = None) -> Record:
    """Do a run to its end, whatever that is; never raises.

    Where it went wrong, what it wrote is kept under `keep` (`executive.evaluation.keeping`).
    """
    begin_s = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory(prefix="humanoid-eval-") as folder:
            record = _tried(run, reality, Path(folder))
            if keep is not None:
                record = keeping.keep(run, record, Path(folder), keep)
    except OSError as error:  # there is no room to run in
        record = _broken(run, error)
    return msgspec.structs.replace(record, wall_s=round(time.perf_counter() - begin_s, 2))


def _tried(run: Run, reality: Reality, folder: Path) -> Record:
    try:
        return _carried_out(run, reality, folder)
    except Exception as error:  # a run that breaks is a result as well
        return _broken(run, error)


def _broken(run: Run, error: Exception) -> Record:
    return Record(
        key=run.key, digest=run.digest, case=run.case.name, seed=run.seed, recovery=run.recovery,
        ok=False, code="exception", cause=traceback.format_exception_only(error)[-1].strip(),
        unsafe=True,
    )  # fmt: skip


def _carried_out(run: Run, reality: Reality, folder: Path) -> Record:
    given = meant(run.case, Settings(_reality(run, reality), run.robot))
    if isinstance(given, Meant):
        return _Trial(run, given, folder).carry_out()
    return Record(
        key=run.key, digest=run.digest, case=run.case.name, seed=run.seed, recovery=run.recovery,
        ok=not {given.outcome, REFUSED}.isdisjoint(run.case.codes), code=given.outcome,
        cause=given.reason,
    )  # fmt: skip


def _reality(run: Run, reality: Reality) -> Reality:
    """As it is for this run: cases differ in who tells the robot where it is."""
    if run.localisation is msgspec.UNSET:
        return reality
    return reality.under(reality.profile, eyes=reality.eyes, localisation=run.localisation)


class _Trial:
    """A robot in its world, an executive that may die, and a judge."""

    def __init__(self, run: Run, given: Meant, folder: Path) -> None:
        self.run, self.folder = run, folder
        case, seed = run.case, run.seed
        world = given.where.world.nudged(seed, start=case.start)
        self.given = given
        self.where = msgspec.structs.replace(given.where, world=world)
        self.codes: list[str] = []
        self.recoveries = 0
        self.killed = False

    def carry_out(self) -> Record:
        """The run, and what became of it."""
        run = self.run
        setup = Setup(where=self.where, seed=run.seed, folder=self.folder)
        planned = tuple(fault_plans.plan(data) for data in run.case.faults)
        with (
            runtimes.fast(setup) as (runtime, planner),
            Session(
                setup,
                Opened(runtime, planner),
                faults=(*self.given.assignment.faults, *planned),
                kill=self._kill,
            ) as session,
        ):
            session.begin(run.case.mission)  # so that what is kept of it says what it was
            runtime.plant.watch()
            session.journal.listen(lambda event: self._note(event.event, event.data))
            session.on_tick(lambda: self._help(session))
            reason = self._work(session)
            took_s = session.now_s
            runtime.advance(SETTLE_S)
            struck = len(session.faults.struck)
            return self._record(runtime.plant, reason, took_s=took_s, struck=struck)

    def _work(self, session: Session) -> Failure | None:
        """Executives one after the other until one of them comes to an end."""
        end_s = session.now_s + self.run.case.limit_s

        def over() -> bool:
            late = session.now_s > end_s
            return self.killed or late or session.executive.outcome is not None

        session.executive.stage.recovers = self.run.recovery
        self.given.assignment.submit_to(session)
        while True:
            session.run(until=over)
            outcome = session.executive.outcome
            if outcome is not None:
                return outcome.failure
            if not self.killed:
                return failure("timeout", f"hanging after {self.run.case.limit_s:g} s")
            if not self.run.recovery:
                return failure("internal", "the executive was killed")
            self.killed = False
            session.runtime.advance(RESTART_S)
            session.replace_executive()
            events = journal.read(self.folder)
            continuation.take_over(session, events)
            continuation.go_on(session, self.given.assignment, events, anew=False)

    def _help(self, session: Session) -> None:
        if self.run.case.helped and session.executive.question:
            session.executive.answer("continue")

    def _kill(self) -> None:
        self.killed = True

    def _note(self, event: str, data: dict[str, Any]) -> None:
        if event == "failure":
            self.codes.append(str(data["code"]))
        self.recoveries += event in ("recovery", "hold") and not data.get("beginning")

    def _record(
        self, plant: Plant, reason: Failure | None, *, took_s: float, struck: int
    ) -> Record:
        """Judge by the simulator's truth."""
        run, case = self.run, self.run.case
        verdict = plant.judge(truth.read(case.truth, self.where.world_map))
        safe = verdict.upright or (case.damped and verdict.damped)
        code, cause = (reason.code, reason.cause) if reason else ("done", "")
        wrong = verdict.wrong if code == "done" else ()
        there = not verdict.wrong and verdict.upright and REFUSED not in case.codes
        if case.kind:  # an ending that counts does so only where the truth holds
            ok = there and (code == "done" or code in case.codes)
        else:
            done = code == "done" and not wrong and (case.recovers or bool(case.truth))
            ok = safe and (done or code in case.codes)
        return Record(
            key=run.key,
            digest=run.digest,
            case=case.name,
            seed=run.seed,
            recovery=run.recovery,
            ok=ok,
            code=code,
            cause=cause or "; ".join(wrong),
            unsafe=not safe,
            recoveries=self.recoveries,
            codes=tuple(self.codes),
            took_s=round(took_s, 2),
            struck=struck,
            source=verdict.source,
            done=there,
            false=code == "done" and not there,
            touched=verdict.touched,
            too_near=verdict.too_near,
            remark=self.given.remark,
        )
