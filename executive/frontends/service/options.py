"""The options of a robot that is up, and of those who reach it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from executive.frontends.completing import completes
from executive.frontends.options import Prompt
from executive.frontends.service.place import DEFAULT_NAME, places_up


@completes
def _names() -> list[str]:
    """Robots that are up."""
    return [one.name for one in places_up()]


Name = Annotated[
    str | None,
    typer.Option("--name", help="Which robot, where more than one is up.", autocompletion=_names),
]


LOCAL_ROUTER = "tcp/127.0.0.1:7447"
"""Where `ros2 run rmw_zenoh_cpp rmw_zenohd` listens, on this machine."""
MOST_DOMAIN = 232
"""Of ROS_DOMAIN_ID."""


@dataclass(frozen=True, kw_only=True)
class Ros2:
    """Whether machines with ROS 2 see the robot, and which."""

    ros2: Annotated[
        bool,
        typer.Option(
            "--ros2",
            help="Let ROS 2 machines see and command it, over zenoh as rmw_zenoh does, without ROS "
            "here (docs/ros2.md; not with --fast).",
        ),
    ] = False
    ros2_router: Annotated[
        str,
        typer.Option(
            "--ros2-router",
            help="Router of rmw_zenoh, tcp/HOST:PORT; whoever reaches it can command the robot.",
        ),
    ] = LOCAL_ROUTER
    ros2_domain: Annotated[
        int,
        typer.Option("--ros2-domain", min=0, max=MOST_DOMAIN, help="ROS_DOMAIN_ID of theirs."),
    ] = 0


@dataclass(frozen=True, kw_only=True)
class Up(Prompt, Ros2):
    """The options of `humanoid up`."""

    name: Annotated[
        str, typer.Option("--name", help="What it is reached by, where more than one is up.")
    ] = DEFAULT_NAME
    detach: Annotated[
        bool, typer.Option("--detach", "-d", help="Leave the terminal once it is up.")
    ] = False
