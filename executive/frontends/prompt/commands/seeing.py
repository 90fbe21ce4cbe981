"""Commands that only look."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from executive.blackboard import KEYS
from executive.frontends.prompt.command import Command, one_of
from executive.frontends.prompt.commands.job_words import is_number, number_of, row
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.watch import Watch
from executive.journal import past_runs
from executive.journal.dumps.text import picture
from executive.journal.snapshot import at_work
from executive.journal.why import told

PAST_SHOWN = 10
"""Runs before this one that `history` shows: they fit on a screen."""
KEY_NAMES = tuple(key.name for key in KEYS)


def commands(shell: Shell) -> tuple[Command, ...]:
    """Every one of them, in the order in which `help` shows them."""
    does = _Seeing(shell)
    return (
        Command(
            name="status", usage="status", summary="how the robot is and what it does",
            run=does.status,
        ),
        Command(
            name="tree", usage="tree [on|off]", summary="the running task, once or kept in sight",
            run=does.tree, accepts=one_of("", "on", "off"), choices=lambda: ("on", "off"),
        ),
        Command(
            name="watch", usage="watch KEY", summary="tell when a value on the blackboard changes",
            run=does.watch, accepts=one_of("", *KEY_NAMES), choices=lambda: KEY_NAMES,
            kind="key",
        ),
        Command(
            name="unwatch", usage="unwatch [KEY]", summary="watch it no more",
            run=does.unwatch, accepts=one_of("", *KEY_NAMES), choices=does.watched,
        ),
        Command(
            name="why", usage="why [N]",
            summary="why a job ended, or what it is at: N, or the newest",
            run=does.why, accepts=is_number,
        ),
        Command(
            name="history", usage="history", summary="the jobs of this run, and the runs before",
            run=does.history,
        ),
        Command(
            name="plan", usage="plan SENTENCE",
            summary="what it would do and how long that takes, without doing it",
            run=does.plan, accepts=bool, takes_sentence=True,
        ),
    )  # fmt: skip


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
            self._shell.out(f"  {row(job)}")
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
