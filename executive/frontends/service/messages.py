"""What is asked of a robot that is up, and what it tells: a closed table, a line of JSON each.

A request has a number of its asker's; what is told with that number is about it, and `Ended` is the
last of that. What is told with the number 0 is for whoever `Watch`es; prompts are told more
(`executive.frontends.service.views`).
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

import msgspec
from msgspec import Meta

MAX_TEXT = 1 << 14
MAX_REQUEST = 1 << 16
"""Bytes of a request; JSON may write a letter with six."""
MAX_TOLD = 1 << 22

Button = Literal["stop", "estop", "release", "reset", "pause", "resume", "cancel"]
BUTTONS: tuple[Button, ...] = get_args(Button)
Text = Annotated[str, Meta(max_length=MAX_TEXT)]
MAX_REASON = 100
MOST_JOBS = 1000
"""That somebody may wait for at once."""
Reason = Annotated[str, Meta(max_length=MAX_REASON)]


class _Request(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True,
               tag_field="ask"):  # fmt: skip
    number: int = 0


class Status(_Request, frozen=True, kw_only=True, tag="status"):
    """How the robot is and what it does."""


class Queue(_Request, frozen=True, kw_only=True, tag="queue"):
    """What is to be done."""


class Press(_Request, frozen=True, kw_only=True, tag="press"):
    """A button: it acts at once, whatever the robot is about.

    Attributes:
        why: is told of what ends by it.
        quiet: a stop that finds nothing to stop says nothing.
    """

    button: Button
    why: Reason = ""
    quiet: bool = False


class Say(_Request, frozen=True, kw_only=True, tag="say"):
    """A line, as at the prompt.

    Attributes:
        wait: it ends when all that comes of it is over.
        stops: so often the robot had been told to stop, as far as was known where the line was
            typed; a stop since then is about this line too (None: as when it arrives).
        begun_s: when it was asked for, in seconds since the boot of the robot's machine, where how
            often is not known.
        spoken: it is a sentence, or an answer, and no command of the prompt.
        afar: whoever says it may not see the robot, nor who stands near it.
    """

    text: Text
    wait: bool = False
    stops: int | None = None
    begun_s: float | None = None
    spoken: bool = False
    afar: bool = False


class Halt(_Request, frozen=True, kw_only=True, tag="halt"):
    """A line that may be a cry to halt, heard before it is a line: it acts at once."""

    text: Text


Rate = Annotated[float, Meta(ge=-100.0, le=100.0)]
"""More than any robot walks [m/s] or turns [rad/s]."""


class Drive(_Request, frozen=True, kw_only=True, tag="drive"):
    """Walk at a velocity for half a second, if nothing else walks (`executive.engine`).

    What comes of it is `Words` that say why it does not, if it does not.
    """

    forward_m_s: Rate = 0.0
    left_m_s: Rate = 0.0
    turn_rad_s: Rate = 0.0


class Await(_Request, frozen=True, kw_only=True, tag="await"):
    """End when jobs are over that were asked for before, of an executive that is gone maybe."""

    jobs: Annotated[tuple[int, ...], Meta(max_length=MOST_JOBS)]


class Watch(_Request, frozen=True, kw_only=True, tag="watch"):
    """Be told from now on what is said, asked and done.

    Attributes:
        views: and how the robot is.
        recent: and, first, what was said before.
        begun_s: when whoever watches began, in seconds since boot: a stop since then is about
            what was handed to them.
    """

    views: bool = False
    recent: bool = True
    begun_s: float | None = None


class Down(_Request, frozen=True, kw_only=True, tag="down"):
    """Come to a stand, and end."""


Request = Status | Queue | Press | Say | Halt | Drive | Await | Watch | Down


class AnyTold(msgspec.Struct, frozen=True, kw_only=True, tag_field="tell"):
    """Something that is told."""

    number: int = 0


class Words(AnyTold, frozen=True, kw_only=True, tag="words"):
    """A line for people."""

    text: str


class Queued(AnyTold, frozen=True, kw_only=True, tag="queued"):
    """The jobs that came of a line."""

    jobs: tuple[int, ...]


class Ended(AnyTold, frozen=True, kw_only=True, tag="ended"):
    """A request is over, with what a command that made it exits with; `stops`: heard so far."""

    status: int
    stops: int = 0
    standing: Standing | None = None


class Asks(AnyTold, frozen=True, kw_only=True, tag="asks"):
    """What the robot asks a person now; no question: nothing."""

    question: str = ""
    choices: tuple[str, ...] = ()


class Stopped(AnyTold, frozen=True, kw_only=True, tag="stopped"):
    """So often the robot was told to stop by now, by whomever."""

    stops: int


class Waiting(msgspec.Struct, frozen=True, kw_only=True):
    """A job, as it stands."""

    number: int
    state: str
    text: str
    urgent: bool = False


class Standing(msgspec.Struct, frozen=True, kw_only=True):
    """How a robot is, for programs: `humanoid status --json`.

    Attributes:
        state: of the executive: idle, working, pausing, paused, stopping; "gone".
        mode: of the body: damping, stand, walk, fallen; "gone".
        pose: estimated x [m], y [m] and heading [degrees] in the world.
        health: what ails it; empty while all is well.
        asks: what it asks a person.
        ready: whether it begins what it is told: it stands, and nothing holds it.
        jobs: that are not over.
    """

    name: str
    run: str
    robot: str
    world: str
    runtime: str
    pid: int
    state: str
    mode: str
    health: str
    asks: str
    ready: bool = True
    estop: bool
    time_s: float
    pose: tuple[float, float, float] | None = None
    held: tuple[str, ...] = ()
    jobs: tuple[Waiting, ...] = ()


Told = Words | Queued | Ended | Asks | Stopped

_requests = msgspec.json.Decoder(Request)
_tellings = msgspec.json.Decoder(Told)


def request(line: bytes) -> Request:
    """What a line asks. Raises msgspec.DecodeError, RecursionError."""
    return _requests.decode(line)


def told(line: bytes) -> Told:
    """What a line tells those who show no prompt. Raises msgspec.DecodeError, RecursionError."""
    return _tellings.decode(line)


def line_of(message: Request | AnyTold) -> bytes:
    """A message as a line."""
    return msgspec.json.encode(message) + b"\n"
