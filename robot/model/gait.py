"""How a body stands and walks: figures of its gait, and of keeping its balance.

No figure has a value here: all of them stand in a robot's own description.
"""

from __future__ import annotations

import msgspec

from robot.files import quantities as q


class Catching(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a swing leg can do to catch a push.

    Attributes:
        forward_m, side_m: furthest landing from the standing sole.
        width_m: least distance of the soles in such a step.
        swing_m_s: mean speed of the foot, to the landing.
        start_s: double support before such a step from standing.
        double_support_s: most of it after a step that landed with more than `late_m` of error.
        ignored_m: error of the DCM at the landing that moves no step.
        retimed_m: above this it moves the time of a step too.
        late_m: above this, as the foot lands, the next step has to come soon.
    """

    forward_m: q.Length
    side_m: q.Length
    width_m: q.Margin
    swing_m_s: q.Speed
    start_s: q.Duration
    double_support_s: q.Duration
    ignored_m: q.Margin
    retimed_m: q.Margin
    late_m: q.Margin


class SwingFoot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a foot goes up and comes down, see robot/control/walking/swing.py.

    Attributes:
        rising: part of a step in which it goes up to `Walking.step_height_m`.
        longest_s: most of going up, and of coming down, in steps that last longer.
        touch_m: how far below the floor an ordinary step's profile ends, and
        touch_m_s: how fast: also how a foot that found no floor goes on down.
        press_m: how far below it ends, at rest, in a step that is to catch the body.
    """

    rising: q.Share
    longest_s: q.Duration
    touch_m: q.Margin
    touch_m_s: q.Speed
    press_m: q.Margin


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
        slow_in_bends_1_rad: by how much it slows down for what there is to turn.
        turn_first_rad, turn_done_rad: with more to turn it turns on the spot first, down to this.
        aside: part of the sideways speed that ways make use of.
        done_m: as near as this to its end a stretch is walked.
        stalled_m, stalled_rad: who has moved by less for some seconds does not get on.
        least_s, patience_s_m: what a way may take: so long, and so long for a metre.
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
    slow_in_bends_1_rad: q.Slowing
    turn_first_rad: q.Turn
    turn_done_rad: q.Turn
    aside: q.Share
    done_m: q.Margin
    stalled_m: q.Length
    stalled_rad: q.Turn
    least_s: q.Duration
    patience_s_m: q.Slowness


class LastSteps(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From where steps to an exact stance take over from following a way.

    Attributes:
        within_m: as near as this to the stance,
        aside_m: with no more of that to a side,
        turn_rad: and no more to turn.
        facing_rad: with no more than that to turn no way is followed at all.
    """

    within_m: q.Length
    aside_m: q.Length
    turn_rad: q.Turn
    facing_rad: q.Turn


class ExactSteps(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How exactly a body steps onto a stance, see executive/skills/motions/final_steps.py.

    Attributes:
        tolerance_m, tolerance_rad: off by more, it steps again.
        there_m, there_rad: as near as this it need not step at all, and what it aims at.
        bears_m, bears_rad: off by so much to every side, a planned stance still has to do.
        least_s, patience_s_m, patience_s_rad: what it may take: so long, and so long for a metre
            and a radian.
    """

    tolerance_m: q.Margin
    tolerance_rad: q.Turn
    there_m: q.Margin
    there_rad: q.Turn
    bears_m: q.Margin
    bears_rad: q.Turn
    least_s: q.Duration
    patience_s_m: q.Slowness
    patience_s_rad: q.TurnSlowness


class Room(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the moving body wants free around it: from its middle, but for `beside_m`.

    Attributes:
        turning_m: to turn on the spot without its arms touching anything.
        passing_m: half of a gap that it goes through without touching.
        slow_m: what is nearer to a way than that is passed slowly.
        beside_m: beyond the body's radius, beside a way where there is room.
        before_edge_m: where it stands at a table, from its edge.
        beside_people_m: the same as `beside_m` beside people, further from them.
    """

    turning_m: q.Length
    passing_m: q.Length
    slow_m: q.Length
    beside_m: q.Margin
    before_edge_m: q.Length
    beside_people_m: q.Margin


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
        settle_s: how long it stands before it counts as standing.
        tall_m: it steps once it is no more than this lower than `base_height_m`.
        catching: of steps against pushes.
        swing_foot: its way up and down.
        cruise, following, last_steps: of planned ways.
        exact_steps: onto a stance.
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
    settle_s: q.Duration
    tall_m: q.Margin
    swing_foot: SwingFoot
    exact_steps: ExactSteps


class Gains(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A task's feedback: acceleration = kp x error + kd x error of velocity."""

    kp_1_s2: q.Stiffness
    kd_1_s: q.Damping


class Tasks(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Feedback of the whole body's tasks: base height and tilt, waist joints, swing foot.

    `joints_1_s` damps the legs' joints, which nothing else tells how to move; `soles_1_s` the
    soles on the floor, whose slipping ends so.
    """

    height: Gains
    pelvis: Gains
    waist: Gains
    swing: Gains
    swing_turn: Gains
    joints_1_s: q.Damping
    soles_1_s: q.Damping


class Falling(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """When it cannot be held up any more, see robot/control/posture.py.

    Attributes:
        tilt_rad: the trunk leans by more.
        low: part of `Walking.base_height_m` that the base is under.
        upright_rad: leaning by less than this it is on its feet.
    """

    tilt_rad: q.Turn
    low: q.Share
    upright_rad: q.Turn


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
        falling: what is no balance any more.
        slid_m, slid_rad: a sole that bears so far from where it was planted has slid.
        bow_s: how long a bow lasts.
        pushed_m_s: a base that is faster, as it stands, was pushed.
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
    falling: Falling
    slid_m: q.Margin
    slid_rad: q.Turn
    bow_s: q.Duration
    pushed_m_s: q.Speed
