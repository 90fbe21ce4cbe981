"""Which board moves which joint: `ethernet.yaml` beside a robot's description, or another file.

rate_hz: 500
boards:
  left_leg: {address: 10.0.7.11, number: 1}
joints:
  left_knee: {board: left_leg, model: KNEE-A, id: 3, sign: -1, offset_rad: 0.12, gear: 1.5,
              lower_rad: 0, upper_rad: 2.4, velocity_limit_rad_s: 16, torque_limit_nm: 60}
"""

from __future__ import annotations

import ipaddress
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, TypeAlias

import msgspec

from robot.drivers.motors import linkage, motor_map
from robot.drivers.motors.ethernet import load as link_load
from robot.drivers.motors.ethernet.datagrams import MOST_SLOTS
from robot.drivers.motors.ethernet.load import BoardLink
from robot.drivers.motors.motor_map import LinkedMap, Motor, Wrong
from robot.files import quantities as q

FILE = "ethernet.yaml"
PORT = 4310

Number: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=254)]
Slot: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=MOST_SLOTS - 1)]
UdpPort: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=65_535)]
Rate: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=2000, extra={"unit": "Hz"})]
Watchdog: TypeAlias = Annotated[float, msgspec.Meta(ge=0.002, le=1.0, extra={"unit": "s"})]
Bits: TypeAlias = Annotated[
    int, msgspec.Meta(ge=1_000_000, le=10_000_000_000, extra={"unit": "bit/s"})
]
Turn: TypeAlias = Annotated[float, msgspec.Meta(ge=0.0, le=0.1, extra={"unit": "s"})]
Model: TypeAlias = Annotated[str, msgspec.Meta(pattern=r"\A[!-~]{1,16}\Z")]


