"""The commands of the prompt, as one table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from shlex import quote
from shutil import get_terminal_size

from executive.behaviours.breakpoints import fits
from executive.blackboard import KEYS
from executive.engine.executive import JobError
from executive.engine.jobs import OVER, Job
from executive.frontends.prompt import saving
from executive.frontends.prompt.command import Command, anything
from executive.frontends.prompt.shell import Shell, number_of
from executive.frontends.prompt.watch import Watch
from executive.journal import failures, past_runs
from executive.journal.dumps.text import picture
from executive.journal.snapshot import at_work
from executive.journal.why import told
from executive.missions import fault_plans
from executive.skills.catalogue import SKILLS
from robot.errors import ConfigError
from robot.misfits import listed, shown

KEY_NAMES = tuple(key.name for key in KEYS)
PAST_SHOWN = 10
WIDE_COLUMNS = 120
"""A terminal that shows a command and what it does on one line."""


def table(shell: Shell) -> tuple[Command, ...]:
    """Every command, in the order in which `help` shows them."""
    seeing, steering, keeping = _Seeing(shell), _Steering(shell), _Keeping(shell)
    return (
        Command(
            name="status", usage="status", summary="how the robot is and what it does",
            run=seeing.status,
        ),
        Command(
            name="tree", usage="tree [on|off]", summary="the running task, once or kept in sight",
            run=seeing.tree, accepts=_one_of("", "on", "off"), choices=lambda: ("on", "off"),
        ),
        Command(
            name="watch", usage="watch KEY", summary="tell when a value on the blackboard changes",
            run=seeing.watch, accepts=_one_of("", *KEY_NAMES), choices=lambda: KEY_NAMES,
            kind="key",
        ),
        Command(
            name="unwatch", usage="unwatch [KEY]", summary="watch it no more",
            run=seeing.unwatch, accepts=_one_of("", *KEY_NAMES), choices=seeing.watched,
        ),
        Command(
            name="why", usage="why [N]",
            summary="why a job ended, or what it is at: N, or the newest",
            run=seeing.why, accepts=_is_number,
        ),
        Command(
            name="history", usage="history", summary="the jobs of this run, and the runs before",
            run=seeing.history,
        ),
        Command(
            name="goals", usage="goals [add SENTENCE | drop N | move N PLACE]",
            summary="the queue: see it, add to it, take out of it, reorder it",
            run=steering.goals, accepts=_begins("add", "drop", "move"),
            choices=lambda: ("add", "drop", "move"),
        ),
        Command(
            name="now", usage="now SENTENCE", summary="do it at once; what is under way comes back",
            run=steering.now, accepts=bool, takes_sentence=True,
        ),
        Command(
            name="plan", usage="plan SENTENCE",
            summary="what it would do and how long that takes, without doing it",
            run=seeing.plan, accepts=bool, takes_sentence=True,
        ),
        Command(
            name="run", usage="run MISSION [KEY=VALUE ...]",
            summary="check a mission, and queue it as one job",
            run=steering.run, accepts=_is_mission, choices=samples, kind="mission",
        ),
        Command(
            name="pause", usage="pause", summary="come to a stand and hold the task there",
            run=steering.pause,
        ),
        Command(
            name="resume", usage="resume", summary="go on with the step that was paused",
            run=steering.resume,
        ),
        Command(
            name="stop", usage="stop", summary="stand still and end every job (also Ctrl-C)",
            run=steering.stop,
        ),
        Command(
            name="estop", usage="estop [release | reset]",
            summary="emergency stop: nothing moves until it is released and reset",
            run=steering.estop, accepts=_one_of("", "release", "reset"),
            choices=lambda: ("release", "reset"),
        ),
        Command(
            name="cancel", usage="cancel [N]", summary="end one job: N, or the one under way",
            run=steering.cancel, accepts=_is_number,
        ),
        Command(
            name="continue", usage="continue",
            summary="go on: after a breakpoint, a pause, or what the robot asked for",
            run=steering.carry_on,
        ),
        Command(
            name="step", usage="step", summary="let one step go, and hold the next",
            run=steering.step,
        ),
        Command(
            name="break", usage="break [NODE | off]",
            summary="hold before every step whose name matches, such as pick*",
            run=steering.break_at, accepts=anything, choices=lambda: ("off",),
        ),
        Command(
            name="inject", usage="inject FAULT [KEY=VALUE ...]",
            summary="let something go wrong (simulation only)",
            run=steering.inject, accepts=anything, choices=fault_plans.names,
        ),
        Command(
            name="save", usage="save mission FILE", summary="keep what was done as a mission",
            run=keeping.save, accepts=_begins("mission", bare=False), choices=lambda: ("mission",),
        ),
        Command(
            name="help", usage="help [COMMAND | skills]",
            summary="this list, or one command, or what the robot can do",
            run=seeing.help, accepts=lambda rest: rest in ("", "skills", *shell.commands),
            choices=lambda: ("skills", *shell.commands), kind="command",
        ),
        Command(
            name="quit", usage="quit", summary="stop, and leave (also Ctrl-D)", run=keeping.quit
        ),
        Command(name="exit", usage="exit", summary="the same", run=keeping.quit),
    )  # fmt: skip


def samples() -> tuple[str, ...]:
    """The missions that come along."""
    from executive.missions.load import shipped

    return tuple(path.stem for path in shipped())


def _is_mission(rest: str) -> bool:
    """Whether what follows names a mission: "run to the table" is a sentence."""
    name = rest.split(" ", maxsplit=1)[0]
    return name.endswith((".yaml", ".yml")) or name in samples()


def _is_number(rest: str) -> bool:
    """Whether what follows is a job's number, or nothing."""
    return not rest or rest.isdecimal()


