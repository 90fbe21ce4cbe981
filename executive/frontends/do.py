"""What the commands of the command line do, from their options to an exit status."""

from __future__ import annotations

import sys
from datetime import datetime
from pathlib import Path
from typing import Any

import msgspec
import typer
from msgspec.structs import replace
from rich.console import Console
from rich.markup import escape

from executive.engine.executive import Executive
from executive.engine.loop import Interrupts
from executive.frontends import doctor as examination
from executive.frontends import speaking
from executive.frontends.dump.writer import along
from executive.frontends.language_model import language_model
from executive.frontends.progress import Lines, LiveTree, Silent
from executive.frontends.reality import REALITY
from executive.frontends.speaking import Speech
from executive.frontends.supervised import FrontEnd, oversee
from executive.journal import failures
from executive.meaning import request
from executive.runs import continuation, run_folder, runtimes, steady_walk, task_run
from executive.runs.task_run import Progress
from intents.goals import from_builtins, to_builtins
from intents.outcomes import Question
from robot.bringup.mailbox import Handle
from robot.clock import WallClock
from robot.errors import Failure
from robot.messages import BodyState

DONE, FAILED, INVALID, BROKEN = 0, 1, 2, 3


class Do(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid do`."""

    text: str
    world: str
    robot: str
    seed: int
    fast: bool
    vary: bool
    folder: Path | None
    as_json: bool
    dump: Path | None = None
    dump_on: str = "end"
    dump_format: str = "html"
    model: Path | None = None
    voice: bool = False
    voice_model: Path | None = None


class Walk(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid walk`."""

    twist: steady_walk.Twist
    world: str
    robot: str
    seed: int
    fast: bool
    as_json: bool


def do(options: Do) -> int:
    """Understand, check, and only then start a robot and do it; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    where = _setting(options)
    options = replace(options, voice=speaking.able(wanted=options.voice, model=options.voice_model))
    understood = _understood(options, where)
    if isinstance(understood, request.Refused):
        return refuse(understood, as_json=options.as_json)
    stamp = f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
    folder = options.folder or run_folder.folder_for(options.text, stamp=stamp)
    run_folder.check_free(folder)
    options = replace(options, folder=folder)
    if options.fast:
        return carry_out(options, understood, where)
    task = {
        "as_json": options.as_json,
        "options": msgspec.to_builtins(options, enc_hook=str),
        "goals": to_builtins(understood.goals),
    }
    return oversee(FrontEnd.DO, task, as_json=options.as_json)


def _understood(options: Do, where: request.Setting) -> request.Understood | request.Refused:
    """What the sentence means here; who is at the terminal is asked back, aloud where wanted."""
    asking = at_terminal() and not options.as_json
    model = language_model(options.model)
    with speaking.opened(wanted=options.voice, model=options.voice_model) as speech:

        def aloud(question: Question) -> str | None:
            speech.say(question.question)
            answer = ask(question)
            speech.hush()
            return answer

        meant = request.request(options.text, where, ask=aloud if asking else None, fallback=model)
        if isinstance(meant, request.Refused):
            if model is not None and model.trouble:
                typer.echo(f"The language model was of no help: {model.trouble}.", err=True)
            if not asking or meant.outcome != "question":
                speech.say(meant.reason)
                speech.finish()
    return meant


def do_overseen(handle: Handle, task: dict[str, Any]) -> int:
    """Do a task in an executive of its own, or go on with it; returns the exit status.

    Raises:
        RobotError: as `do` does.
    """
    options = msgspec.convert(task["options"], Do, dec_hook=_made)
    where = _setting(options)
    understood = request.meant(options.text, from_builtins(task["goals"]), where)
    if isinstance(understood, request.Refused):
        return refuse(understood, as_json=options.as_json)
    return carry_out(options, understood, where, handle=handle)


def _made(kind: type[Any], value: object) -> object:
    """A path, from plain data."""
    return kind(value)


def _setting(options: Do) -> request.Setting:
    vary_seed = options.seed if options.vary else None
    return request.setting(REALITY, options.world, robot=options.robot, vary_seed=vary_seed)


def carry_out(
    options: Do,
    understood: request.Understood,
    where: request.Setting,
    *,
    handle: Handle | None = None,
) -> int:
    """Do a task that was understood (or go on with it); the exit status."""
    job = task_run.Job(
        understood=understood,
        where=where,
        seed=options.seed,
        runtime_name="fast" if options.fast else "live",
        folder=options.folder,
    )
    return work_off(job, options, handle=handle)


def work_off(job: task_run.Job, options: Do, *, handle: Handle | None = None) -> int:
    """Open the runtime, do a job (or go on with it), say how it ended; the exit status."""
    with speaking.opened(wanted=options.voice, model=options.voice_model) as speech:
        summary = _worked_off(job, options, speech, handle)
        if options.as_json:
            echo_json(summary)
        else:
            typer.echo("\n".join(task_run.closing(summary)))
        speech.finish()
    return summary.exit_status


def _worked_off(
    job: task_run.Job, options: Do, speech: Speech, handle: Handle | None
) -> run_folder.Summary:
    """The same, but for the last words."""
    kind: runtimes.Kind = "fast" if options.fast else "live"
    show = along(
        silent if options.as_json else on_screen,
        options.dump,
        on=options.dump_on,
        formats=options.dump_format,
    )

    def shown(executive: Executive) -> Progress:
        executive.journal.listen(speech.note)
        return show(executive)

    where = job.where
    interrupts = Interrupts()
    with (
        interrupts.listen(),
        runtimes.opened(kind, where, seed=options.seed, folder=options.folder, handle=handle) as (
            runtime,
            planner,
        ),
    ):
        work = continuation.do if handle is not None and handle.deaths else task_run.do
        return work(
            job,
            runtime,
            planner,
            show=shown,
            wall=WallClock(),
            time_of_day=lambda: datetime.now().astimezone().timestamp(),
            interrupts=interrupts,
        )


def silent(_executive: Executive) -> Progress:
    """Show nothing (`--json`)."""
    return Silent()


def on_screen(executive: Executive) -> Progress:
    """A live tree on a terminal, plain lines elsewhere."""
    console = Console()
    if console.is_terminal:
        return LiveTree(executive, console, wall_s=WallClock().now_s)
    return Lines(executive, console)


def at_terminal() -> bool:
    """Whether somebody can be asked."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def ask(question: Question) -> str | None:
    """Put an open question to the person at the terminal."""
    try:
        answer = typer.prompt(question.question, default="", show_default=False, prompt_suffix=" ")
    except (typer.Abort, EOFError):
        typer.echo()  # what is said next begins a line
        return None
    return str(answer) or None


def refuse(refused: request.Refused, *, as_json: bool) -> int:
    """Say why nothing is done."""
    if as_json:
        record = {"status": "invalid", "exit_status": INVALID, **msgspec.to_builtins(refused)}
        echo_json(record)
        return INVALID
    heading = "Question" if refused.outcome == "question" else "Not done"
    typer.echo("\n".join([f"{heading}: {refused.reason}", *failures.advice(refused.suggestion)]))
    return INVALID


def walk(options: Walk) -> int:
    """Walk at a twist, then stand; returns the exit status. Raises RobotError as `do` does."""
    where = request.setting(REALITY, options.world, robot=options.robot)
    refusal = steady_walk.check(options.twist, where.description)
    if refusal is not None:
        return refuse(request.refused(refusal), as_json=options.as_json)
    interrupts, wall = Interrupts(), WallClock()
    begun_s = wall.now_s()
    kind: runtimes.Kind = "fast" if options.fast else "live"
    with (
        interrupts.listen(),
        runtimes.opened(kind, where, seed=options.seed, folder=None) as (runtime, _),
    ):
        with Console(quiet=options.as_json).status("walking") as status:

            def show(body: BodyState) -> None:
                status.update(f"walking: {body.stamp_s:.0f} of {options.twist.duration_s:.0f} s")

            walked = steady_walk.walk(runtime, options.twist, interrupts=interrupts, on_tick=show)
        past_s = runtime.clock.now_s()
        late = task_run.late_periods(runtime)
    if options.as_json:
        echo_json(walked)
    else:
        lines = _walk_words(walked, past_s, wall.now_s() - begun_s)
        typer.echo("\n".join([*lines, *(f"  {line}" for line in late)]))
    return _walk_status(walked.failure)


def _walk_status(reason: Failure | None) -> int:
    if reason is None:
        return DONE
    return BROKEN if reason.code in run_folder.BROKEN else FAILED


def _walk_words(walked: steady_walk.Walked, past_s: float, wall_s: float) -> list[str]:
    reason = walked.failure
    lines = [
        failures.verdict(reason),
        f"  walked {walked.walked_s:.1f} s: {walked.forward_m:.2f} m forward, "
        f"{walked.left_m:.2f} m to the left, {walked.turned_rad:.2f} rad turned (estimated)",
        f"  {past_s:.1f} s of robot time in {wall_s:.1f} s ({past_s / wall_s:.1f} x), "
        f"{walked.clamped} commands clamped",
    ]
    if reason is not None:
        lines += failures.advice(failures.suggestion(reason.code, reason.suggestion))
    return lines


def doctor(*, as_json: bool) -> int:
    """Examine the machine; returns the exit status, 2 if something needed is missing."""
    findings = examination.examine()
    status = INVALID if any(finding.verdict == "missing" for finding in findings) else DONE
    if as_json:
        echo_json(findings)
        return status
    console = Console(highlight=False, soft_wrap=True)
    marks = {"ok": "[green]ok[/]", "optional": "[yellow]--[/]", "missing": "[red]no[/]"}
    for finding in findings:
        console.print(f"{marks[finding.verdict]}  {finding.name:14} {escape(finding.text)}")
        if finding.cure:
            console.print(f"    [dim]cure:[/] {escape(finding.cure)}")
    missing = "Something that is needed is missing; see its cure above."
    console.print(missing if status else "All that is needed is there.")
    return status


def echo_json(value: object) -> None:
    """Print a value as one line of JSON."""
    typer.echo(msgspec.json.encode(value, order="deterministic"))
