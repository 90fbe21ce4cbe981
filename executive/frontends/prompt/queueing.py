"""Tasks into the robot's queue: what each takes the place of, and what was asked for before."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

from executive.behaviours.breakpoints import fits
from executive.blackboard import HELD, WORLD
from executive.engine.job_book import JobError
from executive.engine.jobs import OVER, UNDER_WAY, Job, in_turn
from executive.frontends.prompt import foresight
from executive.frontends.prompt.answering import Answering
from executive.frontends.prompt.brake import ESTOP_IS_ON, Brake
from executive.frontends.prompt.robot import AtWork
from executive.meaning.request import Understood
from executive.trees.parts import errands
from intents.goals import Goal
from robot.files.misfits import listed
from robot.se3 import SE3


class Queueing:
    """Queues what was understood, and remembers it.

    Attributes:
        corrects: whether the next task takes the place of the one before it.
        corrected: the job whose place it takes then (None: the one that was asked for last).
    """

    def __init__(self, robot: AtWork, brake: Brake, people: Answering) -> None:
        """Nothing was asked for yet."""
        self.corrects = False
        self.corrected: int | None = None
        self._robot = robot
        self._brake = brake
        self._people = people
        self._holds: tuple[str, ...] = ()
        self._asked: dict[int, tuple[Understood, SE3 | None]] = {}

    def submit(self, understood: Understood, *, urgent: bool = False, **how: Any) -> None:
        """Queue a task (`how`: as for `Robot.submit`), and say where it stands."""
        executive, halt = self._robot.executive, self._brake.halt
        if executive.estop.latched:
            self._people.refuse(f"Not done: {ESTOP_IS_ON}")
            return
        halted = halt.on
        comes_first = urgent or (halted and "first" in understood.text.casefold().split())
        place = self._make_room(comes_first=comes_first)
        number = self._brake.unless_stopped(
            lambda: self._submitted(understood, comes_first, place, **how)
        )
        if number is None:
            self._people.refuse_stopped(understood.text)
            return
        self._holds = understood.holds
        self._asked[number] = understood, self.X_WS
        live = {job.number: job for job in executive.jobs if job.state not in OVER}
        mine = live.pop(number, None)
        self._tell_of_breaks(understood)
        before = [
            job
            for job in live.values()
            if mine and job.resources & mine.resources and not halt.gave_up(job)
        ]
        if place is not None:
            waits = [job for job in before if job.state == "waiting"]
            before = [job for job in before if job.state in UNDER_WAY] + waits[:place]
        if halted and (comes_first or not any(job.state in UNDER_WAY for job in before)):
            halt.end()
        if before and not comes_first:
            self._people.answer(f"Queued as {number}, with {len(before)} before it.")
        if executive.pause_wanted and not halt.on:
            self._people.answer("The robot is paused: `resume` lets it begin.")

    @property
    def X_WS(self) -> SE3 | None:
        """Where the robot stands: its base, on the floor and upright; None before it is known."""
        world = self._robot.executive.board.read(WORLD)
        if world is None:
            return None
        x_m, y_m, _ = world.X_WB.p
        return SE3.from_xy_yaw(x_m, y_m, world.X_WB.yaw_rad)

    def held_then(self) -> tuple[str, ...]:
        """What is in the hands when the next task begins, as far as it can be expected."""
        if self._robot.busy and not (self._brake.halt.on or self.corrects):
            return self._holds
        return self.held_now()

    def held_now(self) -> tuple[str, ...]:
        """What is in the hands."""
        return tuple(self._robot.executive.board.read(HELD).values())

    def under_way(self) -> list[Job]:
        """The jobs that have begun and are not over, what the body is about first."""
        jobs = [job for job in self._robot.executive.jobs if job.state not in OVER]
        return in_turn([job for job in jobs if job.urgent or job.state in UNDER_WAY])

    def goals_of(self, job: Job) -> tuple[Goal, ...]:
        """What a job was asked to do; nothing if it was not asked for here."""
        asked = self._asked.get(job.number)
        return asked[0].goals if asked else ()

    def open_orders(self) -> list[Job]:
        """The jobs that were asked for here and are to be done, the newest first."""
        gave_up = self._brake.halt.gave_up
        jobs = [job for job in self._robot.executive.jobs if job.number in self._asked]
        left = [job for job in jobs if job.state not in OVER and not gave_up(job)]
        return sorted(left, key=lambda job: job.number, reverse=True)

    def foresee_s(self, job: Job) -> float | None:
        """How long a job takes in all; None if it was not asked for here, or cannot be said."""
        asked = self._asked.get(job.number)
        return foresight.takes_s(asked[0], self._robot.where, asked[1]) if asked else None

    def steps_to_do(self) -> list[str]:
        """The names of the steps of all that is to be done, as far as it was asked for here."""
        jobs = [job for job in self._robot.executive.jobs if job.state not in OVER]
        asked = [self._asked[job.number][0] for job in jobs if job.number in self._asked]
        return list(dict.fromkeys(step.name for one in asked for step in errands(one.task)))

    def _tell_of_breaks(self, understood: Understood) -> None:
        """Say that a job will not be held, where breakpoints were set to hold something."""
        breaks = self._robot.executive.breaks
        names = list(dict.fromkeys(step.name for step in errands(understood.task)))
        if breaks and names and not any(fits(one, name) for one in breaks for name in names):
            text = f"No breakpoint ({listed(breaks)}) holds a step of it: {listed(names)}."
            self._people.out(f"  {text}")

    def _submitted(
        self, understood: Understood, urgent: bool, place: int | None, **how: Any
    ) -> int:
        """Queue a task at a place of the queue (None: its end); returns its number."""
        number = self._robot.submit(understood, urgent=urgent, **how)
        if place is not None and not urgent:
            with suppress(JobError):  # nothing was in its way, and it has begun
                self._robot.executive.move(number, place)
        return number

    def _make_room(self, *, comes_first: bool) -> int | None:
        """End what a task takes the place of: what was halted for it, or what it corrects.

        Returns:
            Where in the queue that is; None if it takes nobody's place. Of several that were
            halted before they began none is ended: the task comes before them.
        """
        halt = self._brake.halt
        corrects, self.corrects = self.corrects, False
        last, self.corrected = self.corrected or max(self._asked, default=0), None
        jobs = [job for job in self._robot.executive.jobs if job.state not in OVER]
        replaced = [job for job in jobs if corrects and job.number == last]
        instead = halt.on and not replaced and not comes_first
        if instead:
            begun = [job for job in halt.kept if job.state in UNDER_WAY]
            replaced = begun or (halt.kept if len(halt.kept) == 1 else [])
        if replaced:
            halt.give_up(replaced, "something else was asked for instead")
            self._people.answer(f"Instead of “{replaced[0].text}”.")
        elif instead and halt.kept:
            self._people.answer(f"Before “{halt.kept[0].text}”.")
        waiting = [job.number for job in jobs if job.state == "waiting"]
        places = [waiting.index(job.number) for job in replaced if job.number in waiting]
        if not (replaced or instead):
            return None
        return min(places) if places and len(places) == len(replaced) else 0
