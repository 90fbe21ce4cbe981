"""A robot at work that halted for a cry which ends nothing: its jobs wait until it is told more.

Whoever cried is asked whether to go on. "Yes" goes on, "no" ends what was under way, and something
else to be done takes its place.
"""

from __future__ import annotations

from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNDER_WAY, Job
from executive.frontends.prompt.robot import CRIED
from intents.goals import Resume
from intents.outcomes import YES_OR_NO, Question


class Halt:
    """Whether the robot has halted for a cry, and for which jobs that is still open.

    Attributes:
        on: whether it halted, and it is not known yet what is wanted.
        told: whether people were told that it halts.
    """

    def __init__(self, executive: Executive) -> None:
        """Nobody has cried yet."""
        self._executive = executive
        self._given_up: set[int] = set()
        self.on = self.told = False

    def begin(self) -> None:
        """Come to a stand at once, and keep what is under way."""
        self.told = self.told and self.on
        self.on = True
        self._executive.pause(CRIED)

    def end(self) -> None:
        """It is known what is wanted: go on with what is left."""
        self.on = False
        self._executive.resume()

    def forget(self) -> None:
        """Something else has seen to it: a stop, a pause, a wish to go on."""
        self.on = False

    def give_up(self, jobs: list[Job], why: str) -> None:
        """End jobs; they are asked about no more."""
        for job in jobs:
            self._given_up.add(job.number)
            self._executive.cancel(job.number, why)

    def gave_up(self, job: Job) -> bool:
        """Whether a job was ended here, for all that it may not be over yet."""
        return job.number in self._given_up

    @property
    def kept(self) -> list[Job]:
        """The jobs that have begun, and may be gone on with; those that wait if none has."""
        jobs = [job for job in self._executive.jobs if job.number not in self._given_up]
        begun = [job for job in jobs if job.state in UNDER_WAY]
        return begun or [job for job in jobs if job.state not in OVER]

    def question(self) -> Question | None:
        """Whether to go on with what was halted; None if there is nothing left to go on with."""
        kept = self.kept
        if not kept:
            return None
        more = f" and {len(kept) - 1} more" if len(kept) > 1 else ""
        return Question(
            question=f"Shall I go on with “{kept[0].text}”{more}?",
            choices=YES_OR_NO,
            goals=(Resume(),),
            kind="confirmation",
        )
