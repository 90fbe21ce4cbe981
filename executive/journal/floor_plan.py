"""The world of a run from above: what stands where, who moved, and what was seen."""

from __future__ import annotations

import msgspec


class Pose(msgspec.Struct, frozen=True, array_like=True):
    """Where the robot was."""

    t_s: float
    x_m: float
    y_m: float
    yaw_rad: float


class Sight(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """Where an object is believed to be from `t_s` on; `held` by which hand, or missing there."""

    t_s: float
    x_m: float
    y_m: float
    z_m: float
    held: str = ""
    missing: bool = False


class Outline(msgspec.Struct, frozen=True, array_like=True):
    """From `t_s` on something that no map explains stands here; no corners: it is gone."""

    t_s: float
    corners: list[tuple[float, float]]


class Area(msgspec.Struct, frozen=True, kw_only=True):
    """A room, a spot or a piece of furniture from above."""

    name: str
    outline_m: list[tuple[float, float]]


class Thing(msgspec.Struct, frozen=True, kw_only=True):
    """An object that the map knows."""

    id: str
    name: str
    color: str = ""


class Someone(msgspec.Struct, frozen=True, kw_only=True):
    """A person."""

    name: str
    x_m: float
    y_m: float
    radius_m: float = 0.25


class Plan(msgspec.Struct, frozen=True, kw_only=True):
    """The world from above; `bounds_m` is (least x, least y, largest x, largest y)."""

    name: str = ""
    bounds_m: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    rooms: list[Area] = []
    spots: list[Area] = []
    furniture: list[Area] = []
    objects: list[Thing] = []
    people: list[Someone] = []
