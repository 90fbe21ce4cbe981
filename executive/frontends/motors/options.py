"""What the commands of `humanoid motors` have in common."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson, Driver, InReality, Robot
from robot.reality.contract import USUAL


@dataclass(frozen=True, kw_only=True)
class OfMap:
    """Motors of a joint map, real or emulated."""

    robot: Robot = "juno"
    map_file: Annotated[
        Path | None,
        typer.Option("--map", "-m", help="The joint map (default: can.yaml beside the robot)."),
    ] = None
    emulated: Annotated[
        bool, typer.Option("--emulated", help="Start emulated motors, as the map has them.")
    ] = False
    fail: Annotated[
        list[str] | None,
        typer.Option(
            "--fail", metavar="JOINT=FLAW", help="What is wrong with an emulated motor (often)."
        ),
    ] = None
    as_json: AsJson = False


SPAN = typer.Option("--for", min=0.1, max=3600.0, metavar="SECONDS")


@dataclass(frozen=True, kw_only=True)
class Scan(OfMap):
    """Who is there."""

    channel: Annotated[
        list[str] | None,
        typer.Option("--channel", "-c", help="A CAN interface, can0 (often); instead of a map."),
    ] = None
    interface: Annotated[str, typer.Option("--interface", help="Of python-can, for --channel.")] = (
        "socketcan"
    )
    data_bitrate_hz: Annotated[
        int,
        typer.Option(
            "--data-bitrate",
            min=0,
            max=8_000_000,
            metavar="BIT/S",
            help="For --channel: a bus of CAN FD, with this rate for data (moteus: 5000000).",
        ),
    ] = 0
    up_to: Annotated[
        int, typer.Option("--up-to", min=1, max=0x7FE, help="The largest identifier asked for.")
    ] = 127


@dataclass(frozen=True, kw_only=True)
class Check(OfMap):
    """Whether the map is right."""

    for_s: Annotated[float, SPAN] = 2.0


@dataclass(frozen=True, kw_only=True)
class Watch(OfMap):
    """What joints measure, again and again."""

    for_s: Annotated[float, SPAN] = 3600.0
    every_s: Annotated[
        float, typer.Option("--every", min=0.02, max=60.0, help="Seconds between two tables.")
    ] = 0.2


@dataclass(frozen=True, kw_only=True)
class Log(OfMap):
    """What joints measure, into a file."""

    file: Annotated[Path, typer.Argument(help="A new file: CSV.", show_default=False)]
    for_s: Annotated[float, SPAN] = 3600.0
    every_s: Annotated[
        float,
        typer.Option("--every", min=0.0, max=60.0, help="Seconds between two lines; 0: all."),
    ] = 0.0


Joint = Annotated[str, typer.Argument(help="A joint of the map.", show_default=False)]


@dataclass(frozen=True, kw_only=True)
class Zero(OfMap):
    """Where a joint's zero is."""

    joint: Joint
    at_rad: Annotated[
        float,
        typer.Option("--at", min=-7.0, max=7.0, help="The angle at which it stands now (rad)."),
    ] = 0.0
    in_motor: Annotated[
        bool,
        typer.Option(
            "--in-motor", help="Let its motor call this position zero from now on, for ever."
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class Jog(OfMap):
    """A little motion of one joint."""

    joint: Joint
    by_rad: Annotated[
        float,
        typer.Option("--by", min=-3.2, max=3.2, help="How far from where it is (rad)."),
    ]
    speed_rad_s: Annotated[
        float, typer.Option("--speed", min=0.01, max=2.0, help="How fast at most (rad/s).")
    ] = 0.2
    torque: Annotated[
        float,
        typer.Option("--torque", min=0.02, max=1.0, help="Share of its torque limit."),
    ] = 0.2


@dataclass(frozen=True, kw_only=True)
class Identify(OfMap):
    """What a joint is like."""

    joint: Joint
    torque: Annotated[
        float,
        typer.Option("--torque", min=0.05, max=1.0, help="Share of its torque limit."),
    ] = 0.3
    to: Annotated[
        Path | None,
        typer.Option(
            "--to",
            help="Written there (default: identified.yaml beside the map; nothing if emulated).",
        ),
    ] = None


class Loss(StrEnum):
    """What happens in a trial of the bus owner."""

    KILL = "kill"
    STOP = "stop"
    PRESS = "press"


@dataclass(frozen=True, kw_only=True)
class SimulateFailsafe:
    """A trial of the bus owner."""

    how: Annotated[
        Loss,
        typer.Option(
            "--how", help="Kill the controller, stop it, or press the emergency stop (emulated)."
        ),
    ] = Loss.KILL
    robot: Robot = "juno"
    driver: Driver = "can"
    reality: InReality = USUAL
    as_json: AsJson = False


@dataclass(frozen=True, kw_only=True)
class Rearm:
    """A person's word that motors may be commanded again."""

    as_json: AsJson = False
