"""The way to an emulated board and back: time that it takes, and what gets lost on it.

Datagrams of UDP may be lost, late, twice, in another order, spoilt where no switch looks at them.
"""

from __future__ import annotations

import heapq
import random
from collections.abc import Hashable
from dataclasses import dataclass
from itertools import count

from sim.devices.ethernet_board import Board, BoardTrouble, Flaw
from sim.devices.ethernet_codec import COMMAND, crc

LATENCY_S = 50e-6
"""One way, through a switch."""
TURNS_S = 100e-6
"""Of the board, from a question to its answer."""
LATE_S = 0.004
FOR_EVER = 1_000_000_000
NEVER_S = float("inf")


@dataclass
class CableTrouble:
    """What goes wrong on the way back.

    Attributes:
        loses, doubles, swaps, spoils: so many of the next answers are lost, come twice, come behind
            the one after them, have a bit that is another.
        loses_share: of all answers, and of all questions, at random.
        later_s: answers are later by so much.
    """

    loses: int = 0
    doubles: int = 0
    swaps: int = 0
    spoils: int = 0
    loses_share: float = 0.0
    later_s: float = 0.0


class Cable:
    """To one board.

    Attributes:
        board: at its end.
        trouble: what goes wrong on it.
        commands: how many were given to it.
    """

    def __init__(self, board: Board, *, seed: int = 0) -> None:
        """Plug it in."""
        self.board, self.trouble = board, CableTrouble()
        self.commands = 0
        self._draw = random.Random(seed)
        self._numbers = count()
        self._out: list[tuple[float, int, bytes, Hashable]] = []
        self._back: list[tuple[float, int, bytes, Hashable]] = []
        self._held: tuple[bytes, Hashable] | None = None

    def suffer(self, flaw: Flaw) -> bool:
        """Have something wrong with the board or the cable; False if it is nothing of theirs."""
        board, cable = self.board.trouble, self.trouble
        match flaw:
            case "silent":
                board.silent = True
            case "wrong_board":
                board.wrong_number = True
            case "frozen_time":
                board.frozen_us = 0
            case "no_watchdog":
                board.no_watchdog = True
            case "old_version":
                board.old_version = True
            case "loses_replies":
                cable.loses = FOR_EVER
            case "late_replies":
                cable.later_s = LATE_S
            case "doubles":
                cable.doubles = FOR_EVER
            case "swaps":
                cable.swaps = FOR_EVER
            case "spoils":
                cable.spoils = FOR_EVER
            case "low_volts":
                self.board.volts = 30.0
            case _:
                return False
        return True

    def heal(self) -> None:
        """Nothing is wrong any more."""
        self.board.trouble, self.trouble = BoardTrouble(), CableTrouble()

    def write(self, data: bytes, source: Hashable, now_s: float) -> None:
        """A datagram from somewhere is on its way."""
        self.commands += data[5:6] == bytes((COMMAND,))
        if self._draw.random() >= self.trouble.loses_share:
            heapq.heappush(self._out, (now_s + LATENCY_S, next(self._numbers), data, source))

    @property
    def next_s(self) -> float:
        """When the next thing happens on it."""
        return min((queue[0][0] for queue in (self._out, self._back) if queue), default=NEVER_S)

    def advance(self, until_s: float) -> list[tuple[bytes, Hashable]]:
        """Let it carry what it has up to a moment; what came back, and for whom."""
        while self._out and self._out[0][0] <= until_s:
            at_s, _, data, source = heapq.heappop(self._out)
            if (said := self.board.hear(data, at_s)) is not None:
                self._answer(said, source, at_s + TURNS_S + LATENCY_S + self.trouble.later_s)
        came: list[tuple[bytes, Hashable]] = []
        while self._back and self._back[0][0] <= until_s:
            _, _, data, source = heapq.heappop(self._back)
            came.append((data, source))
        return came

    def _answer(self, data: bytes, source: Hashable, at_s: float) -> None:
        trouble = self.trouble
        if trouble.loses or self._draw.random() < trouble.loses_share:
            trouble.loses = max(0, trouble.loses - 1)
            return
        if trouble.spoils:
            trouble.spoils -= 1
            place = self._draw.randrange(8 * len(data))
            spoilt = bytearray(data)
            spoilt[place // 8] ^= 1 << place % 8
            data = bytes(spoilt)
            assert crc(data[:-4]).to_bytes(4, "little") != data[-4:]
        held, self._held = self._held, None
        if trouble.swaps and held is None:
            trouble.swaps -= 1
            self._held = data, source
            return
        self._push(data, source, at_s)
        if trouble.doubles:
            trouble.doubles -= 1
            self._push(data, source, at_s + 20e-6)
        if held is not None:
            self._push(*held, at_s + 10e-6)

    def _push(self, data: bytes, source: Hashable, at_s: float) -> None:
        heapq.heappush(self._back, (at_s, next(self._numbers), data, source))