class Board(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A board that drives motors, as it is reached.

    Attributes:
        address: of IP, as a number: names are looked up by nobody. Of an emulated board the file
            that says where it is.
        port: of UDP.
        number: its own, which it answers under.
        link_hz: of its link, each way.
        turn_s: it answers within so long.
    """

    address: q.Line
    number: Number
    port: UdpPort = PORT
    link_hz: Bits = 100_000_000
    turn_s: Turn = 0.0002

    @property
    def is_emulated(self) -> bool:
        """Whether a file says where it is; no map of a person may say that."""
        return self.address.startswith("/")

    @property
    def ip(self) -> int:
        """Version of IP."""
        return 6 if ":" in self.address else 4

    @property
    def channel(self) -> str:
        """Where it is, for people."""
        if self.is_emulated:
            return self.address
        return f"[{self.address}]:{self.port}" if self.ip == 6 else f"{self.address}:{self.port}"

    @property
    def device(self) -> str:
        """What a user calls it who lets robots talk to it: udp:10.0.7.11:4310."""
        return f"udp:{self.channel}"


class JointDrive(Motor, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The motor of one joint, and how it sits there (`Mounted`).

    Attributes:
        board: one of `boards`.
        model: what its board calls it: up to 16 characters.
        id: its slot on the board, from 0.
    """

    board: str
    model: Model
    id: Slot

    @property
    def line(self) -> str:
        """Its board."""
        return self.board


class DriveMap(LinkedMap, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All motors behind Ethernet of a robot (`LinkedMap`).

    Attributes:
        watchdog_s: written into every board at the start.
        uplink_hz: of the computer's own link, each way.
        boards: by name.
    """

    rate_hz: Rate
    watchdog_s: Watchdog = 0.02
    uplink_hz: Bits = 100_000_000
    boards: dict[str, Board]
    joints: dict[str, JointDrive]

    @property
    def channels(self) -> Mapping[str, str]:
        """Where its boards are."""
        return {name: board.channel for name, board in self.boards.items()}

    def on(self, board: str) -> dict[str, JointDrive]:
        """The joints of a board, by slot."""
        some = {name: one for name, one in self.joints.items() if one.board == board}
        return dict(sorted(some.items(), key=lambda item: item[1].id))

    def link(self, line: str) -> BoardLink:
        """A board, as far as its traffic goes."""
        board = self.boards[line]
        return BoardLink(len(self.on(line)), board.link_hz, board.turn_s, board.ip)

    def load(self, line: str) -> float:
        """The share of its time that a board's link is busy."""
        return link_load.load(self.link(line), self.rate_hz)


def load(path: Path | str) -> DriveMap:
    """Read a map.

    Raises:
        ConfigError: with everything that is wrong in it, each with its line and a cure.
    """
    checks = (_names, _addresses, _slots, _limits, _linkages, _loads)
    return motor_map.read(path, DriveMap, begin_with="rate_hz: 500", checks=checks)


def _names(found: DriveMap) -> Iterator[Wrong]:
    yield from motor_map.nameless(found)
    for name, joint in found.joints.items():
        yield from motor_map.misnamed(
            name, joint, line="board", plural="boards", lines=found.boards, models=(joint.model,)
        )
    for name in found.boards:
        if not found.on(name):
            yield f"$.boards.{name}", f"no joint is on the board {name!r}", "leave it out"


def _addresses(found: DriveMap) -> Iterator[Wrong]:
    """Where no single board can be, or two are."""
    taken: dict[tuple[str, int], str] = {}
    for name, board in found.boards.items():
        where = f"$.boards.{name}.address"
        try:
            address = ipaddress.ip_address(board.address)
        except ValueError:
            text = f"{board.address!r} is no address of IP"
            yield where, text, "write its number, as in 10.0.7.11: names are not looked up"
            continue
        is_everybody = str(address) == "255.255.255.255"
        if address.is_multicast or address.is_unspecified or is_everybody:
            yield where, f"{address} is not the address of one board", "write the board's own"
        key = str(address), board.port
        if key in taken:
            text = f"{board.channel} is where {taken[key]!r} is already"
            yield where, text, "give each board an address of its own"
        taken.setdefault(key, name)


def _slots(found: DriveMap) -> Iterator[Wrong]:
    for board in found.boards:
        taken: dict[int, str] = {}
        for name, joint in found.on(board).items():
            if joint.id in taken:
                text = f"slot {joint.id} of the board {board!r} is {taken[joint.id]}'s already"
                yield f"$.joints.{name}.id", text, f"give {name} the slot that it is plugged into"
            taken.setdefault(joint.id, name)


def _limits(found: DriveMap) -> Iterator[Wrong]:
    """What a motor can meet, its board says; that is compared when it is asked."""
    yield from motor_map.hasty(found)
    for name, joint in found.joints.items():
        yield from motor_map.upside_down(f"$.joints.{name}", joint)


def _linkages(found: DriveMap) -> Iterator[Wrong]:
    yield from linkage.wrong(found.linkages, found.joints)


def _loads(found: DriveMap) -> Iterator[Wrong]:
    """Links that cannot carry what they are asked to, or boards that answer too late."""
    if any(joint.board not in found.boards for joint in found.joints.values()) or not found.joints:
        return
    links = {name: found.link(name) for name in found.boards}
    all_links, uplink_hz = [*links.values()], found.uplink_hz
    slower = f"{link_load.fastest_hz(all_links, uplink_hz)} Hz"
    safe = f"at most {link_load.MOST_LOAD:.0%} is safe"
    for name, link in links.items():
        if (share := found.load(name)) > link_load.MOST_LOAD:
            text = (
                f"{link.joints} joints at {found.rate_hz} Hz fill its link to {share:.0%}, {safe}"
            )
            yield f"$.boards.{name}", text, f"a faster link, fewer joints, or {slower}"
    share = link_load.uplink_load(all_links, found.rate_hz, uplink_hz)
    if share > link_load.MOST_LOAD:
        text = f"{len(links)} boards at {found.rate_hz} Hz fill the computer's link to {share:.0%}"
        yield "$.rate_hz", f"{text}, {safe}", f"a faster link (uplink_hz), or {slower}"
    last_s = link_load.answered_s(all_links, uplink_hz)
    if last_s > link_load.ON_TIME * found.period_s:
        text = (
            f"the last answer is there after {1000 * last_s:.2f} ms of "
            f"{1000 * found.period_s:.2f}, at most {link_load.ON_TIME:.0%} is safe"
        )
        yield "$.rate_hz", text, f"faster links, boards that answer sooner (turn_s), or {slower}"
