"""`humanoid repl`: the prompt, on a terminal or from a pipe."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Generator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from executive.engine.jobs import OVER
from executive.frontends import carrying_out, speaking
from executive.frontends.composition_root import REALITY
from executive.frontends.console.attending import attended
from executive.frontends.console.beside import shown as viewed
from executive.frontends.dump.record import recorded
from executive.frontends.hooks import notified
from executive.frontends.language_model import language_model
from executive.frontends.launching import (
    FrontEnd,
    folder_for,
    from_plain_options,
    hear_people,
    launch,
    under_way,
)
from executive.frontends.options import Prompt, Viewed
from executive.frontends.output import Screen, say
from executive.frontends.progress import sentence
from executive.frontends.prompt.commands import table
from executive.frontends.prompt.plain import lines_until, work_off
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.typed import Ahead
from executive.frontends.recurring import Recurring
from executive.frontends.speaking import Speech
from executive.journal import failures
from executive.journal.journal import Event, Journal
from executive.meaning import request
from executive.runs.again.continuation import left_in
from executive.runs.again.recording import Recording
from robot.bringup.mailbox import Handle
from robot.clock import WallClock
from robot.exit_status import ExitStatus

QUIET = frozenset({"phase", "stopping", "abort"})
"""Events that the status line shows anyway."""
ENDINGS = {"done": "Done", "failed": "Failed", "cancelled": "Ended"}


@dataclass(frozen=True, kw_only=True)
class Begun(Prompt):
    """The options of a prompt; `left_by` is the folder of a run whose jobs go on in it."""

    left_by: Path | None = None


def go_on_with(recorded: Recording, model: Path | None, page: Viewed = carrying_out.UNSEEN) -> int:
    """Prompt, and go on with what was open at a prompt that was cut off; the exit status."""
    header = recorded.header
    options = Begun(
        world=header.world,
        robot=header.robot,
        seed=header.seed,
        reality=header.reality,
        driver=header.driver,
        fast=header.runtime == "fast",
        vary=header.varied,
        eyes=header.eyes,
        localisation=header.localisation,
        model=model,
        left_by=recorded.folder,
        view=page.view,
        record=page.record,
    )
    return prompt(options) if options.fast else launch(FrontEnd.PROMPT, options)


def prompt(options: Begun, handle: Handle | None = None) -> int:
    """Prompt until the person leaves; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    on_terminal = sys.stdin.isatty() and sys.stdout.isatty()
    taking_over = under_way(handle) is not None
    ahead = Ahead(sys.stdin) if on_terminal and taking_over else None
    aloud = speaking.able(wanted=options.aloud, model=options.voice_model)
    with speaking.opened(wanted=aloud, model=options.voice_model) as speech:
        with conversation(options, "prompt", handle=handle, speech=speech, ahead=ahead) as shell:
            if on_terminal:
                return _at_terminal(shell, options, handle, ahead)
            interrupts = shell.robot.interrupts

            def over() -> bool:
                return interrupts.pressed > 0 or bool(shell.gone)

            whole = work_off(shell, lines_until(sys.stdin, over))
            if interrupts.pressed:
                shell.leave()
            else:
                _tell_left_open(shell)
            status = status_of(shell) if whole else max(status_of(shell), ExitStatus.FAILED)
        speech.finish()
        return status


in_executive = from_plain_options(Begun, prompt)


def _at_terminal(shell: Shell, options: Prompt, handle: Handle | None, ahead: Ahead | None) -> int:
    """Prompt on a terminal until the person leaves; returns the exit status."""
    from executive.frontends.prompt.terminal import Terminal, history_at_home

    if under_way(handle) is not None:
        stopped = shell.robot.interrupts.pressed > 0
        say(f"The prompt is back{'; what was open is stopped' if stopped else ''}.")
    kind = "fast" if handle is None else "live"
    say(f"{options.robot} in {options.world}, {kind}. `help` shows what can be said.")
    typed = ahead.take() if ahead is not None else b""
    Terminal(shell, history=history_at_home(), ahead=typed).run()
    shell.speech.hush()
    if shell.gone:
        return ExitStatus.BROKEN
    say("The robot comes to a stand." if shell.robot.busy else shell.brake.standing())
    return ExitStatus.DONE


