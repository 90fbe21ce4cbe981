"""The commands of the prompt, as one table."""

from __future__ import annotations

from executive.frontends.prompt.command import Command
from executive.frontends.prompt.commands import keeping, seeing, steering
from executive.frontends.prompt.shell import Shell


def commands(shell: Shell) -> tuple[Command, ...]:
    """Every command, in the order in which `help` shows them."""
    return (*seeing.commands(shell), *steering.commands(shell), *keeping.commands(shell))
