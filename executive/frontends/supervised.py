"""Live commands from the command line's side: a launcher here, the executive in a child."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

import typer

from executive.frontends.exit import last_words
from robot.bringup import launcher


class FrontEnd(StrEnum):
    """What an executive can be there for; `executive.main` has the function of each."""

    DO = "do"
    LISTEN = "listen"
    MISSION = "mission"
    PROMPT = "prompt"
    RESUME = "resume"


def oversee(front: FrontEnd, options: dict[str, Any], *, as_json: bool) -> int:
    """Run a front end in an executive of its own, and start it again should it die.

    Args:
        front: which one; it goes on with its run where an executive died before it.
        options: plain data.
        as_json: nothing but JSON goes to standard output.
    """
    ended = launcher.launch(front, options, tell=lambda line: typer.echo(line, err=True))
    if ended.reason:
        cure = "see `humanoid why`; `humanoid resume` goes on where it was"
        return last_words("Broken:", [ended.reason], cure, status=ended.status, as_json=as_json)
    return ended.status
