"""Looks at what boards tell, period by period, and sounds alarms."""

from __future__ import annotations

from collections import Counter

import numpy as np

from robot.drivers.motors import watching
from robot.drivers.motors.alarms import BY_STATUS, Alarm, Alarms, Kind, Level
from robot.drivers.motors.ethernet.datagrams import FLAGS_EXPIRED, FLAGS_OTHERS, State
from robot.drivers.motors.ethernet.interview import faults_of
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import Ports
from robot.drivers.motors.ethernet.reception import FromBoard, Reception
from robot.drivers.motors.watching import IMPOSSIBLE

FULL_S = 0.010
NOISY_S, NOISY_DATAGRAMS = 1.0, 5
"""So many refused datagrams of a board in so long."""

STRAINED = Kind(
    "its fault",
    Level.HOLD,
    f"a drive reports {', '.join(BY_STATUS).replace('_', '-')}",
    "1 period",
)
FAULT = Kind(
    "its fault",
    Level.SIT,
    "a drive reports another fault, or that somebody disabled it",
    "1 period",
    is_latched=True,
)
EXPIRED = Kind(
    "lost_communication",
    Level.SIT,
    "a board had no command for its watchdog's time: its joints brake until they are armed again",
    "1 period",
    is_latched=True,
)
RESTARTED = Kind(
    "restarted",
    Level.SIT,
    "a board's own time went back: it was without power",
    "1 period",
    is_latched=True,
)
OTHERS = Kind(
    "commanded_by_another",
    Level.SIT,
    "a board obeys another program than this one",
    "1 period",
    is_latched=True,
)
FULL = Kind(
    "queue_full",
    Level.WARN,
    "the system takes no datagrams for a board; none is queued, the next one is newer",
    f"{1000 * FULL_S:g} ms",
)
NOISY = Kind(
    "noisy",
    Level.WARN,
    f"{NOISY_DATAGRAMS} datagrams of a board in {NOISY_S:g} s were refused: twice, spoilt, of "
    "another version, from a strange address (late ones count as lost)",
    f"{NOISY_S:g} s",
)
KINDS = (STRAINED, FAULT, EXPIRED, RESTARTED, OTHERS, IMPOSSIBLE, FULL, NOISY)
"""What only motors behind Ethernet have."""


class Watch(watching.Watch[DriveMap, Reception]):
    """Of all joints of a map, and their boards."""

    unplugged_cure = "plug it in, see that the network is up (ip address show), and start again"

    def __init__(self, joints: DriveMap, alarms: Alarms, ports: Ports) -> None:
        """Sounds these alarms; `ports`: know of datagrams that came from somewhere else."""
        super().__init__(joints, alarms)
        self._motors, self._ports = list(joints.joints.values()), ports
        self._refused: dict[str, Counter[str]] = {}
        self._restarts: dict[str, int] = {}
        self._noisy_s = -np.inf

    def forget(self) -> None:
        """Begin to look anew."""
        super().forget()
        self._restarts.clear()

    def full(self, board: str, for_s: float) -> None:
        """The system takes nothing for a board, for so long by now; 0: it does."""
        if for_s >= FULL_S:
            text = f"nothing could be sent to it for {1000 * for_s:.0f} ms"
            cure = "is its cable plugged in? what else is sent over this network?"
            self._alarms.sound(FULL.alarm(board, text, cure))
        elif not for_s:
            self._alarms.quiet("queue_full", board)

    def _is_odd(self, heard: Reception) -> bool:
        return bool(heard.faults.any()) or bool((heard.state != State.ENABLED).any())

    def _of_lines(self, now_s: float, heard: Reception, *, is_armed: bool) -> None:
        for name, board in heard.boards.items():
            self._board(name, board, is_armed=is_armed)
        if now_s - self._noisy_s >= NOISY_S:
            self._noisy_s = now_s
            strangers = self._ports.strangers
            for name, board in heard.boards.items():
                refused = Counter[str](board.refused)
                refused["source"] = strangers.get(name, 0)
                refused["late"] = 0
                self._noise(name, refused)

    def _of_one(self, index: int, heard: Reception, *, is_armed: bool) -> list[Alarm]:
        one, name, looks = self._motors[index], self.joints.names[index], self.joints
        motor = f"slot {one.id} of the board {one.board}"
        cure = "check the board's power, its cable, and the switch"
        return [
            *looks.silence(index, int(heard.misses[index]), motor, cure),
            *self._fault(
                name, int(heard.state[index]), int(heard.faults[index]), is_armed=is_armed
            ),
            *looks.heat(index, float(heard.temperature_c[index])),
            *looks.motion(index, int(heard.jumps[index]), "compare its gear with the map"),
        ]

    def _fault(self, name: str, state: int, bits: int, *, is_armed: bool) -> list[Alarm]:
        cure = "find out why; then switch the board off and on"
        if faults := faults_of(bits):
            return [
                (STRAINED if fault in BY_STATUS else FAULT).alarm(
                    name, f"reports {fault.replace('_', ' ')}", cure, code=fault
                )
                for fault in faults
            ]
        if is_armed and state == State.DISABLED:
            text = "its drive is disabled"
            return [FAULT.alarm(name, text, "somebody else disabled it", code="disabled")]
        if is_armed and state not in (State.ENABLED, State.BRAKING):
            text = f"its drive is in a state that is not known ({state})"
            return [FAULT.alarm(name, text, "look at its firmware", code="unknown_state")]
        return []

    def _board(self, name: str, board: FromBoard, *, is_armed: bool) -> None:
        restarts = self._restarts.setdefault(name, board.restarts)
        if not is_armed:
            self._restarts[name] = board.restarts
            return
        if board.restarts > restarts:
            text = "it was without power and has begun anew"
            self._alarms.sound(RESTARTED.alarm(name, text, "look at its supply and its plug"))
        if board.flags & FLAGS_EXPIRED:
            text = f"it had no command for {1000 * self._map.watchdog_s:g} ms, and brakes"
            cure = "why was the computer or the network busy? start again"
            self._alarms.sound(EXPIRED.alarm(name, text, cure))
        if board.flags & FLAGS_OTHERS:
            text = "it obeys another program"
            self._alarms.sound(OTHERS.alarm(name, text, "end the other one, and start again"))

    def _noise(self, name: str, refused: Counter[str]) -> None:
        before = self._refused.get(name, Counter[str]())
        self._refused[name] = refused
        new: Counter[str] = refused - before
        if new.total() >= NOISY_DATAGRAMS:
            words = ", ".join(f"{count} {reason}" for reason, count in new.most_common())
            text = f"{new.total()} datagrams refused in {NOISY_S:g} s: {words.replace('_', ' ')}"
            cure = "is it a network of its own, and who else sends on it?"
            self._alarms.sound(NOISY.alarm(name, text, cure))
        else:
            self._alarms.quiet("noisy", name)
