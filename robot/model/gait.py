"""How a body stands and walks: figures of its gait, and of keeping its balance."""

from __future__ import annotations

import msgspec


class Catching(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a swing leg can do to catch a push.

    Attributes:
        forward_m, side_m: furthest landing from the standing sole.
        width_m: least distance of the soles in such a step.
        swing_m_s: mean speed of the foot, to the landing.
    """

    forward_m: float
    side_m: float
    width_m: float
    swing_m_s: float


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
        catching: of steps against pushes.
    """

    base_height_m: float
    stance_width_m: float
    min_stance_width_m: float
    single_support_s: float
    double_support_s: float
    start_s: float
    stop_s: float
    step_height_m: float
    max_step_length_m: float
    max_step_width_m: float
    max_step_turn_rad: float
    inward_turn_rad: float
    sole_gap_m: float
    max_forward_m_s: float
    max_backward_m_s: float
    max_sideways_m_s: float
    max_turn_rad_s: float
    acceleration_m_s2: float
    turn_acceleration_rad_s2: float
    catching: Catching


class Gains(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A task's feedback: acceleration = kp x error + kd x error of velocity."""

    kp_1_s2: float
    kd_1_s: float


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
        tasks: feedback gains.
    """

    lowest_base_m: float
    highest_base_m: float
    squat_base_m: float
    height_m_s: float
    waist_rad_s: float
    lean_forward_rad: float
    lean_back_rad: float
    turn_rad: float
    bow_rad: float
    max_one_leg_s: float
    one_leg_shift_s: float
    friction: float
    zmp_margin_m: float
    cop_margin_m: float
    trunk_zmp_m: float
    tasks: Tasks