@contextmanager
def conversation(
    options: Begun,
    about: str,
    *,
    handle: Handle | None = None,
    speech: Speech,
    ahead: Ahead | None = None,
    out: Callable[[str], None] = say,
) -> Generator[Shell]:
    """A robot to talk to, and what comes of what is said.

    Args:
        options: of the prompt.
        about: what the run's folder is called by.
        handle: of a live robot.
        speech: says aloud what is for ears.
        ahead: what people type until the prompt reads that; a stop is heard from here on.
        out: says a line to people.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    where = request.setting(
        REALITY.under(options.reality, eyes=options.eyes),
        options.world,
        robot=options.robot,
        vary_seed=options.vary_seed,
    )
    model = language_model(options.model)
    folder = folder_for(options.run_dir, about, handle)
    left = folder if under_way(handle) is not None else options.left_by
    robot = Robot(
        carrying_out.setup(where, options, folder, handle=handle),
        wall=WallClock(),
        time_of_day=time.time,
        handle=handle,
        left=left_in(left) if left is not None else None,
    )
    with ExitStack() as stack:
        stack.enter_context(viewed(folder, wanted=options.view))
        stack.enter_context(recorded(folder, wanted=options.record))
        if under_way(handle) is not None:  # a stop comes before what is gone on with
            stack.enter_context(robot.interrupts.listen())
            hear_people(handle, robot.interrupts)
            if ahead is not None:
                ahead.hear(robot.interrupts.wish)
            stack.enter_context(robot)
        else:
            with Screen(err=True).status("starting the robot"):
                stack.enter_context(robot)
            stack.enter_context(robot.interrupts.listen())
        shell = Shell(robot, out, table=table.commands, folder=folder, model=model, speech=speech)
        shell.dialogue.agreed = options.yes
        tell = Telling(out)
        tell_what_goes_on(robot.session.journal, tell)
        if robot.halted_before:
            shell.ask_again()
        robot.session.journal.listen(tell)
        robot.session.journal.listen(speech.note)
        stack.enter_context(notified(robot.session.journal, folder))
        stack.enter_context(attended(shell, folder, handle))
        yield shell


def tell_what_goes_on(journal: Journal, tell: Callable[[Event], None]) -> None:
    """Tell what is gone on with: that was written before anybody listened."""
    for event in tuple(journal.recent):  # at once: the robot's thread goes on writing
        if event.event == "resumed":
            tell(event)


class Telling:
    """Tells people what happens, as it happens, a line each."""

    def __init__(self, out: Callable[[str], None]) -> None:
        """Nothing has happened yet."""
        self._out, self._recurring = out, Recurring()

    def __call__(self, event: Event) -> None:
        """Hear an event of the journal."""
        for text in self._recurring.news(event, words(event)):
            self._out(f"[{event.t_s:7.2f} s] {text}")


def words(event: Event) -> str:
    """An event for people who see the status line as well; empty if it is no news to them."""
    if event.event in QUIET:
        return ""
    if event.event in ("step", "done") and not event.data.get("id"):
        return ""  # the executive's own business: coming to a stand
    if event.event == "job" and event.data["state"] in ENDINGS:
        head = f"{ENDINGS[event.data['state']]} ({event.data['job']}): {event.data['text']}"
        return head + failures.because(event.data.get("cause"))
    return sentence(event)


def status_of(shell: Shell) -> int:
    """Of lines from a pipe: the worst that came of one."""
    if shell.robot.lost:
        return ExitStatus.BROKEN
    if shell.refused:
        return ExitStatus.INVALID
    done = all(job.state == "done" for job in shell.robot.executive.jobs)
    return ExitStatus.DONE if done else ExitStatus.FAILED


def _tell_left_open(shell: Shell) -> None:
    """Say what is not done, because it waits for a word that no line says any more."""
    for job in shell.robot.executive.jobs:
        if job.state not in OVER:
            say(f"Not done: “{job.text}”: the robot is paused, and no line says `resume`", err=True)
