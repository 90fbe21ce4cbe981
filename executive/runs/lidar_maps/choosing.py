"""Who tells a robot where it is, where nobody has said who: its own lidar, if it has a map.

This is the one place where "auto" is resolved. What is set up with a `Setting` from here (runs,
their headers and summaries, replays and resumptions of them) knows "oracle" or "lidar" alone.
"""

from __future__ import annotations

from msgspec.structs import replace

from executive.meaning.request import Setting
from executive.runs.lidar_maps.kept import Tell, is_kept, is_shipped
from robot.messages import AskedLocalisation, LocalisedBy


def localised(
    where: Setting,
    asked: AskedLocalisation,
    *,
    tell: Tell,
    shipped_only: bool = False,
) -> Setting:
    """A robot in its world, with who tells it where it is.

    Args:
        where: robot and world.
        asked: "auto" is the robot's own lidar where a map of the world by this robot is there, and
            the oracle where none is: to make one takes minutes, which nobody has asked for.
        tell: hears that it is the oracle because there is no map, and what to do about that.
        shipped_only: whether maps count only that come with the package: what comes out then is
            the same on every machine.
    """
    by: LocalisedBy
    if asked == "auto":
        own = is_shipped(where) if shipped_only else is_kept(where)
        by = "lidar" if own else "oracle"
        if not own:
            tell(untold(where.world.name))
    else:
        by = asked
    reality = where.reality.under(where.world.profile, eyes=where.world.eyes, localisation=by)
    return replace(where, reality=reality, world=where.world.localised(by))


def untold(world: str) -> str:
    """That an oracle tells the robot where it is, and how to get rid of it."""
    return (
        f"an oracle tells the robot where it is: it has no map of {world} yet "
        "(--localisation lidar has it make one first: minutes, once)"
    )
