"""`humanoid repl`: the prompt, on a terminal or from a pipe."""

from __future__ import annotations

import sys
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any

import msgspec
from msgspec.structs import replace
from rich.console import Console

from executive.frontends import speaking
from executive.frontends.language_model import language_model
from executive.frontends.progress import sentence
from executive.frontends.prompt import commands
from executive.frontends.prompt.plain import work_off
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.frontends.reality import REALITY
from executive.frontends.speaking import Speech
from executive.frontends.supervised import FrontEnd, oversee
from executive.journal import failures
from executive.journal.journal import Event
from executive.meaning import request
from executive.runs import run_folder, runtimes
from executive.runs.recording import Recording
from robot.bringup.mailbox import Handle
from robot.clock import WallClock

DONE, FAILED, INVALID, BROKEN = 0, 1, 2, 3
HISTORY = Path("~/.local/state/humanoid/history")
QUIET = frozenset({"phase", "stopping", "abort"})
"""Events that the status line shows anyway."""
ENDINGS = {"done": "Done", "failed": "Failed", "cancelled": "Ended"}


class Options(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid repl`; `folder` is set once it begins.

    `left_by` is the folder of a run that was cut off, whose jobs go on in this one.
    """

    world: str
    robot: str
    seed: int
    fast: bool
    vary: bool
    folder: Path | None
    model: Path | None = None
    left_by: Path | None = None
    voice: bool = False
    voice_model: Path | None = None


def again(left_by: Recording, model: Path | None) -> int:
    """Prompt, and go on with what was open at a prompt that was cut off; the exit status."""
    header = left_by.header
    return repl(
        Options(
            world=header.world,
            robot=header.robot,
            seed=header.seed,
            fast=header.runtime == "fast",
            vary=header.varied,
            folder=None,
            model=model,
            left_by=left_by.folder,
        )
    )


def repl(options: Options) -> int:
    """Prompt until the person leaves; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    _setting(options)
    language_model(options.model)
    stamp = f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
    folder = options.folder or run_folder.folder_for("prompt", stamp=stamp)
    run_folder.check_free(folder)
    voice = speaking.able(wanted=options.voice, model=options.voice_model)
    options = replace(options, folder=folder, voice=voice)
    if options.fast:
        return prompt(options)
    plain = msgspec.to_builtins(options, enc_hook=str)
    return oversee(FrontEnd.PROMPT, plain, as_json=False)


def overseen(handle: Handle, plain: dict[str, Any]) -> int:
    """Prompt in an executive of its own, or go on with a prompt whose executive died."""
    options = msgspec.convert(plain, Options, dec_hook=lambda kind, value: kind(value))
    return prompt(options, handle=handle)


def _setting(options: Options) -> request.Setting:
    vary_seed = options.seed if options.vary else None
    return request.setting(REALITY, options.world, robot=options.robot, vary_seed=vary_seed)


def prompt(options: Options, *, handle: Handle | None = None) -> int:
    """The prompt itself; `handle` is that of a live robot."""
    with speaking.opened(wanted=options.voice, model=options.voice_model) as speech:
        with conversation(options, handle=handle, speech=speech) as shell:
            if sys.stdin.isatty() and sys.stdout.isatty():
                return _at_terminal(shell, options, handle)
            work_off(shell, sys.stdin)
            status = status_of(shell)
        speech.finish()
        return status


def _at_terminal(shell: Shell, options: Options, handle: Handle | None) -> int:
    """Prompt on a terminal until the person leaves; returns the exit status."""
    from executive.frontends.prompt.terminal import Terminal

    if handle is not None and handle.deaths > 0:
        say("The prompt is back; the robot goes on with what was open.")
    kind = "fast" if handle is None else "live"
    say(f"{options.robot} in {options.world}, {kind}. `help` shows what can be said.")
    Terminal(shell, history=HISTORY.expanduser()).run()
    shell.speech.hush()
    if shell.gone:
        return BROKEN
    say("The robot comes to a stand." if shell.robot.busy else "The robot stands.")
    return DONE


@contextmanager
def conversation(
    options: Options, *, handle: Handle | None = None, speech: Speech
) -> Generator[Shell]:
    """A robot to talk to, and what comes of what is said.

    Args:
        options: of the prompt.
        handle: of a live robot.
        speech: says aloud what is for ears.
    """
    where, folder = _setting(options), options.folder
    assert folder is not None
    kind: runtimes.Kind = "fast" if handle is None else "live"
    robot = Robot(
        lambda: runtimes.opened(kind, where, seed=options.seed, folder=folder, handle=handle),
        where=where,
        seed=options.seed,
        folder=folder,
        wall=WallClock(),
        time_of_day=lambda: datetime.now().astimezone().timestamp(),
        idles=kind == "live",
        returning=handle is not None and handle.deaths > 0,
        left_by=options.left_by,
    )
    with ExitStack() as stack:
        with Console(stderr=True).status("starting the robot"):
            stack.enter_context(robot)
        stack.enter_context(robot.interrupts.listen())
        model = language_model(options.model)
        shell = Shell(robot, say, table=commands.table, folder=folder, model=model, speech=speech)
        for event in robot.session.journal.recent:
            if event.event == "resumed":  # before anybody listened
                _tell(event)
        robot.session.journal.listen(_tell)
        robot.session.journal.listen(speech.note)
        yield shell


def say(text: str) -> None:
    """A line for people; above the prompt where there is one."""
    console = Console(file=sys.stdout, highlight=False)
    console.print(text, markup=False, soft_wrap=not console.is_terminal)


def _tell(event: Event) -> None:
    """What happens, as it happens."""
    told = words(event)
    if told:
        say(f"[{event.t_s:7.2f} s] {told}")


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
        return BROKEN
    if shell.refused:
        return INVALID
    failed = any(job.state in ("failed", "cancelled") for job in shell.robot.executive.jobs)
    return FAILED if failed else DONE
