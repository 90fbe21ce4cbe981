"""The executive: jobs in, ticks at 20 Hz, an outcome out. The same in `fast` and in `live`.

Every public method but `tick` and `abandon` may be called from any thread, at any time: what is
asked for is put down as a request and carried out when the next tick begins, so the tree has one
thread, and a run has one order of events. `on_request` is called after each of them; `loop.run`
sets it to what wakes a sleeping runtime, so that a request acts at once.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Literal

import msgspec

from executive.behaviours.ask import ANSWERS, Answer
from executive.behaviours.stage import Stage, failure_data
from executive.blackboard import (
    ABORT,
    HEALTH,
    HELP,
    PAUSE,
    PAUSED,
    SAID,
    SPEED_LIMIT,
    STOP,
    Blackboard,
)
from executive.engine.estop import EmergencyStop
from executive.engine.health_monitor import HealthMonitor
from executive.engine.job_book import JobBook, JobError, Outcome
from executive.engine.job_tree import Work
from executive.engine.jobs import UNLIMITED, Job, Limits
from executive.engine.sense import Sense
from executive.engine.tree import BuildTask, Tree
from executive.health import Health
from executive.journal.journal import Journal
from executive.journal.reader import Reader
from executive.skills import catalogue
from executive.skills.context import SkillContext
from executive.skills.parameters import SkillParams
from executive.skills.skill import BODY, Resource, Skill
from robot.failures import Failure, failure

RATE_HZ = 20.0

State = Literal["idle", "working", "pausing", "paused", "stopping"]


MakeSkill = Callable[[SkillParams, SkillContext], Skill]
Request = Callable[[], None]


def _nothing() -> None:
    """A request that was carried out as it was made."""


class Executive:
    """One robot's executive: one tree, and the jobs in it.

    Attributes:
        board: the blackboard.
        journal: where events go.
        so_far: what the journal tells since this executive began, for all who show it.
        tree: what is ticked.
        pause_wanted: whether a pause was asked for, and neither `resume` nor `stop` since.
        breaks: the patterns of the breakpoints that were asked for.
    """

    def __init__(
        self,
        context: SkillContext,
        journal: Journal,
        *,
        rates_hz: Mapping[str, float],
        make: MakeSkill = catalogue.make,
        jobs_before: int = 0,
    ) -> None:
        """Build the tree; nothing moves before a job is submitted.

        Args:
            context: what every skill is given; its `say` is called with every spoken text too.
            journal: where events go.
            rates_hz: the promised rate of each topic, from which health is judged.
            make: makes a skill from its parameters.
            jobs_before: the highest number of a job of this run so far.
        """
        self.board = Blackboard()
        self.journal = journal
        reader = Reader()
        journal.listen(reader.event)
        self.so_far = reader.run
        self.on_request: Callable[[], None] = lambda: None
        self.pause_wanted = False
        self.breaks: tuple[str, ...] = ()
        self._operator = self.board.claim("operator")
        self._voice = self.board.claim("voice")
        self._say_on = context.say
        self._context = replace(context, say=self._say, speed_limit=self._speed_limit)
        self._make = make
        self.stage = Stage(self.board, journal, self._make_skill, speak=context.link.speak)
        self.estop = EmergencyStop()
        monitor = HealthMonitor(
            rates_hz,
            start_s=context.link.now_s(),
            motors=context.description.motor_names,
            speed_m_s=context.description.walking.max_forward_m_s,
            estop=self.estop,
        )
        sense = Sense(
            self.stage, context.link, monitor, holdings=context.holdings, hearing=context.hearing
        )
        self.tree = Tree(self.stage, sense)
        self._book = JobBook(self.tree.jobs, jobs_before=jobs_before)
        self._requests: deque[Request] = deque()
        self._stop_until = 0

    # --- what people ask for, from any thread ---

    def submit(
        self,
        build: BuildTask,
        *,
        text: str,
        urgent: bool = False,
        resources: frozenset[Resource] = BODY,
        limits: Limits = UNLIMITED,
        origin: Mapping[str, Any] | None = None,
        number: int | None = None,
    ) -> int:
        """Put a job into the queue; returns its number.

        Args:
            build: makes its part of the tree; called at once, in this thread.
            text: what was asked for, in words.
            urgent: it interrupts the jobs that it conflicts with; they come back after it.
            resources: the parts of the body that it may use; jobs that share none run side by side.
            limits: what it may take.
            origin: what it is made from, as plain data for the journal: goals, or a mission.
            number: of a job that an executive before this one had begun (None: a new one).
        """
        node = build(self.stage)

        def make(given: int) -> Job:
            return Job(number=given, text=text, urgent=urgent, resources=resources, limits=limits)

        with self._book.lock:
            job = self._book.submit(make, number=number)
            self._requests.append(lambda: self._add(Work(job, node), dict(origin or {})))
        self.on_request()
        return job.number

    def pause(self, why: str = "paused on request") -> None:
        """Bring the robot to a stand and keep it there; `state` says when it stands."""
        self.pause_wanted = True
        self._post(lambda: self._pause(why), "pause", why=why)

    def resume(self) -> None:
        """Go on after a pause, each job with the step it was in."""
        self.pause_wanted = False
        self._post(self._resume, "resume")

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs with `cancelled`; takes several ticks.

        What is submitted after this is not ended; it begins when the robot stands.
        """
        self.pause_wanted = False
        last = self._book.last
        self._post(lambda: self._stop(why, last), "stop", why=why)

    def press_estop(self, why: str) -> None:
        """Press the emergency stop (`estop`); it acts at once, before the request is written."""
        self.estop.press(why)
        self._post(_nothing, "press_estop", why=why)

    def release_estop(self) -> None:
        """Let go of the emergency stop; it stays latched."""
        self.estop.release()
        self._post(_nothing, "release_estop")

    def reset_estop(self) -> None:
        """Allow motion again after an emergency stop.

        Raises:
            StillPressed: while it is pressed.
        """
        self.estop.reset()
        self._post(_nothing, "reset_estop")

    def cancel(self, number: int, why: str = "cancelled on request") -> None:
        """End one job with `cancelled`; it is over when its part of the body is at rest.

        Raises:
            JobError: if there is no such job, or it is over.
        """
        self._book.must_have(number)
        self._post(lambda: self._cancel(number, why), "cancel", number=number, why=why)

    def drop(self, number: int) -> None:
        """Take a waiting job out of the queue (one that has begun by then is cancelled).

        Raises:
            JobError: if there is no such job, or it is over.
        """
        self.cancel(number, "taken out of the queue")

    def move(self, number: int, place: int) -> None:
        """Put a waiting job at a place of the queue, counted from 0.

        Raises:
            JobError: if no such job waits.
        """
        self._book.must_have(number, waiting=True)
        self._post(lambda: self._move(number, place), "move", number=number, place=place)

    def break_at(self, pattern: str) -> None:
        """Hold every step whose path is `pattern` or whose name it matches, before it begins."""
        self.breaks = (*self.breaks, pattern)
        self._post(lambda: self.stage.breakpoints.add(pattern), "break_at", pattern=pattern)

    def clear_breaks(self, pattern: str | None = None) -> None:
        """Forget a breakpoint, or all of them; what is held stays held until `go_on`."""
        self.breaks = tuple(one for one in self.breaks if pattern not in (None, one))
        self._post(lambda: self.stage.breakpoints.remove(pattern), "clear_breaks", pattern=pattern)

    def step_once(self) -> None:
        """Let the held step go on, and hold the next one; if none is held, just hold the next."""
        self._post(lambda: self.stage.breakpoints.go_on(one_step=True), "step_once")

    def go_on(self) -> None:
        """Let held steps begin; from here on only breakpoints hold."""
        self._post(self.stage.breakpoints.go_on, "go_on")

    def answer(self, text: Answer) -> None:
        """Answer the open question (`question`): "continue" when it is done, or "give up".

        Raises:
            JobError: if nothing was asked, or that is no answer.
        """
        if text not in ANSWERS:
            raise JobError(f"{text!r} is no answer; say {' or '.join(ANSWERS)}")
        if not self.question:
            raise JobError("nothing was asked")
        self._post(lambda: self._answer(text), "answer", text=text)

    # --- how things stand, from any thread ---

    @property
    def jobs(self) -> tuple[Job, ...]:
        """All jobs: those that are over, those under way as they take turns, those that wait."""
        return self._book.jobs

    @property
    def outcome(self) -> Outcome | None:
        """How the last job ended, when nothing is left to do; None before."""
        return self._book.outcome

    @property
    def question(self) -> str:
        """What a person is asked to help with; empty when nothing is."""
        return self.board.read(HELP)

    @property
    def health(self) -> Health:
        """How well the robot is, as of the last tick; the emergency stop as it is now."""
        return self.estop.seen_in(self.board.read(HEALTH))

    @property
    def attended(self) -> bool:
        """Whether somebody is there to answer questions; set by the front end."""
        return self.stage.help.attended

    @attended.setter
    def attended(self, there: bool) -> None:
        self.stage.help.attended = there

    @property
    def held(self) -> tuple[str, ...]:
        """The names of the steps that breakpoints hold now."""
        return self.stage.breakpoints.held

    @property
    def state(self) -> State:
        """What the executive is about."""
        board = self.board
        if board.read(STOP):
            return "stopping"
        if board.read(PAUSE):
            return "paused" if board.read(PAUSED) else "pausing"
        if self.held and self.stage.quiet:
            return "paused"
        if self._requests or self._book.open:
            return "working"
        return "idle" if self.stage.quiet else "stopping"

    @property
    def awaits_operator(self) -> bool:
        """Whether nothing goes on before somebody who is there asks for something."""
        return self.attended and not self._requests and self.state == "paused"

    @property
    def awaits_help(self) -> bool:
        """Whether a person is asked for help, and has not answered."""
        return bool(self.question) and not self._requests and self.stage.help.answer is None

    # --- the loop's side ---

    def tick(self, now_s: float) -> None:
        """Carry out what was asked for, tick the tree; `outcome` is set when nothing is left."""
        self.tree.at(now_s)
        self._carry_out()
        self.tree.tick()
        with self._book.lock:
            self._settle(now_s)

    def abandon(self, reason: Failure | None, now_s: float) -> None:
        """End all jobs at once, without bringing anything to rest (None: as a person wants it)."""
        self._carry_out()
        if reason is None:
            self.journal.write(now_s, "request", request="abandon")
            reason = failure("cancelled", "stopped at once on request; the motors damp")
        with self._book.lock:
            self._note(self.tree.jobs.abandon(reason), now_s)

    def _carry_out(self) -> None:
        while self._requests:
            try:
                self._requests[0]()
            finally:
                self._requests.popleft()  # only now: until it is carried out there is work to do

    def _settle(self, now_s: float) -> None:
        """Give their final states to the jobs that have come to their end."""
        board, jobs = self.board, self.tree.jobs
        aborted, asked = board.read(ABORT), board.read(STOP)
        if aborted is not None:
            for work in jobs.works:
                if not asked or work.job.number <= self._stop_until:
                    jobs.end(work, aborted)
        self._note(jobs.settle(), now_s)
        stopped = all(work.job.number > self._stop_until for work in jobs.works)
        if asked and aborted is not None and stopped and self.stage.quiet:
            self._operator.set(STOP, "")

    def _note(self, ended: list[Job], now_s: float) -> None:
        """Remember what has ended; when nothing is left, that is the outcome."""
        outcome = self._book.end(ended)
        if outcome is None:
            return
        reason, took_s = outcome.failure, outcome.took_s
        how = failure_data(reason) if reason else {"code": "done"}
        self.journal.write(now_s, "outcome", **how, took_s=took_s, recoveries=outcome.recoveries)

    # --- requests, carried out as a tick begins ---

    def _post(self, request: Request, name: str, **arguments: object) -> None:
        """Put down a request; the journal says when it was carried out, for replays."""

        def carry_out() -> None:
            self.stage.record("request", request=name, **arguments)
            request()

        with self._book.lock:
            self._requests.append(carry_out)
        self.on_request()

    def _add(self, work: Work, origin: dict[str, Any]) -> None:
        jobs, job = self.tree.jobs, work.job
        limits = {k: v for k, v in msgspec.structs.asdict(job.limits).items() if math.isfinite(v)}
        self.stage.record(
            "request", request="submit", job=job.number, text=job.text, urgent=job.urgent,
            limits=limits, origin=origin,
        )  # fmt: skip
        if not jobs.works:
            self.tree.hold.reset()
        self._book.take_up(work)

    def _pause(self, why: str) -> None:
        if self.board.read(PAUSE) or self.board.read(STOP):
            return
        self.stage.record("pause", why=why)
        self.tree.jobs.pausing = True
        self._operator.set(PAUSE, why)

    def _resume(self) -> None:
        if self.board.read(PAUSE):
            over = all(work.ending is not None for work in self.tree.jobs.works)
            self.stage.record("resume", **({"over": True} if over else {}))
            self._go_on()

    def _go_on(self) -> None:
        self.tree.jobs.pausing = False
        self._operator.set(PAUSE, "")

    def _stop(self, why: str, last: int) -> None:
        if self.board.read(STOP) and last <= self._stop_until:
            return  # it comes to a stand already, and ends them all
        self.stage.record("stop", why=why)
        self._go_on()
        self.stage.breakpoints.go_on()
        self._stop_until = last
        self._operator.set(STOP, why)

    def _cancel(self, number: int, why: str) -> None:
        work = self.tree.jobs.find(number)
        if work is not None:
            self.stage.record("cancel", job=number, why=why)
            self.tree.jobs.end(work, failure("cancelled", why))

    def _move(self, number: int, place: int) -> None:
        work = self.tree.jobs.find(number)
        if work is not None and work.job.state == "waiting":
            self.tree.jobs.move(work, place)

    def _answer(self, text: str) -> None:
        if self.stage.help.asker is not None:
            self.stage.help.answer = text

    # --- what skills are given ---

    def _make_skill(self, params: SkillParams, attempt: int) -> Skill:
        """A skill; a retry plans with another seed."""
        context = replace(self._context, seed=self._context.seed + attempt)
        return self._make(params, context)

    def _speed_limit(self) -> float:
        """What health and the job whose turn it is allow [m/s]."""
        return min(self.board.read(SPEED_LIMIT), self.stage.scope.speed_m_s)

    def _say(self, text: str) -> None:
        self._voice.set(SAID, text)
        self.stage.record("said", text=text)
        self._context.link.speak(text)
        self._say_on(text)
