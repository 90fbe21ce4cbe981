"""What one program asks boards: its session, its sequence; questions outside of the periods."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from robot.clock import Clock
from robot.drivers.motors.ethernet.datagrams import ANSWER, TURN, Datagram, Kind, opened, packed
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import Ports

WAITS_S = (0.02, 0.05, 0.15)
"""For one try after the other: a busy machine may take its time."""
POLL_S = 0.0005
ANYBODY = 255
"""No board's number: whoever is at an address says who it is."""


class Question(NamedTuple):
    """To one board: what, about which joints (a mask), with what."""

    kind: Kind
    joints: int = 0
    body: bytes = b""


class Talk:
    """Asks all boards at once, and never waits longer than it was told to.

    Attributes:
        session: of this program, drawn anew for each driver.
        sequence: of what was asked last.
        refused: datagrams that were no answer to what was asked, by board and reason.
    """

    def __init__(self, ports: Ports, clock: Clock, joints: DriveMap) -> None:
        """Over ports that are open."""
        self.ports, self.clock, self.joints = ports, clock, joints
        self.session = int.from_bytes(os.urandom(4), "little")
        self.sequence = int.from_bytes(os.urandom(4), "little")
        self.refused = {board: Counter[str]() for board in joints.boards}

    def begin(self) -> tuple[int, int]:
        """The next sequence, and the time, for what is asked now."""
        self.sequence = (self.sequence + 1) % TURN
        return self.sequence, max(0, int(1e6 * self.clock.now_s()))

    def datagram(self, board: str, question: Question, sequence: int, time_us: int) -> bytes:
        """A question on its way to a board."""
        kind, mask, body = question
        number = ANYBODY if kind == Kind.HELLO else self.joints.boards[board].number
        return packed(Datagram(kind, number, mask, self.session, sequence, time_us, body))

    def ask(self, questions: Mapping[str, Question], *, wait_s: float) -> dict[str, Datagram]:
        """Ask, once; the answers that came, by board."""
        self.ports.receive()  # what nobody waits for any more
        sequence, time_us = self.begin()
        for board, question in questions.items():
            self.ports.send(board, self.datagram(board, question, sequence, time_us))
        said: dict[str, Datagram] = {}
        until_s = self.clock.now_s() + wait_s
        while True:
            for board, data in self.ports.receive():
                answer = opened(data)
                if not isinstance(answer, Datagram):
                    self.refused[board][answer] += 1
                elif board in questions and self._fits(answer, questions[board], sequence):
                    said.setdefault(board, answer)
                else:
                    self.refused[board]["late"] += 1
            if len(said) == len(questions) or self.clock.now_s() >= until_s:
                return said
            self.clock.sleep_until(min(until_s, self.clock.now_s() + POLL_S))

    def _fits(self, answer: Datagram, question: Question, sequence: int) -> bool:
        """Whether it answers what was asked just now."""
        found = (answer.kind, answer.session, answer.sequence)
        return found == (question.kind | ANSWER, self.session, sequence)

    def ask_all(self, questions: Mapping[str, Question]) -> dict[str, Datagram]:
        """Ask, and ask those again that did not answer; the answers, by board.

        An answer of another board than the map says is at an address counts to a HELLO alone.
        """
        missing, said = dict(questions), dict[str, Datagram]()
        for wait_s in WAITS_S:
            for board, answer in self.ask(missing, wait_s=wait_s).items():
                number = self.joints.boards[board].number
                if answer.board == number or missing[board].kind == Kind.HELLO:
                    said[board] = answer
                    del missing[board]
            if not missing:
                break
        return said
