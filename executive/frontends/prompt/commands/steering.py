"""Commands that change what the robot does."""

from __future__ import annotations

from executive.behaviours.breakpoints import fits
from executive.engine.job_book import JobError
from executive.engine.jobs import OVER
from executive.frontends.prompt.brake import ESTOP_IS_ON
from executive.frontends.prompt.command import Command, anything, begins, one_of
from executive.frontends.prompt.commands.job_words import is_number, number_of, row
from executive.frontends.prompt.shell import Shell
from executive.missions import fault_plans
from intents.english.words.lexicon import DETERMINERS
from robot.errors import ConfigError
from robot.files.misfits import listed, shown

INJECTED = "For example: inject shove strength_n_s=8 towards_deg=90"


def commands(shell: Shell) -> tuple[Command, ...]:
    """Every one of them, in the order in which `help` shows them."""
    does = _Steering(shell)
    return (
        Command(
            name="goals", usage="goals [add SENTENCE | drop N | move N PLACE]",
            summary="the queue: see it, add to it, take out of it, reorder it",
            run=does.goals, accepts=begins("add", "drop", "move"),
            choices=lambda: ("add", "drop", "move"),
        ),
        Command(
            name="now", usage="now SENTENCE", summary="do it at once; what is under way comes back",
            run=does.now, accepts=_is_no_thing, takes_sentence=True,
        ),
        Command(
            name="run", usage="run MISSION [KEY=VALUE ...]",
            summary="check a mission, and queue it as one job",
            run=does.run, accepts=_is_mission, choices=samples, kind="mission",
            files=lambda rest: rest.split(" ", maxsplit=1)[0] not in samples(),
        ),
        Command(
            name="pause", usage="pause", summary="come to a stand and hold the task there",
            run=does.pause,
        ),
        Command(
            name="resume", usage="resume", summary="go on with the step that was paused",
            run=does.resume,
        ),
        Command(
            name="stop", usage="stop", summary="stand still and end every job (also Ctrl-C)",
            run=does.stop,
        ),
        Command(
            name="estop", usage="estop [release | reset]",
            summary="emergency stop: nothing moves until it is released and reset",
            run=does.estop, accepts=one_of("", "release", "reset"),
            choices=lambda: ("release", "reset"),
        ),
        Command(
            name="cancel", usage="cancel [N]", summary="end one job: N, or the one under way",
            run=does.cancel, accepts=is_number,
        ),
        Command(
            name="continue", usage="continue",
            summary="go on: after a breakpoint, a pause, or what the robot asked for",
            run=does.carry_on,
        ),
        Command(
            name="step", usage="step", summary="let one step go, and hold the next",
            run=does.step,
        ),
        Command(
            name="break", usage="break [NODE | off]",
            summary="hold before every step whose name matches, such as pick*",
            run=does.break_at, accepts=anything, choices=lambda: ("off",),
        ),
        Command(
            name="inject", usage="inject FAULT [KEY=VALUE ...]",
            summary="let something go wrong (simulation only)",
            run=does.inject, accepts=anything, choices=fault_plans.names,
        ),
    )  # fmt: skip


def _is_no_thing(rest: str) -> bool:
    """Whether a sentence may follow `now`, and no mere thing: "now the blue one" goes on."""
    return bool(rest) and rest.split(maxsplit=1)[0].casefold() not in DETERMINERS


