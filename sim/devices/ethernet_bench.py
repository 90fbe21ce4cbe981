"""Boards on a bench: what a map says there is, emulated, each joint with a shaft of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import cast

from robot.clock import SimulatedClock
from robot.drivers.motors.ethernet.joint_map import DriveMap, JointDrive
from robot.drivers.motors.linkage import Needed, middle, needed
from robot.errors import ConfigError
from sim.devices.direct_lines import DirectLines
from sim.devices.ethernet_board import FLAWS, OVER_CURRENT, Board, Drive, Flaw, Kind
from sim.devices.ethernet_cable import Cable
from sim.devices.flaws import unknown
from sim.devices.shaft import FreeShaft, Shaft

SWING_RAD_S = 0.4
SPARE = 1.25
"""Of torque and speed a drive has so much more than its map says: nobody runs one at its end."""


@dataclass(frozen=True)
class EthernetBench:
    """Emulated boards with their drives.

    Attributes:
        cables: by the map's names of boards.
        drives: by the map's names of joints.
    """

    cables: Mapping[str, Cable]
    drives: Mapping[str, Drive]

    def live(self, until_s: float) -> None:
        """Let the boards' time go by up to a moment."""
        for cable in self.cables.values():
            cable.board.live(until_s)


def kind(joint: JointDrive, wants: Needed) -> Kind:
    """A drive that does what its joint or its crank needs, and something more."""
    return Kind(
        joint.model,
        SPARE * wants.velocity_rad_s * joint.gear,
        SPARE * wants.torque_nm / joint.gear,
    )


def cables_of(
    wanted: DriveMap, shafts: Mapping[str, Shaft], now_s: float, *, heat_k_s: float = 4.0
) -> EthernetBench:
    """The boards of a map, whose drives turn these shafts, by joint."""
    wants = needed(wanted.linkages, wanted.joints)
    drives = {
        name: Drive(kind(joint, wants[name]), shafts[name], heat_k_s=heat_k_s)
        for name, joint in wanted.joints.items()
    }
    cables: dict[str, Cable] = {}
    for index, (name, board) in enumerate(wanted.boards.items()):
        slots = {joint.id: drives[one] for one, joint in wanted.on(name).items()}
        cables[name] = Cable(Board(board.number, slots, now_s, serial=1000 + index), seed=index)
    return EthernetBench(cables, drives)


def build(
    wanted: DriveMap,
    *,
    now_s: float = 0.0,
    flaws: Mapping[str, str] | None = None,
    is_still: bool = False,
) -> EthernetBench:
    """The boards of a map, joints in the middle of their ranges and swinging a little.

    Args:
        wanted: the map.
        now_s: when their time begins.
        flaws: what is wrong with whom, by joint; some is wrong with its whole board.
        is_still: whether joints do not swing.

    Raises:
        ConfigError: if a joint or a flaw is unknown.
    """
    flaws = flaws or {}
    if problems := unknown(flaws, joints=wanted.joints, known=FLAWS):
        raise ConfigError(problems)
    shafts: dict[str, FreeShaft] = {}
    for name, at_rad in middle(wanted.linkages, wanted.joints).items():
        shafts[name] = FreeShaft(q_rad=wanted.joints[name].motor_rad(at_rad), spring_nm_rad=0.3)
        shafts[name].qd_rad_s = 0.0 if is_still else SWING_RAD_S
    made = cables_of(wanted, shafts, now_s)
    for name, flaw in flaws.items():
        if not made.cables[wanted.joints[name].board].suffer(cast("Flaw", flaw)):
            suffer(made.drives[name], cast("Flaw", flaw))
    return made


def suffer(drive: Drive, flaw: Flaw) -> None:
    """Have something wrong with one drive."""
    sold = drive.kind
    match flaw:
        case "not_a_number":
            drive.trouble.not_a_number = True
        case "slow_speed":
            drive.trouble.speed_scale = 0.5
        case "wrong_model":
            drive.kind = sold._replace(model="OTHER-1")
        case "weak":
            drive.kind = sold._replace(torque_nm=0.5 * sold.torque_nm)
        case "hot":
            drive.winding_c = sold.trips_c + 1.0
        case "over_current":
            drive.trouble.faults = OVER_CURRENT
        case "unplugged_slot":
            drive.trouble.unplugged = True
        case _:
            pass


class DirectPorts(DirectLines[EthernetBench]):
    """A driver's ways straight to emulated boards.

    Attributes:
        strangers: datagrams of a test that came from somewhere else.
        full: boards for which the system takes nothing.
    """

    all_gone = "there is no way to any board"

    def __init__(self, bench: EthernetBench, clock: SimulatedClock) -> None:
        """Know the bench; nothing is opened."""
        super().__init__(bench, clock)
        self.strangers: dict[str, int] = dict.fromkeys(bench.cables, 0)
        self.full: set[str] = set()
        self._kept: list[tuple[str, bytes]] = []

    @property
    def _count(self) -> int:
        return len(self._bench.cables)

    def inject(self, board: str, data: bytes) -> None:
        """A datagram that pretends to be a board's."""
        self._kept.append((board, data))

    def play(self) -> None:
        """Let time go by up to now; who asked gets what was answered."""
        now_s = self._clock.now_s()
        for name, cable in self._bench.cables.items():
            for data, source in cable.advance(now_s):
                cast("DirectPorts", source).inject(name, data)
            cable.board.live(now_s)

    def send(self, board: str, data: bytes) -> bool:
        """Hand a datagram over."""
        self._check()
        if board in self.full:
            return False
        if board not in self.gone:
            self._bench.cables[board].write(data, self, self._clock.now_s())
        return True

    def receive(self) -> list[tuple[str, bytes]]:
        """What came in up to now; the boards' time goes by."""
        self._check()
        self.play()
        came, self._kept = self._kept, []
        return [(name, data) for name, data in came if name not in self.gone]
