"""What a prompt of another process is told of a robot, besides words: how it is, and its names.

Whoever only wants it to stop need not load what this takes.
"""

from __future__ import annotations

import msgspec

from executive.frontends.prompt.view import View
from executive.frontends.service.messages import AnyTold, Told
from intents.vocabulary import Vocabulary


class Seen(AnyTold, frozen=True, kw_only=True, tag="seen"):
    """How the robot is, some times a second."""

    view: View
    busy: bool


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """A command of the prompt, for those who complete what is typed."""

    name: str
    usage: str
    summary: str
    choices: tuple[str, ...] = ()
    takes_sentence: bool = False


class Hello(AnyTold, frozen=True, kw_only=True, tag="hello"):
    """What a prompt has to know before the first line.

    Attributes:
        pid: of the executive.
        stops: so often it was told to stop.
        stops_begun: so often it had been when the prompt began.
    """

    pid: int
    run: str
    robot: str
    world: str
    vocabulary: Vocabulary
    commands: tuple[Row, ...]
    stops: int
    stops_begun: int


_tellings = msgspec.json.Decoder(Told | Seen | Hello)


def told(line: bytes) -> Told | Seen | Hello:
    """What a line tells. Raises msgspec.DecodeError, RecursionError."""
    return _tellings.decode(line)