class _Steering:
    """Commands that change what the robot does."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell

    def goals(self, rest: str) -> None:
        what, _, rest = rest.partition(" ")
        executive = self._shell.robot.executive
        if what == "add":
            self._shell.sentence(rest)
        elif what == "drop":
            executive.drop(number_of(rest))
        elif what == "move":
            number, _, place = rest.partition(" ")
            if not place:
                raise JobError("move which job where? For example: goals move 3 1")
            executive.move(number_of(number), number_of(place))
            last = sum(job.state == "waiting" for job in executive.jobs) - 1
            at = f"{last}, the last" if number_of(place) > last else f"{number_of(place)}"
            self._shell.out(f"Job {int(number)} waits at place {at}; 0 is next.")
        else:
            self._queue()

    def _queue(self) -> None:
        jobs = [job for job in self._shell.robot.executive.jobs if job.state not in OVER]
        for job in jobs:
            self._shell.out(f"  {row(job)}")
        if not jobs:
            self._shell.out("Nothing is to be done.")

    def now(self, rest: str) -> None:
        self._shell.sentence(rest, urgent=True)

    def run(self, rest: str) -> None:
        from executive.missions import load
        from executive.missions.check import Options, check
        from executive.runs import mission_assignment

        name, *given = rest.split()
        pairs = [word.partition("=") for word in given]
        params = {key: value for key, _, value in pairs}
        said = Options(params=params)
        checked = check(load.find(name), self._shell.robot.where.reality, said)
        here, there = self._shell.robot.where, checked.where
        if (here.world.name, here.robot_name) != (there.world.name, there.robot_name):
            text = f"the mission is for {there.robot_name} in {there.world.name}"
            raise ConfigError(f"{text}: start the prompt with --world {there.world.name}")
        if checked.faults:
            self._shell.out("Its faults are left out here; `humanoid mission run` injects them.")
        mission_assignment.keep(checked, self._shell.folder)
        made = mission_assignment.assignment(checked, said, path=str(checked.mission.path))
        self._shell.submit(made.understood, limits=made.limits, origin=made.origin)

    def pause(self, _rest: str) -> None:
        executive = self._shell.robot.executive
        executive.pause()
        self._shell.brake.settle_halt()
        if executive.estop.latched:
            self._shell.answer(f"{ESTOP_IS_ON} The robot is paused after that, until `resume`.")
        else:
            self._shell.answer("Pausing; `resume` goes on with the step.")

    def resume(self, _rest: str) -> None:
        executive = self._shell.robot.executive
        if executive.pause_wanted:
            executive.resume()
            self._shell.brake.settle_halt()
            if executive.estop.latched:
                self._shell.answer(f"It is not paused any more. {ESTOP_IS_ON}")
        elif executive.estop.latched:
            self._shell.answer(ESTOP_IS_ON)
        elif executive.held:
            held = ", ".join(executive.held)
            self._shell.answer(f"Nothing is paused; a breakpoint holds {held}: say `continue`.")
        elif under_way := self._shell.queue.under_way():
            self._shell.answer(f"Nothing is paused: “{under_way[0].text}” is under way.")
        else:
            over = [job for job in executive.jobs if job.state in OVER]
            last = f" The last job: {row(over[-1]).strip()}." if over else ""
            fallen = self._shell.brake.fallen
            if fallen:
                self._shell.answer(f"Nothing is paused. {fallen}")
            else:
                self._shell.answer(f"Nothing is paused, and nothing is to be done.{last}")

    def stop(self, _rest: str) -> None:
        self._shell.brake.stop("the operator said stop")

    def estop(self, rest: str) -> None:
        executive = self._shell.robot.executive
        if rest in ("release", "reset") and not executive.estop.latched:
            self._shell.out("The emergency stop is not on; the robot may move.")
        elif rest == "release":
            executive.release_estop()
            self._shell.out("Released; `estop reset` lets the robot move again.")
        elif rest == "reset":
            executive.reset_estop()
            paused = "; it is paused, until `resume`" if executive.pause_wanted else ""
            self._shell.out(f"The robot may move again{paused}.")
        else:
            self._shell.brake.press()
            if rest:
                self._shell.out(f"{shown(rest)} is neither release nor reset, so it is pressed.")
            self._shell.out("Emergency stop. `estop release`, then `estop reset`, undo it.")

    def cancel(self, rest: str) -> None:
        under_way = self._shell.queue.under_way()
        if rest:
            self._shell.robot.executive.cancel(number_of(rest))
        elif self._shell.brake.halt.on:
            self._shell.brake.give_up_halted()
        elif under_way:
            self._shell.robot.executive.cancel(under_way[0].number)
        elif self._shell.robot.executive.pause_wanted:
            self._shell.answer("Nothing is under way; the robot is paused: `resume` ends that.")
        else:
            self._shell.answer("Nothing is under way.")

    def carry_on(self, _rest: str) -> None:
        executive = self._shell.robot.executive
        if executive.question:
            executive.answer("continue")
        elif executive.held and not self._shell.brake.halt.on:
            executive.go_on()
        else:
            self.resume("")

    def step(self, _rest: str) -> None:
        executive = self._shell.robot.executive
        if not executive.held:
            self._shell.out("No step is held now; the next one will be.")
        executive.step_once()

    def break_at(self, rest: str) -> None:
        executive = self._shell.robot.executive
        if rest == "off":
            executive.clear_breaks()
            left = "; `continue` lets go what is held" if executive.held else ""
            self._shell.out(f"No step is held any more{left}.")
        elif rest:
            executive.break_at(rest)
            self._shell.out(f"Holding before {rest}; `step` and `continue` go on.")
            steps = self._shell.queue.steps_to_do()
            if steps and not any(fits(rest, name) for name in steps):
                self._shell.out(f"  No step of what is to be done is called so: {listed(steps)}.")
        else:
            held = ", ".join(executive.held) or "nothing"
            self._shell.out(f"Held now: {held}. Give a step's name, such as: break pick*")

    def inject(self, rest: str) -> None:
        if not rest:
            self._shell.out("Faults: " + ", ".join(fault_plans.names()))
            self._shell.out(INJECTED)
            return
        where = self._shell.robot.where
        try:
            fault = fault_plans.in_words(rest)
            fault_plans.verify(fault, where.world, where.description)
        except ConfigError as error:
            self._shell.refuse(f"Not done: {error}", INJECTED)
            return
        self._shell.robot.inject(fault)
        self._shell.out(f"Injected: {rest}")


def samples() -> tuple[str, ...]:
    """The missions that come along."""
    from executive.missions.load import shipped

    return tuple(path.stem for path in shipped())


def _is_mission(rest: str) -> bool:
    """Whether what follows names a mission: "run to the table" is a sentence."""
    name = rest.split(" ", maxsplit=1)[0]
    return name.endswith((".yaml", ".yml")) or name in samples()
