"""What goes over the link beside requests, and what a role may ask.

A link carries the lines of `executive.frontends.service.messages`, and two more: a beat, ten times
a second, by which the gate knows that the link holds, and a goodbye, after which it need not. The
gate answers each beat, so that the other end knows the same.
"""

from __future__ import annotations

import re

import msgspec

from executive.frontends.emergency import AT_THE_ROBOT, emergency, plain, undoes
from executive.frontends.remote.invitation import Role
from executive.frontends.service import messages as m
from intents.letters import latin
from intents.stopping import is_stop

BEAT_S = 0.1
LOST_S = 0.35
"""A link that is silent for so long is lost: the stop is given within 0.5 s of its last beat."""
ANYBODYS: tuple[m.Button, ...] = ("stop", "estop", "pause")
"""What everybody may press who was let in."""
NOBODYS: tuple[m.Button, ...] = ("release", "reset")
"""Whoever undoes an emergency stop has to see the robot, and who stands near it."""
_LETTERS = re.compile(r"[^a-z]+")


class Beat(msgspec.Struct, frozen=True, tag_field="ask", tag="beat", forbid_unknown_fields=True):
    """The link holds."""


class Bye(msgspec.Struct, frozen=True, tag_field="ask", tag="bye", forbid_unknown_fields=True):
    """The link is ended on purpose: the robot goes on."""


_lines = msgspec.json.Decoder(m.Request | Beat | Bye)
BEAT, BYE = msgspec.json.encode(Beat()) + b"\n", msgspec.json.encode(Bye()) + b"\n"
ECHO = b'{"tell":"beat"}\n'


def line(data: bytes) -> m.Request | Beat | Bye:
    """What a line over the link says. Raises msgspec.DecodeError, RecursionError."""
    return _lines.decode(data)


def asked_by(role: Role, asked: m.Request) -> m.Request:
    """What is asked by somebody of a role: a line of one who may only stop is that button.

    A line is read where it is worked off, by what the robot is at: what is a cry to one at work
    may be an errand to another ("walk to the table and stop").
    """
    if role == "command" or not isinstance(asked, m.Say) or _undoes(asked.text):
        return asked
    if emergency(asked.text) is not None:
        return m.Press(number=asked.number, button="estop")
    if is_stop(asked.text):
        return m.Press(number=asked.number, button="stop")
    return asked


def sent(data: bytes, now_s: float) -> bytes:
    """A line of a terminal as it goes over the link: when that began, by this machine's clock.

    Args:
        data: the line; what is none goes on as it is.
        now_s: seconds since boot.
    """
    try:
        asked = m.request(data)
    except (msgspec.DecodeError, RecursionError):
        return data
    if not isinstance(asked, m.Say | m.Watch) or asked.begun_s is None:
        return data
    ago_s = min(max(0.0, now_s - asked.begun_s), m.MOST_AGO_S)
    return m.line_of(msgspec.structs.replace(asked, begun_s=None, ago_s=ago_s))


def arrived(asked: m.Request, now_s: float) -> m.Request:
    """What came over the link, as it is asked of the robot by a terminal of this machine.

    Args:
        asked: what came.
        now_s: when that was, in seconds since boot.
    """
    if not isinstance(asked, m.Say | m.Watch):
        return asked
    begun_s = now_s - (asked.ago_s or 0.0)
    here = msgspec.structs.replace(asked, begun_s=begun_s, ago_s=None)
    return msgspec.structs.replace(here, afar=True) if isinstance(here, m.Say) else here


def refusal(role: Role, asked: m.Request) -> str:
    """Why a role may not ask something, as a sentence with its cure; empty: it may."""
    match asked:
        case m.Press(button=button) if button in NOBODYS:
            return f"estop {button} is for somebody who stands at the robot."
        case m.Down():
            return "Only at the robot itself it is ended; `humanoid stop` stops it from here."
        case m.Say(text=text) if _undoes(text):
            return AT_THE_ROBOT
        case m.Press(button=button) if button in ANYBODYS:
            return ""
        case m.Status() | m.Halt():
            return ""
        case m.Queue() | m.Watch() | m.Await() if role != "stop":
            return ""
        case _ if role == "command":
            return ""
        case _:
            return (
                f"This invitation is for the role {role}, which may not do that; "
                "one for `--role command` may."
            )


def _undoes(text: str) -> bool:
    """Whether a line may undo an emergency stop, however it is written."""
    letters = _LETTERS.sub("", latin(plain(text)))
    worded = letters.startswith("estop") and bool(re.search(r"release|reset", letters))
    return worded or undoes(text)
