"""The one leaf that runs skills.

Traps of py_trees 2.6 that it stays out of: an exception in `update` would never reach `terminate`,
so it is caught here; `terminate` is also called on leaves that ended long ago, so it acts only on a
skill that is at work; and a stop that takes several ticks is handed over to the stage, because an
interrupted leaf is not ticked again.

An interruption that the job comes back from (a pause, something urgent) is not py_trees' own, which
would forget where the tree was: the leaf is suspended. It stays RUNNING, its skill comes to rest,
and when it is ticked again a new skill goes on with what was left.
"""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.scope import Scope
from executive.behaviours.stage import Stage, broken
from executive.blackboard import Blackboard
from executive.skills.parameters import SkillParams
from executive.skills.skill import Lasting, Resumable, Skill, SkillReport
from robot.failures import Failure, failure

Bound = Callable[[Blackboard], SkillParams | Failure]
"""Parameters that are known only when the step's turn comes."""

DEFAULT_LIMIT_S = 240.0


class RunSkill(Behaviour):
    """Runs one skill: RUNNING while it acts, then SUCCESS or FAILURE as it reports."""

    def __init__(
        self,
        name: str,
        params: SkillParams | Bound,
        *,
        stage: Stage,
        step_id: str = "",
        attempt: int = 0,
        limit_s: float | None = None,
    ) -> None:
        """Make the leaf; the skill itself is made when its turn comes.

        Args:
            name: what the step is called on screen and in the journal.
            params: of the skill, or a function that makes them from the blackboard.
            stage: shared by all leaves.
            step_id: the step's path in its job, for the journal.
            attempt: 0 the first time, more for a retry.
            limit_s: the longest it may take, interruptions left out; None: what the skill says, or
                `DEFAULT_LIMIT_S`.
        """
        super().__init__(name)
        self._params = params
        self._stage = stage
        self.step_id = step_id
        self._attempt = attempt
        self._wanted_limit_s = limit_s
        self._limit_s = limit_s or DEFAULT_LIMIT_S
        self._left: SkillParams | None = None
        self._asked: SkillParams | None = None
        self._finished = False
        self._resumed = False
        self._skill: Skill | None = None
        self._scope: Scope | None = None
        self._begun_s = 0.0
        self._spent_s = 0.0
        self.progress = 0.0

    def initialise(self) -> None:
        """Forget the last round."""
        self._skill = self._left = self._asked = None
        self._finished = self._resumed = False
        self._spent_s = 0.0
        self.progress = 0.0

    def update(self) -> Status:
        """Go on with the skill; never raises."""
        try:
            return self._go_on()
        except Exception as error:  # see the module's note
            return self._give_up(broken(error))

    def terminate(self, new_status: Status) -> None:
        """Bring a skill to rest that is interrupted for good."""
        if new_status is Status.INVALID:
            self._leave()
        self._skill = None
        self._stage.breakpoints.forget(self)

    def suspend(self) -> None:
        """Bring the skill to rest, to go on with what is left of it when ticked again."""
        if self._scope is None:
            return
        self._spent_s += self._stage.now_s - self._begun_s
        if isinstance(self._skill, Resumable):
            self._left = self._skill.remaining()
            self._finished = self._left is None
        self._leave()
        self._skill = None
        self._resumed = True
        self.feedback_message = "interrupted"

    @property
    def _acting(self) -> bool:
        """Whether the skill has been started and is not over."""
        return self._scope is not None

    def _go_on(self) -> Status:
        now_s = self._stage.now_s
        if self._finished:
            self._finish()
            return Status.SUCCESS
        if self._skill is None and self._waits():
            return Status.RUNNING
        if self._skill is None:
            params = self._wanted()
            if isinstance(params, Failure):
                return self._give_up(params)
            self._left = params
            self._asked = self._asked or params
            self._skill = self._stage.make_skill(params, self._attempt)
            if self._wanted_limit_s is None and isinstance(self._skill, Lasting):
                self._limit_s = self._skill.limit_s()
            self._begun_s = now_s
        late = self._spent_s + now_s - self._begun_s > self._limit_s
        if not self._acting:
            resource = self._stage.conflict(self._skill)
            if resource is not None:
                self.feedback_message = f"waiting for the {resource}"
                reason = failure("timeout", f"the {resource} did not come free")
                return self._give_up(reason) if late else Status.RUNNING
            self._enter(self._skill, now_s)
        elif late:
            text = f"{self.name!r} took longer than {self._limit_s:.0f} s"
            return self._give_up(failure("timeout", text, phase=self.feedback_message))
        return self._judge(self._skill.step(now_s))

    def _waits(self) -> bool:
        """Whether a breakpoint holds the step, which has not begun yet."""
        stage = self._stage
        if self._resumed or stage.scope is stage.own:
            return False
        before = stage.breakpoints.held
        if not stage.breakpoints.holds(self, self.name, self.step_id):
            return False
        if stage.breakpoints.held != before:
            self.feedback_message = "held at a breakpoint"
            self._record("break")
        return True

    def _wanted(self) -> SkillParams | Failure:
        """What the skill is asked: all of it the first time, after an interruption the rest."""
        if self._left is not None:
            return self._left
        return self._params(self._stage.board) if callable(self._params) else self._params

    def _enter(self, skill: Skill, now_s: float) -> None:
        """Start the skill; the parts of the body that it needs are free."""
        self._stage.take(skill)
        again = {"resumed": True} if self._resumed else {}
        self._record("step", attempt=self._attempt, **again)
        self._scope = self._stage.scope
        self._scope.at_work.append(self)
        self._begun_s = now_s
        skill.start(now_s)

    def _exit(self) -> Scope | None:
        """The skill does not act any more, whatever it still has to do to come to rest."""
        scope, self._scope = self._scope, None
        if scope is not None:
            scope.at_work.remove(self)
        return scope

    def _judge(self, report: SkillReport) -> Status:
        """Turn a report into a status."""
        self._show(report)
        if report.status == "running":
            return Status.RUNNING
        self._exit()
        if self._skill is not None:
            self._stage.release(self._skill)
        if report.status == "succeeded":
            self._finish()
            if not self._attempt:
                self._stage.earn()
            return Status.SUCCESS
        return self._give_up(report.failure or failure("internal", "it failed without a reason"))

    def _finish(self) -> None:
        """The step is done: all that was asked for at first."""
        self._record("done")
        for scope in (self._stage.scope, self._stage.own):  # its job's, and the executive's
            scope.did(self._asked)

    def _show(self, report: SkillReport) -> None:
        """Tell people (and, where it is news, the journal) what the skill does."""
        self.progress = report.progress
        if report.phase and report.phase != self.feedback_message:
            self.feedback_message = report.phase
            self._stage.phase(report.phase)
            if report.status == "running":
                self._record("phase", phase=report.phase)

    def _record(self, event: str, **data: object) -> None:
        self._stage.record(event, step=self.name, id=self.step_id, **data)

    def _give_up(self, reason: Failure) -> Status:
        """Fail, and bring the skill to rest if it is still at work."""
        self._leave()
        self.feedback_message = reason.cause
        self._stage.fail(reason, step=self.name, step_id=self.step_id)
        return Status.FAILURE

    def _leave(self) -> None:
        """Hand a skill that is at work over to the stage, which stops it."""
        scope = self._exit()
        if scope is not None and self._skill is not None:
            self._stage.leave(self.name, self._skill, scope)
