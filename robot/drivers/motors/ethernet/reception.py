"""What boards told last: which datagrams are refused, who is late, what is not believed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.ethernet import datagrams
from robot.drivers.motors.ethernet.arming import masks
from robot.drivers.motors.ethernet.datagrams import (
    ANSWER,
    BOARD,
    FEEDBACK,
    Datagram,
    Reason,
    State,
    feedback_size,
    is_before,
)
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.heard import Heard
from robot.se3 import Array

FASTEST_RAD_S = 100.0
"""Of a motor whose board was not asked yet what it does."""


@dataclass
class FromBoard:
    """What one board told.

    Attributes:
        number: under which it answers.
        mask: of its joints that are ours.
        places: of these in every array, by slot.
        kind: of what it was asked last; 0: nothing.
        sequence: of that.
        is_answered: whether it answered that.
        time_us: its own time then; None: it was never heard.
        flags, volts, celsius: as it says.
        restarts: how often its own time went back: it was without power.
        refused: datagrams, by reason.
    """

    number: int
    mask: int
    places: npt.NDArray[np.intp]
    kind: int = 0
    sequence: int = 0
    is_answered: bool = True
    time_us: int | None = None
    flags: int = 0
    volts: float = float("nan")
    celsius: float = float("nan")
    restarts: int = 0
    refused: Counter[Reason] = field(default_factory=Counter[Reason])


class Reception(Heard):
    """What boards told, beside what all motors tell (`Heard`); arrays of shape (n,).

    Attributes:
        state, faults: codes and bits of each drive.
        boards: what each told, by name.
    """

    def __init__(self, joints: DriveMap, session: int, fastest_rad_s: Array | None = None) -> None:
        """Nothing was heard yet.

        Args:
            joints: the map.
            session: that answers have to be of.
            fastest_rad_s: of each motor, as its board says; None: not asked.
        """
        count, ours = len(joints.joints), masks(joints)
        unknown = np.full(count, FASTEST_RAD_S)
        super().__init__(joints, unknown if fastest_rad_s is None else fastest_rad_s)
        order = {name: index for index, name in enumerate(joints.joints)}
        self.boards = {
            name: FromBoard(
                board.number, ours[name], np.array([order[one] for one in joints.on(name)], np.intp)
            )
            for name, board in joints.boards.items()
        }
        self.state: npt.NDArray[np.intp] = np.full(count, State.DISABLED, np.intp)
        self.faults: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self._session = session
        self._came: npt.NDArray[np.bool_] = np.zeros(count, np.bool_)

    @property
    def refused(self) -> Counter[Reason]:
        """Datagrams of all boards, by reason."""
        return sum((board.refused for board in self.boards.values()), Counter[Reason]())

    def expect(self, kind: int, sequence: int) -> None:
        """All boards are asked this now: nothing else is an answer any more."""
        for board in self.boards.values():
            board.kind, board.sequence, board.is_answered = kind, sequence, False

    def take(self, came: Sequence[tuple[str, bytes]], now_s: float) -> None:
        """Datagrams that came in, by board. What is no answer is refused and counted."""
        bodies: list[bytes] = []
        places: list[npt.NDArray[np.intp]] = []
        for name, data in came:
            board = self.boards[name]
            answer = datagrams.opened(data)
            if isinstance(answer, Datagram):
                answer = self._checked(board, answer)
            if not isinstance(answer, Datagram):
                board.refused[answer] += 1
                continue
            told = datagrams.told(answer.body)
            board.flags, board.volts, board.celsius = told.flags, told.volts, told.celsius
            bodies.append(answer.body[BOARD.size :])
            places.append(board.places)
        if bodies:
            which = np.concatenate(places)
            self._believe(which, np.frombuffer(b"".join(bodies), FEEDBACK), now_s)

    def _checked(self, board: FromBoard, answer: Datagram) -> Datagram | Reason:
        """The answer, or why it is none to what the board was asked last."""
        if answer.board != board.number:
            return "board"
        if answer.session != self._session:
            return "session"
        if answer.sequence != board.sequence:
            return "late" if is_before(answer.sequence, board.sequence) else "ahead"
        if answer.kind != board.kind | ANSWER:
            return "kind"
        if board.is_answered:
            return "duplicate"
        if answer.joints != board.mask:
            return "joints"
        if len(answer.body) != feedback_size(len(board.places)):
            return "length"
        before_us, board.time_us = board.time_us, answer.time_us
        if before_us is not None:
            if answer.time_us == before_us:
                return "stale"
            board.restarts += answer.time_us < before_us
        board.is_answered = True
        return answer

    def _believe(self, which: npt.NDArray[np.intp], told: datagrams.Records, now_s: float) -> None:
        """Take what drives said, but for what is no number, and where nobody can have come to."""
        # Before they are made wider: to widen a signalling NaN is a warning on standard error.
        finite = np.isfinite(told["q"]) & np.isfinite(told["qd"]) & np.isfinite(told["tau"])
        if not finite.all():
            bad = which[~finite]
            for board in self.boards.values():
                board.refused["not_a_number"] += int(np.isin(bad, board.places).sum())
            which, told = which[finite], told[finite]
        q, qd, tau = (told[key].astype(float) for key in ("q", "qd", "tau"))
        self.state[which], self.faults[which] = told["state"], told["faults"]
        self._came[which] = True
        calm = self._calm(which, q, now_s)
        if calm is not None:
            which, told, q, qd, tau = which[calm], told[calm], q[calm], qd[calm], tau[calm]
        self.q[which], self.qd[which], self.tau[which] = q, qd, tau
        self.temperature_c[which] = 0.1 * told["decicelsius"]
        self.heard_s[which] = now_s

    def end_period(self) -> None:
        """Count who did not answer, and bridge the first answer that anyone did not give."""
        silent = ~self._came
        if silent.any() or self.misses.any():
            self.misses = np.where(silent, self.misses + 1, 0)
            self.lost += int(np.count_nonzero(silent))
            self._bridge(self.misses == 1)
        self._came[:] = False
