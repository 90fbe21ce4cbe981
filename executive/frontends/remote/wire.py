"""What goes over the link beside requests, and what a role may ask.

A link carries the lines of `executive.frontends.service.messages`, and two more: a beat, ten times
a second, by which the gate knows that the link holds, and a goodbye, after which it need not. The
gate answers each beat with its clock's time, so that the other end knows the same; so it does
before whatever it tells (`RobotClock`).
"""

from __future__ import annotations

import asyncio
import math
import re
import socket
from contextlib import suppress

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
_TCP_THIN_LINEAR_TIMEOUTS = 16
"""<linux/tcp.h>."""
_LETTERS = re.compile(r"[^a-z]+")


class Beat(msgspec.Struct, frozen=True, tag_field="ask", tag="beat", forbid_unknown_fields=True):
    """The link holds."""


class Bye(msgspec.Struct, frozen=True, tag_field="ask", tag="bye", forbid_unknown_fields=True):
    """The link is ended on purpose: the robot goes on."""


class Echo(msgspec.Struct, frozen=True, tag_field="tell", tag="beat", forbid_unknown_fields=True):
    """The gate heard; `now_s`: when it says so, in seconds since the boot of its machine."""

    now_s: float


_lines = msgspec.json.Decoder(m.Request | Beat | Bye)
_echoes = msgspec.json.Decoder(Echo)
BEAT, BYE = msgspec.json.encode(Beat()) + b"\n", msgspec.json.encode(Bye()) + b"\n"
_ECHO_BEGINS = b'{"tell":"beat"'


def line(data: bytes) -> m.Request | Beat | Bye:
    """What a line over the link says. Raises msgspec.DecodeError, RecursionError."""
    return _lines.decode(data)


def hasten(connection: socket.socket) -> None:
    """Have a connection send at once, and again soon where a packet is lost.

    Beats are few and small: what Linux calls a thin stream. Without the option each packet that is
    lost again doubles the wait, beyond `LOST_S` at the second (tcp(7), Documentation/networking/
    tcp-thin.rst of the kernel).
    """
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    with suppress(OSError):  # another system
        connection.setsockopt(socket.IPPROTO_TCP, _TCP_THIN_LINEAR_TIMEOUTS, 1)


async def beat(writer: asyncio.StreamWriter) -> None:
    """Beat until that is pointless."""
    while not writer.transport.is_closing():
        writer.write(BEAT)
        await asyncio.sleep(BEAT_S)


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


def echo(now_s: float) -> bytes:
    """The line by which the gate says that it hears, at a time of its clock [s]."""
    return msgspec.json.encode(Echo(now_s)) + b"\n"


def echoed_s(data: bytes) -> float | None:
    """When the gate said that it hears, by its clock [s]; None: the line says something else."""
    if not data.startswith(_ECHO_BEGINS):
        return None
    with suppress(msgspec.DecodeError):
        return _echoes.decode(data).now_s
    return None


class RobotClock:
    """The clock of the robot's machine, as far as it is known here: never ahead of it.

    What the robot's clock showed when something was sent is less than what it shows when that
    arrives; so whatever was begun here before a stop is told as begun before it, however long the
    way is, and what was begun after the robot had told of the stop as begun after it.
    """

    DRIFT = 1e-3
    """More than any two clocks part [s/s]."""

    def __init__(self) -> None:
        """Nothing is known of it."""
        self._ahead_s = -math.inf
        self._heard_s = 0.0

    def hear(self, there_s: float, here_s: float) -> None:
        """It showed `there_s` when that was sent, and the clock here `here_s` when it came."""
        known_s = self._ahead_s - self.DRIFT * (here_s - self._heard_s)
        self._ahead_s, self._heard_s = max(there_s - here_s, known_s), here_s

    def at(self, here_s: float) -> float:
        """What it showed at least when the clock here showed `here_s`; 0 if nothing is known."""
        return max(0.0, here_s + self._ahead_s)


def sent(data: bytes, clock: RobotClock) -> bytes:
    """A line of a terminal as it goes over the link: when it was begun, by the robot's clock.

    Args:
        data: the line; what is none goes on as it is.
        clock: the robot's.
    """
    try:
        asked = m.request(data)
    except (msgspec.DecodeError, RecursionError):
        return data
    if not isinstance(asked, m.Say | m.Watch) or asked.begun_s is None:
        return data
    return m.line_of(msgspec.structs.replace(asked, begun_s=clock.at(asked.begun_s)))


def arrived(asked: m.Request, now_s: float) -> m.Request:
    """What came over the link, as it is asked of the robot by a terminal of this machine.

    Args:
        asked: what came.
        now_s: when that was, in seconds since boot.
    """
    if not isinstance(asked, m.Say | m.Watch):
        return asked
    begun_s = now_s if asked.begun_s is None else min(now_s, asked.begun_s)
    here = msgspec.structs.replace(asked, begun_s=begun_s)
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
