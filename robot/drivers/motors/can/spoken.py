"""Settings that motors say as text over their bus: asked for and set, a line after the other.

A motor answers on its console, which says what it has to say when it is asked; nothing in an answer
says which question it belongs to. So the console is emptied before every line, and a line is said
anew, after that, if its answer did not come whole.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from robot.drivers.motors.can.console import MotorConsole
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.ports import Heard

SAME_SHARE = 1e-3
"""A setting comes back as a single float, and with as few digits as its firmware prints."""
MOST_ASKED = 8
"""So often the console is asked for one answer, at most: 48 bytes each."""
TRIES = 3


class Speaker(NamedTuple):
    """A motor that is spoken to: its bus, its identifier, its family's console."""

    bus: str
    id: int
    console: MotorConsole


Exchanges: TypeAlias = Callable[[list[tuple[str, Frame]], Callable[[Heard], None]], None]
"""Sends frames, and has everything heard for a while that comes then."""


class Talk:
    """With several motors at once, by joint."""

    def __init__(self, exchange: Exchanges, speakers: Mapping[str, Speaker]) -> None:
        """With these; whose a frame is, its identifier says."""
        self._exchange, self._speakers = exchange, speakers

    def settings(self, names: Mapping[str, tuple[str, ...]]) -> dict[str, dict[str, float]]:
        """What settings are, by joint and name; those that are not told or are no number lack."""
        found: dict[str, dict[str, float]] = {joint: {} for joint in names}
        for place in range(max(map(len, names.values()), default=0)):
            asked = {joint: some[place] for joint, some in names.items() if place < len(some)}
            lines = {
                joint: self._speakers[joint].console.ask_for.format(name)
                for joint, name in asked.items()
            }
            for joint, answer in self._lines(lines).items():
                if (number := _number(answer)) is not None:
                    found[joint][asked[joint]] = number
        return found

    def set(self, wanted: Mapping[str, Mapping[str, float]]) -> list[str]:
        """Set and read back; the joints whose motors did not take it."""
        for place in range(max(map(len, wanted.values()), default=0)):
            lines = {
                joint: self._speakers[joint].console.set_to.format(*list(some.items())[place])
                for joint, some in wanted.items()
                if place < len(some)
            }
            self._lines(lines)
        now = self.settings({joint: tuple(some) for joint, some in wanted.items()})
        return [
            joint
            for joint, some in wanted.items()
            if not all(
                math.isclose(now[joint].get(name, math.nan), value, rel_tol=SAME_SHARE)
                for name, value in some.items()
            )
        ]

    def _lines(self, lines: Mapping[str, str]) -> dict[str, str]:
        """The first line of each one's answer; of those that answered."""
        answers: dict[str, str] = {}
        for _ in range(TRIES):
            missing = {joint: line for joint, line in lines.items() if joint not in answers}
            if not missing:
                break
            self._hear(missing, is_over=lambda _, new: not new)  # what nobody asked for
            self._exchange([self._said(joint, line) for joint, line in missing.items()], _nothing)
            texts = self._hear(missing, is_over=lambda text, _: b"\n" in text)
            answers |= {
                joint: text.split(b"\n")[0].decode("latin1").strip()
                for joint, text in texts.items()
                if b"\n" in text
            }
        return answers

    def _said(self, joint: str, line: str) -> tuple[str, Frame]:
        one = self._speakers[joint]
        return one.bus, one.console.say(one.id, line)

    def _hear(
        self, joints: Mapping[str, str], *, is_over: Callable[[bytes, bytes], bool]
    ) -> dict[str, bytes]:
        """Ask consoles until each has said all: by all that it said, and what is new of it."""
        texts = dict.fromkeys(joints, b"")
        left = list(joints)
        for _ in range(MOST_ASKED):
            new = self._new(left)
            for joint, said in new.items():
                texts[joint] += said
            left = [
                joint for joint in left if joint not in new or not is_over(texts[joint], new[joint])
            ]
            if not left:
                break
        return texts

    def _new(self, joints: list[str]) -> dict[str, bytes]:
        """What the consoles of these say now, each asked once; of those that answered."""
        speakers = {joint: self._speakers[joint] for joint in joints}
        new: dict[str, bytes] = {}

        def take(heard: Heard) -> None:
            for joint, one in speakers.items():
                if heard.frame is None or heard.bus != one.bus or joint in new:
                    continue
                said = one.console.reply(heard.frame)
                if said is not None and said[0] == one.id:
                    new[joint] = said[1]

        frames = [(one.bus, one.console.ask(one.id)) for one in speakers.values()]
        self._exchange(frames, take)
        return new


def _nothing(_: Heard) -> None:
    """An answer that nobody waits for."""


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
