"""How a body stands and walks: figures of its gait, and of keeping its balance."""

from __future__ import annotations

import msgspec

from robot import quantities as q


class Catching(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a swing leg can do to catch a push.

    Attributes:
        forward_m, side_m: furthest landing from the standing sole.
        width_m: least distance of the soles in such a step.
        swing_m_s: mean speed of the foot, to the landing.
    """

    forward_m: q.Length
    side_m: q.Length
    width_m: q.Margin
    swing_m_s: q.Speed


class Cruise(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How fast a planned way is walked where it is straight: parts of `max_forward_m_s`.

    Attributes:
        clear: with free hands, where there is room.
        carrying: with something in a hand.
        narrow: where something is as near as `Room.slow_m`.
    """

    clear: q.Share
    carrying: q.Share
    narrow: q.Share


class Following(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Following a planned way, see executive/skills/motions/path_follower.py.

    Attributes:
        ahead_m: where on the way the next direction is taken from, past the nearest point.
        turn_ahead_m: where the heading is taken from.
        bend_ahead_m: how far bends are looked for that slow the walk down.
        slow_ahead_m: before a stretch that is to be walked slower.
        pull_1_s, pull_m_s: back onto the way: gain of the error, most of the speed.
        turn_1_s: gain of the error of the heading.
        least_m_s, slow_down_1_s: speed at the end of a straight stretch, and its gain before that.
    """

    ahead_m: q.Length
    turn_ahead_m: q.Length
    bend_ahead_m: q.Length
    slow_ahead_m: q.Length
    pull_1_s: q.Rate
    pull_m_s: q.Speed
    turn_1_s: q.Rate
    least_m_s: q.Speed
    slow_down_1_s: q.Rate


class LastSteps(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From where steps to an exact stance take over from following a way.

    Attributes:
        within_m: as near as this to the stance,
        aside_m: with no more of that to a side,
        turn_rad: and no more to turn.
    """

    within_m: q.Length
    aside_m: q.Length
    turn_rad: q.Turn


class Room(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the moving body wants free around it: from its middle, but for `beside_m`.

    Attributes:
        turning_m: to turn on the spot without its arms touching anything.
        passing_m: half of a gap that it goes through without touching.
        slow_m: what is nearer to a way than that is passed slowly.
        beside_m: beyond the body's radius, beside a way where there is room.
        before_edge_m: where it stands at a table, from its edge.
    """

    turning_m: q.Length
    passing_m: q.Length
    slow_m: q.Length
    beside_m: q.Margin
    before_edge_m: q.Length


class Walking(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Gait of this body, see robot/control/walking.

    Attributes:
        base_height_m: base above the soles, standing and walking.
        stance_width_m, min_stance_width_m: between the soles' middles.
        single_support_s, double_support_s: of a step.
        start_s, stop_s: double support before the first and after the last step.
        step_height_m: apex of the swing foot.
        max_step_length_m, max_step_width_m, max_step_turn_rad: of one step.
        inward_turn_rad: most that a foot turns towards the other.
        sole_gap_m: least gap between two soles, seen along the standing one.
        max_forward_m_s, max_backward_m_s, max_sideways_m_s, max_turn_rad_s: of walking.
        acceleration_m_s2, turn_acceleration_rad_s2: of walking.
        sway_m: of the body to either side while it steps.
        lag_steps: from a wish to where it shows in the stance, in steps.
        catching: of steps against pushes.
        cruise, following, last_steps: of planned ways.
        room: that it wants.
    """

    base_height_m: q.Length
    stance_width_m: q.Length
    min_stance_width_m: q.Margin
    single_support_s: q.Duration
    double_support_s: q.Duration
    start_s: q.Duration
    stop_s: q.Duration
    step_height_m: q.Length
    max_step_length_m: q.Length
    max_step_width_m: q.Length
    max_step_turn_rad: q.Turn
    inward_turn_rad: q.Turn
    sole_gap_m: q.Margin
    max_forward_m_s: q.Speed
    max_backward_m_s: q.Speed
    max_sideways_m_s: q.Speed
    max_turn_rad_s: q.TurnRate
    acceleration_m_s2: q.Acceleration
    turn_acceleration_rad_s2: q.TurnAcceleration
    sway_m: q.Margin
    lag_steps: q.Ratio
    catching: Catching
    cruise: Cruise
    following: Following
    last_steps: LastSteps
    room: Room


class Gains(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A task's feedback: acceleration = kp x error + kd x error of velocity."""

    kp_1_s2: q.Stiffness
    kd_1_s: q.Damping


class Tasks(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Feedback of the whole body's tasks: base height and tilt, waist joints, swing foot."""

    height: Gains
    pelvis: Gains
    waist: Gains
    swing: Gains
    swing_turn: Gains


class Balance(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Keeping and changing the posture on both feet, see robot/control/legs.py.

    Attributes:
        lowest_base_m, highest_base_m: range of the base's height that the legs allow.
        squat_base_m: base height of a squat.
        height_m_s, waist_rad_s: how fast height and waist change.
        lean_forward_rad, lean_back_rad, turn_rad, bow_rad: of the waist, of named postures.
        max_one_leg_s: longest stand on one leg.
        one_leg_shift_s: of the weight onto that leg.
        friction: of a sole on the floor, a little under the least that it walks on.
        zmp_margin_m: of the commanded ZMP inside the soles' edges.
        cop_margin_m: of each foot's centre of pressure.
        trunk_zmp_m: how far beyond the soles a turning trunk brings the ZMP for a while.
        dcm_1_s: feedback of the divergent component of motion, see robot/control/walking/dcm.py.
        dcm_integral_1_s, dcm_integral_m: the same of its sum over time, standing, and its most.
        tasks: feedback gains.
    """

    lowest_base_m: q.Length
    highest_base_m: q.Length
    squat_base_m: q.Length
    height_m_s: q.Speed
    waist_rad_s: q.TurnRate
    lean_forward_rad: q.Angle
    lean_back_rad: q.Angle
    turn_rad: q.Angle
    bow_rad: q.Angle
    max_one_leg_s: q.Duration
    one_leg_shift_s: q.Duration
    friction: q.Friction
    zmp_margin_m: q.Margin
    cop_margin_m: q.Margin
    trunk_zmp_m: q.Margin
    dcm_1_s: q.Rate
    dcm_integral_1_s: q.Damping
    dcm_integral_m: q.Margin
    tasks: Tasks
