"""How a hand can be on a shape: grasp poses, each to be turned about the vertical as it suits.

The hand is a parallel gripper: it approaches along x of G and closes along y, which is kept level,
so that an upright object stays upright. A tilted approach comes down from above.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from robot.failures import Failure, failure
from robot.messages import Shape
from robot.model.description import Hand
from robot.model.handling import Gripping
from robot.se3 import SE3, Array, wrap_angle

TILTS_RAD = (0.0, 0.35, 0.70)
TILT_COST = (0.0, 0.12, 0.35)
LYING_TILTS_RAD = (1.2, 0.9, 1.45)
LOW_TILTS_RAD, LOW_COST = (0.35, 0.70, 0.95, 1.2, 1.45), 0.2
TIP_HEIGHT_M = 0.008
"""Between the fingertips and what a low thing stands on [m]."""
FLATTEST_M = TIP_HEIGHT_M + 0.003
"""What is no higher lies below the fingertips."""
STEEP_RAD = 0.7
"""From here on the palm is above a low thing: a long one is taken at its middle."""
LYING_LIFT_M = 0.01
"""The grasp is at least so far above the axis of what lies: a thin one further, as the fingertips
stay clear of the table."""
UPRIGHT_COS = 0.95
HEADINGS_RAD = tuple(math.tau * k / 16 for k in range(16))
"""From where a hand comes to what is round and has a handle."""
OVER_RIM_TILTS_RAD, OVER_RIM_COST = (0.95, 1.2), 0.45
"""Of a hand that comes over a rim from above, where a handle would be at its palm otherwise."""
OFF_MIDDLE_COST_PER_M = 1.0
"""Of a piece that is so far from the middle of the whole: what is held there turns in the hand."""


@dataclass(frozen=True, slots=True)
class HandOption:
    """A grasp at heading 0; turned by `heading` about the vertical through the reference point.

    Attributes:
        R0: orientation of G, shape (3, 3).
        offset: of G from the reference point (the object's origin) [m], shape (3,).
        headings: which headings it may be turned to [rad] (None: any).
        X_GO: the object in the grasp frame, up to its symmetry.
        opening_m: width between the fingers.
        back_m: length of the approach (or retreat) along x of G.
        cost: how little it is liked, 0 best.
        piece: which piece of the shape the fingers close on; None: it has none.
    """

    R0: Array
    offset: Array
    headings: tuple[float, ...] | None
    X_GO: SE3
    opening_m: float
    back_m: float
    cost: float
    piece: int | None = None


def pick_options(
    shape: Shape, X_WO: SE3, *, hand: Hand, gripping: Gripping
) -> list[HandOption] | Failure:
    """All grasps of an object as it stands or lies there."""
    X_WShape = X_WO @ shape.X_BodyShape
    up = X_WShape.rotation()[2]
    limit = hand.max_opening_m - gripping.slack_m
    if shape.pieces:
        widths = [min(piece.size_m[:2]) for piece in shape.held_pieces or (shape,)]
        found = _on_pieces(shape, X_WO, X_WShape, gripping, limit_m=limit)
    elif shape.kind == "cylinder":
        widths = [shape.size_m[0]]
        stands = abs(up[2]) > UPRIGHT_COS
        around = _standing_cylinder if stands else _lying_cylinder
        found = around(shape, X_WO, X_WShape, gripping) if widths[0] <= limit else []
    else:
        upright = int(np.argmax(np.abs(up)))  # fingers close on what is upright of it
        widths = [size for axis, size in enumerate(shape.size_m) if axis != upright]
        found = _box(shape, X_WO, X_WShape, gripping, limit_m=limit)
    if found:
        return found
    height_m = 2.0 * float(np.abs(up) @ (0.5 * np.array(shape.size_m)))
    if height_m < FLATTEST_M:
        return failure(
            "no_grasp",
            f"it is {1000 * height_m:.0f} mm high, and the fingertips stay "
            f"{1000 * TIP_HEIGHT_M:.0f} mm above what it lies on",
            height_m=height_m,
        )
    return failure(
        "no_grasp",
        f"it is {min(widths) * 100:.0f} cm wide and the hand opens {limit * 100:.0f} cm for it",
        width_m=min(widths),
        opening_m=limit,
    )


def _on_pieces(
    shape: Shape, X_WO: SE3, X_WShape: SE3, gripping: Gripping, *, limit_m: float
) -> list[HandOption]:
    """On each piece that can be held, clear of what sticks out of the shape."""
    found: list[HandOption] = []
    up = X_WShape.rotation()[2]
    half_m = 0.5 * float(np.abs(up) @ np.array(shape.size_m))
    for number, piece in enumerate(shape.pieces):
        if not piece.is_held:
            continue
        X_WPiece = X_WShape @ piece.X_ShapePiece
        own_half_m = 0.5 * float(np.abs(up) @ np.array(piece.size_m))
        below_m = X_WPiece.p[2] - own_half_m - (X_WShape.p[2] - half_m)
        if below_m + 2.0 * own_half_m < FLATTEST_M:
            continue
        part = Shape(kind=piece.kind, size_m=piece.size_m)
        if piece.kind == "box":
            ways = _box(part, X_WO, X_WPiece, gripping, limit_m=limit_m, below_m=below_m)
        elif piece.size_m[0] > limit_m:
            continue
        elif abs(up[2]) > UPRIGHT_COS:
            turned = [wrap_angle(X_WShape.yaw_rad + turn) for turn in HEADINGS_RAD]
            headings = [None] if shape.is_round else turned
            ways = [
                way
                for heading in headings
                for way in _around_piece(
                    shape, part, X_WO, X_WPiece, gripping, heading=heading, below_m=below_m
                )
            ]
        else:
            ways = _lying_cylinder(part, X_WO, X_WPiece, gripping, below_m=below_m)
        off_m = math.dist(X_WPiece.p, X_WShape.p)
        found += [
            replace(way, piece=number, cost=way.cost + OFF_MIDDLE_COST_PER_M * off_m)
            for way in ways
            if _keeps_off(way, shape, gripping)
        ]
    return found


def _around_piece(
    shape: Shape,
    part: Shape,
    X_WO: SE3,
    X_WPiece: SE3,
    gripping: Gripping,
    *,
    heading: float | None,
    below_m: float,
) -> list[HandOption]:
    """Ways from one side that keep off what sticks out; over the rim where none of them is level.

    A mug that turns its handle to the robot, a wall behind it, is taken like that.
    """
    found = _standing_cylinder(part, X_WO, X_WPiece, gripping, heading=heading, below_m=below_m)
    found = [way for way in found if _keeps_off(way, shape, gripping)]
    if heading is None or any(way.R0[2, 0] == 0.0 for way in found):
        return found
    diameter, _, height = part.size_m
    return found + [
        _option(
            X_WO,
            np.array(X_WPiece.p),
            gripping,
            heading=heading,
            tilt=tilt,
            lift=_lifts(height, gripping, below_m)[-1][0],
            depth=0.5 * diameter,
            width=diameter,
            cost=OVER_RIM_COST,
        )
        for tilt in OVER_RIM_TILTS_RAD
    ]


def _keeps_off(option: HandOption, shape: Shape, gripping: Gripping) -> bool:
    """Whether what sticks out of a shape is neither beside it, where fingers come, nor at the palm.

    By boxes along the axes of G around each piece: a few millimetres more than the truth. What lies
    is as long as its other pieces make it: fingers do not close on a part of that.
    """
    rest = tuple(piece for piece in shape.pieces if not piece.is_held)
    for piece in rest if shape.kind == "box" else shape.sticking_out:
        X_GP = option.X_GO @ shape.X_BodyShape @ piece.X_ShapePiece
        half = np.abs(X_GP.rotation()) @ (0.5 * np.array(piece.size_m))
        low, high = np.array(X_GP.p) - half, np.array(X_GP.p) + half
        if low[2] > gripping.finger_half_m or high[2] < -gripping.finger_half_m:
            continue
        beside = high[1] > 0.5 * option.opening_m or low[1] < -0.5 * option.opening_m
        if (beside and low[0] < gripping.fingertip_m) or low[0] < -gripping.hold_depth_m:
            return False
    return True


def held_option(
    X_GO: SE3, shape: Shape, *, yaws: tuple[float, ...] | None, gripping: Gripping
) -> HandOption:
    """The one way the hand is on what it holds, the object upright at yaw 0 (or those given)."""
    X_OG = X_GO.inverse()
    rotation = X_OG.rotation()
    lead = math.atan2(rotation[1, 0], rotation[0, 0])
    level = SE3.from_xy_yaw(0.0, 0.0, -lead)
    X_G0 = level @ X_OG
    headings = None if yaws is None else tuple(wrap_angle(yaw + lead) for yaw in yaws)
    near = 0.5 * max(shape.size_m[:2])
    return HandOption(
        R0=X_G0.rotation(),
        offset=np.array(X_G0.p),
        headings=headings,
        X_GO=X_GO,
        opening_m=0.0,
        back_m=min(near, gripping.hold_depth_m + 0.01) + gripping.fingertip_m + gripping.behind_m,
        cost=0.0,
    )


def hand_rotation(tilt_rad: float) -> Array:
    """R0 of a hand that approaches along +x, pitched down by `tilt_rad`, closing level."""
    c, s = math.cos(tilt_rad), math.sin(tilt_rad)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def _option(
    X_WO: SE3,
    centre_W: Array,
    gripping: Gripping,
    *,
    heading: float | None,
    tilt: float,
    lift: float,
    depth: float,
    width: float,
    cost: float,
) -> HandOption:
    """A grasp whose point is `lift` above the shape's centre, its near face `depth` away."""
    R0 = hand_rotation(tilt)
    hold = min(depth, gripping.hold_depth_m)
    local = np.array([-(depth - hold), 0.0, lift])
    turn = 0.0 if heading is None else heading
    c, s = math.cos(turn), math.sin(turn)
    Rz = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    origin_to_centre = Rz.T @ (centre_W - np.array(X_WO.p))
    X_WG = SE3.from_rotation(Rz @ R0, centre_W + Rz @ local)
    return HandOption(
        R0=R0,
        offset=origin_to_centre + local,
        headings=None if heading is None else (heading,),
        X_GO=X_WG.inverse() @ X_WO,
        opening_m=width,
        back_m=hold / max(0.5, math.cos(tilt)) + gripping.fingertip_m + gripping.before_m,
        cost=cost,
    )


def _lifts(height_m: float, gripping: Gripping, below_m: float = 0.0) -> list[tuple[float, float]]:
    """Grasp heights relative to the middle of a standing object, with their costs."""
    lowest = max(gripping.lowest_m - below_m, gripping.finger_half_m) - 0.5 * height_m
    highest = 0.5 * height_m - 0.015
    if highest < lowest:
        return [(min(highest, 0.0) if highest > -0.5 * height_m else 0.0, 0.1)]
    wanted = ((0.0, 0.0), (0.02, 0.06), (0.2 * height_m, 0.12))
    lifts = {round(min(max(lift, lowest), highest), 4): cost for lift, cost in reversed(wanted)}
    return sorted(lifts.items())


def _is_low(height_m: float, gripping: Gripping) -> bool:
    return height_m < gripping.lowest_m + gripping.low_m


def _ways_down(
    height_m: float, gripping: Gripping, below_m: float = 0.0
) -> list[tuple[float, float, float]]:
    """Tilts and lifts of the hand on what stands, with their costs; low things from above, too.

    `below_m` is how far its foot is above what all of it stands on.
    """
    low = _is_low(below_m + height_m, gripping)
    ways = [
        (tilt, lift, tilt_cost + lift_cost)
        for tilt, tilt_cost in zip(TILTS_RAD, TILT_COST, strict=True)
        for lift, lift_cost in _lifts(height_m, gripping, below_m)
        if tilt == 0.0 or not low
    ]
    for tilt in LOW_TILTS_RAD if low else ():
        ways.append((tilt, _clear_lift_m(tilt, below_m + 0.5 * height_m, gripping), LOW_COST))
    return ways


def _clear_lift_m(tilt: float, middle_m: float, gripping: Gripping) -> float:
    """How far over a middle that high the grasp is with the fingertips just above the table."""
    below_m = gripping.fingertip_m * math.sin(tilt) + gripping.finger_half_m * math.cos(tilt)
    return below_m + TIP_HEIGHT_M - middle_m


def _standing_cylinder(
    shape: Shape,
    X_WO: SE3,
    X_WShape: SE3,
    gripping: Gripping,
    *,
    heading: float | None = None,
    below_m: float = 0.0,
) -> list[HandOption]:
    diameter, _, height = shape.size_m
    centre = np.array(X_WShape.p)
    return [
        _option(
            X_WO,
            centre,
            gripping,
            heading=heading,
            tilt=tilt,
            lift=lift,
            depth=0.5 * diameter,
            width=diameter,
            cost=cost,
        )
        for tilt, lift, cost in _ways_down(height, gripping, below_m)
    ]


def _lying_cylinder(
    shape: Shape, X_WO: SE3, X_WShape: SE3, gripping: Gripping, *, below_m: float = 0.0
) -> list[HandOption]:
    """From above, the fingers on both sides of it.

    A hand that looks along its axis can set it upright again; the other way round it cannot well.
    """
    diameter = shape.size_m[0]
    axis = X_WShape.rotation()[:, 2]
    along = math.atan2(axis[1], axis[0])
    return [
        _option(
            X_WO,
            np.array(X_WShape.p),
            gripping,
            heading=wrap_angle(along + turn),
            tilt=tilt,
            lift=max(LYING_LIFT_M, _clear_lift_m(tilt, below_m + 0.5 * diameter, gripping)),
            depth=0.5 * diameter,
            width=diameter,
            cost=0.2 if turn == 0.0 else 0.5,
        )
        for tilt in LYING_TILTS_RAD
        for turn in (0.0, math.pi)
    ]


def _box(
    shape: Shape,
    X_WO: SE3,
    X_WShape: SE3,
    gripping: Gripping,
    *,
    limit_m: float,
    below_m: float = 0.0,
) -> list[HandOption]:
    """On two opposite upright faces that are near enough to each other."""
    rotation = X_WShape.rotation()
    vertical = int(np.argmax(np.abs(rotation[2])))
    level = [axis for axis in range(3) if axis != vertical]
    height = shape.size_m[vertical]
    result: list[HandOption] = []
    for closing, approach in (level, level[::-1]):
        if shape.size_m[closing] > limit_m:
            continue
        direction = rotation[:, approach]
        yaw = math.atan2(direction[1], direction[0])
        reach_m = 0.5 * shape.size_m[approach]
        for turn, (tilt, lift, cost) in product(
            (0.0, math.pi), _ways_down(height, gripping, below_m)
        ):
            over = _is_low(below_m + height, gripping) and tilt >= STEEP_RAD
            result.append(
                _option(
                    X_WO,
                    np.array(X_WShape.p),
                    gripping,
                    heading=wrap_angle(yaw + turn),
                    tilt=tilt,
                    lift=lift,
                    depth=min(reach_m, gripping.hold_depth_m) if over else reach_m,
                    width=shape.size_m[closing],
                    cost=cost,
                )
            )
    return result
