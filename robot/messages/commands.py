"""What the executive asks of the body."""

from __future__ import annotations

from robot.messages.basics import Message, Side
from robot.se3 import SE3, Vector3


class Command(Message, frozen=True, kw_only=True, tag=True):
    """A request to the body. `id` grows; `Activity.id` in the state answers it."""

    id: int


class Damp(Command, frozen=True, kw_only=True):
    """Let every motor damp (kp = 0, velocity target 0)."""


class GetUp(Command, frozen=True, kw_only=True):
    """Get up from the floor and stand; only for a robot that has fallen. `Damp` ends it at once."""


class Stand(Command, frozen=True, kw_only=True):
    """Stand on both feet where they are; finish the step first if walking.

    `height_m` is the base height wanted above the soles (None: nominal), `pitch_rad` a lean of the
    trunk by the waist, `yaw_rad` a turn of it.
    """

    height_m: float | None = None
    pitch_rad: float = 0.0
    yaw_rad: float = 0.0


class OneLeg(Command, frozen=True, kw_only=True):
    """Shift onto `side` and lift the other foot for `duration_s`, then stand again."""

    side: Side
    duration_s: float


class Walk(Command, frozen=True, kw_only=True):
    """Walk at a twist in the base's heading frame [m/s, rad/s]; dies out after `hold_s`."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0
    hold_s: float = 0.5


class WalkTo(Command, frozen=True, kw_only=True):
    """Step to a stance: the midpoint of the soles at X_NS (x, y, yaw), then stand."""

    x_m: float
    y_m: float
    yaw_rad: float
    position_tolerance_m: float = 0.015
    yaw_tolerance_rad: float = 0.03


class MoveArm(Command, frozen=True, kw_only=True):
    """Follow a joint trajectory.

    `times_s` from now, shape (k,); `positions_rad` shape (k, joints of the arm), in the order of
    the description's group; interpolated by a C2 (cubic) spline, at rest at both ends.
    """

    side: Side
    times_s: tuple[float, ...]
    positions_rad: tuple[tuple[float, ...], ...]


class MoveHand(Command, frozen=True, kw_only=True):
    """Move the grasp frame on a straight line to X_NG, corrected for the body's motion, and hold.

    With `stop_load_n`, a downward line also ends when the wrist's vertical load has changed by
    that much (contact). With `near_rad`, joints of the arm, the elbow goes where it is at these, as
    far as the line allows; else it goes wherever the joints move least.
    """

    side: Side
    X_NG: SE3
    speed_m_s: float = 0.15
    stop_load_n: float | None = None
    near_rad: tuple[float, ...] = ()


class HoldArm(Command, frozen=True, kw_only=True):
    """Brake an arm, with bounds on acceleration and jerk, and hold its joints where they rest."""

    side: Side


class Grip(Command, frozen=True, kw_only=True):
    """Open or close the fingers to `opening_m` with `force_n` a finger, more if it is pulled at."""

    side: Side
    opening_m: float
    force_n: float = 15.0


class Look(Command, frozen=True, kw_only=True):
    """Turn the head's camera towards a point of N [m]."""

    p_N: Vector3


class Payload(Command, frozen=True, kw_only=True):
    """Tell the body what a hand carries, centre of mass at the grasp point (0 kg: nothing)."""

    side: Side
    mass_kg: float


BodyCommand = (
    Damp
    | GetUp
    | Stand
    | OneLeg
    | Walk
    | WalkTo
    | MoveArm
    | MoveHand
    | HoldArm
    | Grip
    | Look
    | Payload
)
