"""How full links of boards get, and by when the last answer of a period is there.

A link of Ethernet is one wire each way, so that commands and answers do not share it. All boards
hang on a switch, behind one link of the computer.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from robot.drivers.motors.ethernet.datagrams import LEAST, ORDER, feedback_size

MOST_LOAD = 0.70
"""Of a link, one way: what else is on it has to go somewhere."""
ON_TIME = 0.90
"""Of a period, by when the last answer has to be with the computer."""
FRAME_BYTES = 8 + 14 + 4 + 12
"""Of Ethernet: preamble, header, checksum, gap (IEEE 802.3)."""
LEAST_PAYLOAD = 46
HEADERS = {4: 20 + 8, 6: 40 + 8}
"""Of IP and UDP, by the version of IP."""


class BoardLink(NamedTuple):
    """One board, as far as its traffic goes.

    Attributes:
        joints: that are commanded.
        link_hz: bits a second, each way.
        turn_s: from a command's last bit to its answer's first.
        ip: version of IP.
    """

    joints: int
    link_hz: float
    turn_s: float
    ip: int

    @property
    def command_bits(self) -> int:
        """Of a command on the wire."""
        return self._bits(LEAST + self.joints * ORDER.itemsize)

    @property
    def answer_bits(self) -> int:
        """Of its answer on the wire."""
        return self._bits(LEAST + feedback_size(self.joints))

    def _bits(self, data: int) -> int:
        return 8 * (FRAME_BYTES + max(LEAST_PAYLOAD, HEADERS[self.ip] + data))

    @property
    def most_bits(self) -> int:
        """The way that is fuller."""
        return max(self.command_bits, self.answer_bits)


def load(board: BoardLink, rate_hz: float) -> float:
    """The share of its time that a board's link is busy, the way that is fuller."""
    return rate_hz * board.most_bits / board.link_hz


def uplink_load(boards: Sequence[BoardLink], rate_hz: float, uplink_hz: float) -> float:
    """The same of the computer's own link."""
    commands = sum(board.command_bits for board in boards)
    answers = sum(board.answer_bits for board in boards)
    return rate_hz * max(commands, answers) / uplink_hz


def answered_s(boards: Sequence[BoardLink], uplink_hz: float) -> float:
    """How long after a period's first command its last answer is there.

    All commands leave, the slowest board gets its own last and answers, and its answer waits behind
    all others: no order of boards is worse.
    """
    if not boards:
        return 0.0
    out_s = sum(board.command_bits for board in boards) / uplink_hz
    back_s = sum(board.answer_bits for board in boards) / uplink_hz
    slowest_s = max(
        (board.command_bits + board.answer_bits) / board.link_hz + board.turn_s for board in boards
    )
    return out_s + slowest_s + back_s


def fastest_hz(boards: Sequence[BoardLink], uplink_hz: float) -> int:
    """The highest rate that all of them keep."""
    return int(
        min(
            ON_TIME / answered_s(boards, uplink_hz),
            MOST_LOAD / uplink_load(boards, 1.0, uplink_hz),
            *(MOST_LOAD / load(board, 1.0) for board in boards),
        )
    )
