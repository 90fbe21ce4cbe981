"""Jobs that somebody speaks of who wants them ended, or something left out of them.

"Cancel the second job", "cancel everything but the first", "leave out the wave": which jobs are
meant depends on the queue, so no grammar can tell.
"""

from __future__ import annotations

from collections.abc import Callable

from executive.engine.jobs import OVER, UNDER_WAY, Job
from executive.frontends.prompt.answering import Answering
from executive.frontends.prompt.brake import Brake
from executive.frontends.prompt.queueing import Queueing
from executive.frontends.prompt.robot import AtWork
from intents.english.words.verbs import base_form
from intents.goals import Goal
from intents.job_words import Jobs, Step, jobs_to_end, step_to_leave_out
from intents.outcomes import Goals
from intents.parser import hear
from intents.swaps import speaks_of
from intents.vocabulary import Vocabulary
from robot.files.misfits import listed

SHOWS = "`goals` shows them."
BEGUN = (
    "I leave nothing out of a job that has begun: `cancel` ends it, and then say what is left to do"
)
_POINTED = frozenset({"it", "that", "this", "this one", "that one", "them"})
Replace = Callable[[Job, tuple[Goal, ...]], None]


class NamingJobs:
    """Ends jobs, and leaves things out of them, by what people call them."""

    def __init__(
        self, robot: AtWork, *, brake: Brake, queue: Queueing, people: Answering, read: Vocabulary
    ) -> None:
        """Nobody has spoken of a job yet.

        Args:
            robot: whose jobs they are.
            brake: knows which were given up already, and gives them up.
            queue: knows what each was asked to do.
            people: are answered.
            read: the names of this world.
        """
        self._robot = robot
        self._brake = brake
        self._queue = queue
        self._people = people
        self._read = read

    def take(self, text: str, replace: Replace) -> bool:
        """Do what a line says of jobs; whether it says anything of them.

        Args:
            text: the line.
            replace: puts other goals in the place of a job that waits.
        """
        meant = jobs_to_end(text)
        if meant is not None:
            self._end(meant)
            return True
        step = step_to_leave_out(text)
        return step is not None and self._leave_out(step, replace)

    # --- jobs by their numbers and places ---

    def _end(self, meant: Jobs) -> None:
        open_jobs = self._open()
        if not open_jobs:
            self._people.answer("Nothing is to be done.")
            return
        found, missing = which(meant, open_jobs)
        for number in missing:
            self._people.refuse(self._no_such(number), SHOWS)
        if not found and not missing:
            self._people.refuse("No other job is to be done.", SHOWS)
        if found:
            self._give_up(found)

    def _no_such(self, number: int) -> str:
        over = [job for job in self._robot.executive.jobs if job.number == number]
        state = over[0].state if over and over[0].state in OVER else ""
        return (
            f"Job {number} is over: {state}." if state else f"There is no job {number} to be done."
        )

    def _open(self) -> list[Job]:
        """The jobs that are to be done, as `goals` lists them."""
        jobs = self._robot.executive.jobs
        return [job for job in jobs if job.state not in OVER and not self._brake.halt.gave_up(job)]

    def _give_up(self, jobs: list[Job]) -> None:
        self._brake.give_up(jobs)
        for job in jobs:
            self._people.answer(f"Job {job.number}, “{job.text}”, is given up.")

    # --- steps ---

    def _leave_out(self, step: Step, replace: Replace) -> bool:
        open_jobs = self._open()
        if step.what in _POINTED:
            return step.plainly and self._leave_out_of(open_jobs[:1])
        meant = self._as_goals(step.what)
        speaking = [job for job in open_jobs if self._spoken_of(job, step, meant)]
        if not speaking:
            if step.plainly and open_jobs:
                self._people.refuse(
                    f"Nothing of what is to be done is called “{step.what}”.", SHOWS
                )
            return step.plainly and bool(open_jobs)
        if len(speaking) > 1:
            numbers = listed([f"{job.number}" for job in speaking])
            told = f"Jobs {numbers} speak of “{step.what}”: which?"
            self._people.refuse(told, "For example: cancel job 2")
            return True
        (job,) = speaking
        gone = self._spoken_of(job, step, meant)
        left = tuple(goal for goal in self._queue.goals_of(job) if goal not in gone)
        if not left:
            self._give_up([job])
        elif job.state == "waiting":
            replace(job, left)
        else:
            self._people.refuse(f"{BEGUN} (job {job.number}, “{job.text}”).")
        return True

    def _leave_out_of(self, jobs: list[Job]) -> bool:
        """Leave out "that": a job of one step, or it is not known which is meant."""
        for job in jobs:
            if len(self._queue.goals_of(job)) == 1:
                self._give_up([job])
            else:
                self._people.refuse(f"{BEGUN} (job {job.number}, “{job.text}”).")
        return bool(jobs)

    def _as_goals(self, what: str) -> tuple[Goal, ...]:
        """What words ask for by themselves: "the wave", "waving", "going to the chair"."""
        plain = what.removeprefix("the ").removeprefix("that ").removeprefix("to ")
        first, _, rest = plain.partition(" ")
        for said in dict.fromkeys((plain, f"{base_form(first)} {rest}".strip())):
            outcome, _ = hear(said, self._read)
            if isinstance(outcome, Goals):
                return outcome.goals
        return ()

    def _spoken_of(self, job: Job, step: Step, meant: tuple[Goal, ...]) -> list[Goal]:
        """The goals of a job that are meant by words; by what they mean, or by their names."""
        goals = self._queue.goals_of(job)
        by_meaning = [goal for goal in goals if any(_is_of(goal, one) for one in meant)]
        if by_meaning or meant or not step.by_name:
            return by_meaning
        return [goal for goal in goals if speaks_of((goal,), step.what)]


def which(meant: Jobs, jobs: list[Job]) -> tuple[list[Job], list[int]]:
    """The jobs that are meant, of all that are to be done in their order; numbers of none."""
    if meant.every:
        spared = which(meant.but, jobs)[0] if meant.but is not None else []
        return [job for job in jobs if job not in spared], []
    if meant.others:
        first = next((job for job in jobs if job.state in UNDER_WAY), jobs[0] if jobs else None)
        return [job for job in jobs if job is not first], []
    if meant.current:
        return [job for job in jobs if job.state in UNDER_WAY][:1], []
    if meant.next:
        return [job for job in jobs if job.state == "waiting"][:1], []
    if meant.first or meant.last:
        return (jobs[: meant.first] if meant.first else jobs[-meant.last :]), []
    places = [place - 1 if place > 0 else place for place in meant.places]
    there = [place for place in places if -len(jobs) <= place < len(jobs)]
    found = [jobs[place] for place in there]
    found += [job for job in jobs if job.number in meant.numbers and job not in found]
    known = {job.number for job in jobs}
    missing = [number for number in meant.numbers if number not in known]
    return found, missing


def _is_of(goal: Goal, other: Goal) -> bool:
    """Whether a goal says all that another one says, and maybe more: a wave at Ada is a wave."""
    if type(goal) is not type(other):
        return False
    fields = other.__struct_fields__
    return all(getattr(other, name) in (None, (), getattr(goal, name)) for name in fields)
