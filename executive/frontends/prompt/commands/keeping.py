"""Commands about the run and the prompt themselves."""

from __future__ import annotations

from pathlib import Path
from shlex import quote
from shutil import get_terminal_size

from executive.frontends.prompt import saving
from executive.frontends.prompt.command import Command, begins
from executive.frontends.prompt.shell import Shell
from executive.skills.catalogue import SKILLS
from robot.errors import ConfigError

WIDE_COLUMNS = 120
"""A terminal that shows a command and what it does on one line."""


def commands(shell: Shell) -> tuple[Command, ...]:
    """Every one of them, in the order in which `help` shows them."""
    does = _Keeping(shell)
    skills = [skill.name for skill in SKILLS]
    return (
        Command(
            name="save", usage="save mission FILE", summary="keep what was done as a mission",
            run=does.save, accepts=begins("mission", bare=False), choices=lambda: ("mission",),
            files=bool,
        ),
        Command(
            name="help", usage="help [COMMAND | skills]",
            summary="this list, or one command, or what the robot can do",
            run=does.help, choices=lambda: ("skills", *shell.commands), kind="command",
            accepts=lambda rest: rest in ("", "skills", *shell.commands, *skills),
        ),
        Command(
            name="quit", usage="quit", summary="stop, and leave (also Ctrl-D)", run=does.quit
        ),
        Command(name="exit", usage="exit", summary="the same", run=does.quit),
    )  # fmt: skip


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

    def help(self, rest: str) -> None:
        commands = self._shell.commands
        if rest == "skills":
            width = max(len(skill.name) for skill in SKILLS)
            for skill in SKILLS:
                self._shell.out(f"  {skill.name:{width}} {skill.summary}")
            return
        if skill := next((one for one in SKILLS if one.name == rest), None):
            self._shell.out(f"{skill.name} is a skill, which sentences lead to.\n  {skill.summary}")
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

    def quit(self, _rest: str) -> None:
        self._shell.leaving = True