def _one_of(*words: str) -> Callable[[str], bool]:
    return lambda rest: rest in words


def _begins(*words: str, bare: bool = True) -> Callable[[str], bool]:
    """Whether what follows begins with one of the words (or, if `bare`, is nothing)."""
    return lambda rest: rest.split(" ")[0] in words if rest else bare


class _Seeing:
    """Commands that only look."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        self._watches: dict[str, Watch] = {}

    def status(self, _rest: str) -> None:
        view, out = self._shell.robot.view, self._shell.out
        if self._shell.gone:
            out(self._shell.gone)
            return
        doing = f": {view.goal}" if view.goal else ""
        out(f"{view.state}{doing}{f' ({view.phase})' if view.phase else ''}")
        out(f"  body    {view.mode}" + (f", holds {', '.join(view.held)}" if view.held else ""))
        if view.pose is not None:
            out("  pose    x {:.2f} m, y {:.2f} m, heading {:.0f}°".format(*view.pose))
        out(f"  health  {view.unwell or 'all is well'}")
        out(f"  queue   {view.waiting} waiting")
        out(f"  time    {view.time_s:.1f} s, {view.pace:.2f} x real time")
        if view.help:
            out(f"  asks    {view.help}")

    def tree(self, rest: str) -> None:
        observer = self._shell.robot.observer
        if rest:
            observer.tree_wanted = rest == "on"
            return
        shown = at_work(self._shell.robot.executive.so_far)
        self._shell.out(picture(shown) if shown else "There is no task.")

    def watch(self, rest: str) -> None:
        if not rest:
            for key in KEYS:
                self._shell.out(f"  {key.name:16} {key.meaning}")
        elif rest not in self._watches:
            self._watches[rest] = Watch(self._shell.robot.executive.board, rest, self._shell.out)

    def unwatch(self, rest: str) -> None:
        for name in [rest] if rest else list(self._watches):
            watch = self._watches.pop(name, None)
            if watch is not None:
                watch.end()

    def watched(self) -> Iterable[str]:
        return tuple(self._watches)

    def why(self, rest: str) -> None:
        job = number_of(rest) if rest else None
        self._shell.out(told(self._shell.folder, job=job, live=True).text)

    def history(self, _rest: str) -> None:
        robot = self._shell.robot
        for number, state, text in robot.ended_before:
            self._shell.out(f"  {number:3} {state:11} {text}")
        jobs = robot.executive.jobs
        for job in jobs:
            self._shell.out(f"  {_row(job)}")
        if not (jobs or robot.ended_before):
            self._shell.out("Nothing was done in this run.")
        before = [one for one in past_runs.history() if Path(one.folder) != self._shell.folder]
        if before:
            self._shell.out("Before this run:")
        for one in before[-PAST_SHOWN:]:
            took = f"{one.took_s:6.1f} s"
            self._shell.out(f"  {one.began}  {one.ending:9} {took}  {one.text}")

    def plan(self, rest: str) -> None:
        from executive.missions.plan import forecast_lines

        understood = self._shell.understand(rest, steers=False)
        if self._shell.dialogue.question is not None:
            self._shell.dialogue.forget()  # an answer would be taken for a wish to have it done
            self._shell.out("  Say it again with the answer in it: plan ...")
        if understood is not None:
            for line in forecast_lines(understood.task, self._shell.robot.where):
                self._shell.out(line)

    def help(self, rest: str) -> None:
        commands = self._shell.commands
        if rest == "skills":
            for skill in SKILLS:
                self._shell.out(f"  {skill.name:10} {skill.summary}")
            return
        if rest:
            self._shell.out(f"{commands[rest].usage}\n  {commands[rest].summary}")
            return
        wide = get_terminal_size().columns >= WIDE_COLUMNS
        self._shell.out("Say what to do in plain English, for example:")
        self._shell.out("  pick up the red cup and put it on the shelf")
        self._shell.out("Or use a command:")
        for command in commands.values():
            apart = " " if wide else "\n      "
            self._shell.out(f"  {command.usage:{44 if wide else 0}}{apart}{command.summary}")
        self._shell.out("Tab completes, the up arrow brings back what was typed. Ctrl-C stops.")


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
            self._shell.out(f"Job {int(number)} waits at place {int(place)}; 0 is next.")
        else:
            self._queue()

    def _queue(self) -> None:
        jobs = [job for job in self._shell.robot.executive.jobs if job.state not in OVER]
        for job in jobs:
            self._shell.out(f"  {_row(job)}")
        if not jobs:
            self._shell.out("Nothing is to be done.")

    def now(self, rest: str) -> None:
        self._shell.sentence(rest, urgent=True)

    def run(self, rest: str) -> None:
        from executive.missions import load
        from executive.missions.check import Options, check
        from executive.runs import mission_task

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
        mission_task.keep(checked, self._shell.folder)
        made = mission_task.assignment(checked, said, path=str(checked.mission.path))
        self._shell.submit(made.understood, limits=made.limits, origin=made.origin)

    def pause(self, _rest: str) -> None:
        self._shell.robot.executive.pause()
        self._shell.brake.settle_halt()
        self._shell.answer("Pausing; `resume` goes on with the step.")

    def resume(self, _rest: str) -> None:
        executive = self._shell.robot.executive
        if executive.pause_wanted:
            executive.resume()
            self._shell.brake.settle_halt()
        elif executive.held:
            held = ", ".join(executive.held)
            self._shell.answer(f"Nothing is paused; a breakpoint holds {held}: say `continue`.")
        elif under_way := self._shell.under_way():
            self._shell.answer(f"Nothing is paused: “{under_way[0].text}” is under way.")
        else:
            over = [job for job in executive.jobs if job.state in OVER]
            last = f" The last job: {_row(over[-1]).strip()}." if over else ""
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
            self._shell.out("The robot may move again.")
        else:
            self._shell.brake.press()
            if rest:
                self._shell.out(f"{shown(rest)} is neither release nor reset, so it is pressed.")
            self._shell.out("Emergency stop. `estop release`, then `estop reset`, undo it.")

    def cancel(self, rest: str) -> None:
        under_way = self._shell.under_way()
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
            self._shell.out("No step is held any more; `continue` lets go what is held.")
        elif rest:
            executive.break_at(rest)
            self._shell.out(f"Holding before {rest}; `step` and `continue` go on.")
            steps = self._shell.steps_to_do()
            if steps and not any(fits(rest, name) for name in steps):
                self._shell.out(f"  No step of what is to be done is called so: {listed(steps)}.")
        else:
            held = ", ".join(executive.held) or "nothing"
            self._shell.out(f"Held now: {held}. Give a step's name, such as: break pick*")

    def inject(self, rest: str) -> None:
        if not rest:
            self._shell.out("Faults: " + ", ".join(fault_plans.names()))
            self._shell.out("For example: inject shove strength_n_s=8 towards_deg=90")
            return
        fault = fault_plans.in_words(rest)
        where = self._shell.robot.where
        fault_plans.verify(fault, where.world, where.description)
        self._shell.robot.inject(fault)
        self._shell.out(f"Injected: {rest}")


class _Keeping:
    """Commands about the run itself."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell

    def save(self, rest: str) -> None:
        name = rest.removeprefix("mission").strip()
        if not name:
            raise ConfigError("save it where? For example: save mission morning.yaml")
        steps = [job.text for job in self._shell.robot.executive.jobs if job.state == "done"]
        path = saving.save(Path(name), steps, self._shell.robot.where)
        self._shell.out(f"Saved: {path}. Run it with: humanoid mission run {quote(str(path))}")

    def quit(self, _rest: str) -> None:
        self._shell.leaving = True


def _row(job: Job) -> str:
    took = f"{job.took_s:.1f} s" if job.took_s is not None else ""
    reason = failures.because(job.failure.cause if job.failure else None)
    urgent = " (urgent)" if job.urgent else ""
    return f"{job.number:3} {job.state:11} {job.text}{urgent}  {took}{reason}".rstrip()
