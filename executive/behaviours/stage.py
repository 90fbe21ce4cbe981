"""What all leaves of one executive share: the board, the journal, the skills at work."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager

import msgspec

from executive.behaviours.breakpoints import Breakpoints
from executive.behaviours.scope import Scope
from executive.blackboard import FAILURE, HELP, NOW, PHASE, RECOVERIES, RESTLESS, Blackboard, Writer
from executive.journal.journal import Journal
from executive.skills.parameters import SkillParams
from executive.skills.skill import Resource, Skill, SkillReport
from robot.failures import Failure, failure

STOP_TIMEOUT_S = 10.0
"""How long a skill may take to bring the body to rest before it is given up."""

MakeSkill = Callable[[SkillParams, int], Skill]
"""Makes the skill for parameters; the number is the attempt, from 0: a retry plans anew."""


class Stopping(msgspec.Struct, frozen=True, eq=False):
    """A skill on its way to rest: of which step and job, since when."""

    step: str
    skill: Skill
    since_s: float
    scope: Scope


def _silent(_text: str) -> None:
    """Let nobody hear it."""


class HelpDesk:
    """The one open question to a person, and the answer to it."""

    def __init__(self, board: Writer, speak: Callable[[str], None]) -> None:
        """Show questions on the board, and let people who stand near hear them."""
        self._board, self._speak = board, speak
        self.attended = False
        """Whether somebody is there who can answer."""
        self.asker: object | None = None
        self.answer: str | None = None

    def ask(self, asker: object, question: str) -> None:
        """Open a question."""
        self.asker, self.answer = asker, None
        self._board.set(HELP, question)
        self._speak(question)

    def close(self) -> None:
        """Take the question back."""
        self.asker = self.answer = None
        self._board.set(HELP, "")


class Stage:
    """The skills at work, what they hold of the body, and where leaves report.

    A skill that is interrupted may need several ticks to come to rest, in which its leaf is not
    ticked any more. So it is left here: `wind_down`, ticked every time, brings it to its end, and
    the parts of the body that it uses stay taken until then.
    """

    def __init__(
        self,
        board: Blackboard,
        journal: Journal,
        make_skill: MakeSkill,
        *,
        speak: Callable[[str], None] = _silent,
    ) -> None:
        """Set the stage; becomes the writer of the tasks' and the skills' keys.

        `speak` lets people who stand near the robot hear its questions.
        """
        self.board = board
        self.journal = journal
        self.make_skill = make_skill
        self.task = board.claim("task")
        self.scope = self.own = Scope()
        self.recovers = True
        self.help = HelpDesk(self.task, speak)
        self.breakpoints = Breakpoints()
        self._phases = board.claim("skills")
        self._taken: dict[Resource, Skill] = {}
        self._stopping: list[Stopping] = []

    @property
    def now_s(self) -> float:
        """The time of this tick."""
        return self.board.read(NOW)

    @property
    def quiet(self) -> bool:
        """Whether no skill is at work, not even on coming to rest."""
        return not self._taken and not self._stopping

    def at_rest(self, scope: Scope) -> bool:
        """Whether a job has no skill at work, not even on coming to rest."""
        return not scope.at_work and all(entry.scope is not scope for entry in self._stopping)

    @contextmanager
    def turn(self, scope: Scope) -> Generator[None]:
        """Whatever leaves do inside the block, they do for this job."""
        before, self.scope = self.scope, scope
        try:
            yield
        finally:
            self.scope = before

    def record(self, event: str, **data: object) -> None:
        """Write an event to the journal, with this tick's time and the job whose turn it is."""
        if self.scope.number:
            data.setdefault("job", self.scope.number)
        self.journal.write(self.now_s, event, **data)

    def conflict(self, skill: Skill) -> Resource | None:
        """A part of the body that the skill needs and another one has."""
        wanted = sorted(skill.resources)
        return next((r for r in wanted if self._taken.get(r, skill) is not skill), None)

    def take(self, skill: Skill) -> None:
        """Give a skill the parts of the body it needs."""
        self._taken.update(dict.fromkeys(skill.resources, skill))

    def release(self, skill: Skill) -> None:
        """Take back what a skill has; may be repeated."""
        self._taken = {r: owner for r, owner in self._taken.items() if owner is not skill}

    def phase(self, text: str) -> None:
        """Say what the newest skill does."""
        self._phases.set(PHASE, text)

    def fail(self, reason: Failure, *, step: str, step_id: str = "") -> None:
        """Make it the failure of the job whose turn it is; on the board and in the journal too."""
        self.scope.failure = reason
        self.task.set(FAILURE, reason)
        self.record("failure", step=step, id=step_id, **failure_data(reason))

    def count_recovery(self) -> int:
        """Count a recovery of the job whose turn it is; returns how many it has begun by now."""
        self.scope.recoveries += 1
        self.scope.spent += 1
        self.task.set(RECOVERIES, self.scope.recoveries)
        return self.scope.recoveries

    def earn(self) -> None:
        """A step was done at the first try: its job may have one more recovery, of those spent."""
        self.scope.spent = max(0, self.scope.spent - 1)

    def leave(self, name: str, skill: Skill, scope: Scope) -> None:
        """Stop a skill whose leaf is not ticked any more; `wind_down` sees it through."""
        entry = Stopping(name, skill, self.now_s, scope)
        self._stopping.append(entry)
        with self.turn(scope):
            self.record("stopping", step=name)
            self._step_to_rest(entry)

    def wind_down(self) -> bool:
        """Go on with every skill that is coming to rest; True when none is left."""
        for entry in list(self._stopping):
            with self.turn(entry.scope):
                self._step_to_rest(entry)
        return not self._stopping

    def _step_to_rest(self, entry: Stopping) -> None:
        report = stop_safely(entry.skill, self.now_s)
        took_s = self.now_s - entry.since_s
        late = took_s > STOP_TIMEOUT_S
        if report.status == "running" and not late:
            self.phase(report.phase)
            return
        if late:
            self.task.set(RESTLESS, True)  # noqa: FBT003
        self._stopping = [other for other in self._stopping if other is not entry]
        self.release(entry.skill)
        self.record("stopped", step=entry.step, took_s=round(took_s, 3), in_time=not late)


def stop_safely(skill: Skill, now_s: float) -> SkillReport:
    """Call a skill's `stop`; an exception ends it, as a failure."""
    try:
        return skill.stop(now_s)
    except Exception as error:  # the other skills must come to rest all the same
        return SkillReport(status="failed", failure=broken(error))


def broken(error: Exception) -> Failure:
    """The failure that an unexpected exception is, without anything that differs between runs."""
    return failure("internal", f"{type(error).__name__}: {error}")


def failure_data(reason: Failure) -> dict[str, object]:
    """A failure as the journal has it."""
    data: dict[str, object] = {"code": reason.code, "cause": reason.cause}
    if reason.evidence:
        data["evidence"] = reason.evidence
    return data


def beginning_data(beginning: bool) -> dict[str, object]:
    """What marks an event of the journal that is only about something that has just been started.

    Every run has such, and nothing is wrong: people are not told of them.
    """
    return {"beginning": True} if beginning else {}
