"""How a body uses its arms and hands: speeds, loads, reach, and from where it reaches out.

No figure has a value here: all of them stand in a robot's own description. What may be left out is
what a robot has not (a turn of a lean), or was not measured.
"""

from __future__ import annotations

import msgspec

from robot.files import quantities as q


class Arms(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Motions of an arm, see robot/control/arm.py and robot/planning/arm_path.py.

    Attributes:
        speed_rad_s, acceleration_rad_s2: of planned motions, each joint.
        brake_rad_s2, brake_rad_s3: of coming to rest.
        line_rate_1_s: how fast an error of the hand on a line is taken back.
        line_speed_rad_s: most of a joint on a line.
        line_lead_rad: most that a joint's target runs ahead of the joint.
        elbow_1_s, elbow_rad_s: on a line, how fast what leaves the hand alone goes where it should:
            gain of the error, and most of a joint.
        max_lift_kg: heaviest thing to pick up.
        max_payload_kg: heaviest that the controller believes to be in a hand.
        line_most_m: what a hand on a line is further off is approached at this error's speed.
        line_done_m, line_done_rad: off by less, a line is done.
        line_near_m: the same where the hand has come no nearer for `give_up_s`.
        joints_done_rad: off by less, a motion of the joints is done.
        give_up_s: after its end a motion that is not done has failed.
        still_rad_s: joints slower than this are at rest.
    """

    speed_rad_s: q.TurnRate
    acceleration_rad_s2: q.TurnAcceleration
    brake_rad_s2: q.TurnAcceleration
    brake_rad_s3: q.TurnJerk
    line_rate_1_s: q.Rate
    line_speed_rad_s: q.TurnRate
    line_lead_rad: q.Turn
    elbow_1_s: q.Rate
    elbow_rad_s: q.TurnRate
    max_lift_kg: q.Mass
    max_payload_kg: q.Mass
    line_most_m: q.Length
    line_done_m: q.Length
    line_done_rad: q.Turn
    line_near_m: q.Length
    joints_done_rad: q.Turn
    give_up_s: q.Duration
    still_rad_s: q.TurnRate


class Gripping(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What both hands have in common, see robot/control/hand.py and robot/planning/grasps.py.

    Attributes:
        closing_m_s: how fast the opening's reference changes, along one finger.
        friction: least of a pad on what it holds.
        held_n: a motor that closes with more holds something.
        peak_share: of the motor's peak force, what a tightened grip may take.
        least_gap_m: a smaller opening of closed fingers means that they hold nothing.
        fingertip_m: reach of the pads past the grasp point.
        hold_depth_m: most that the grasp point is behind the near face of an object.
        slack_m: by how much the opened hand is wider than what it takes.
        half_width_m: of the opened hand, along its closing direction.
        lowest_m: least height of the grasp point above what an object stands on, level.
        spare_m: by how much the widest thing to take is narrower than the opened hand.
        open_to_take_m, open_to_leave_m: how far beyond an object's width the fingers open before
            they take it, and to let it go.
        done_m: so near to what was asked for the opening is there.
        still_m_s: a motor, or an opening, that changes slower is at rest.
        settle_s, rest_s: how long, before the hand's control and before a skill believes it.
        give_up_s: fingers that are not at rest by then have failed.
        load_s: time over which the load at the wrist is averaged.
        gap_m: fingers closed on a thing whose opening is off by more hold it off its middle.
        held_within_m, lost_beyond_m: from the grasp point: what is nearer when the fingers close on
            it is held; what is seen farther off is not, any more.
        contact_n: least change of the wrist's load that is a contact.
        press_m: how far beyond where a thing should stand the hand is led down.
        before_m: between the fingertips and an object, before they take it.
        behind_m: the same where the hand is drawn back to after it let go.
        low_m: what is no more than this higher than `lowest_m` is taken with the fingertips just
            above what it stands on.
        finger_half_m: half the height of a finger.
        beside_m: between two objects, or an object and the fingers around another.
    """

    closing_m_s: q.Speed
    friction: q.Friction
    held_n: q.Force
    peak_share: q.Share
    least_gap_m: q.Margin
    fingertip_m: q.Margin
    hold_depth_m: q.Margin
    slack_m: q.Margin
    half_width_m: q.Length
    lowest_m: q.Margin
    spare_m: q.Margin
    open_to_take_m: q.Margin
    open_to_leave_m: q.Margin
    done_m: q.Length
    still_m_s: q.Speed
    settle_s: q.Duration
    rest_s: q.Duration
    give_up_s: q.Duration
    load_s: q.Duration
    gap_m: q.Length
    held_within_m: q.Length
    lost_beyond_m: q.Length
    contact_n: q.Force
    press_m: q.Margin
    before_m: q.Margin
    behind_m: q.Margin
    low_m: q.Margin
    finger_half_m: q.Margin
    beside_m: q.Margin


class Lean(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A posture to reach out in.

    Attributes:
        pitch_rad: of the waist, forward.
        yaw_rad: of the waist, the reaching shoulder forward.
        ahead_m: distances of the grasp point ahead of the feet that it is good for.
        aside_m: the same to the arm's side; empty: those of `Reaching`.
        cost: how little it is liked beside the others.
        quota: how many candidates of it a search looks at.
        base_height_m: of the base; None: as for walking.
        last: whether it is tried only where none of the others leads there.
        arm: name of a posture with the arm up and over an edge: the inverse kinematics begin there;
            empty: in those that they begin in otherwise.
        hand_rad: headings of the hand from the feet's, outwards; empty: about as it points by
            itself.
        from_m: least height of what is handled that it is for.
    """

    pitch_rad: q.Angle = 0.0
    yaw_rad: q.Angle = 0.0
    ahead_m: q.Several[q.Offset]
    aside_m: q.Several[q.Offset] = ()
    cost: q.Cost
    quota: q.Quota
    base_height_m: q.Length | None = None
    last: bool = False
    arm: str = ""
    hand_rad: q.Several[q.Angle] = ()
    from_m: q.Offset = 0.0


class Carrying(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where a hand may hold something near the body, from the base: every combination is tried.

    `ahead_m`, `aside_m` (outwards), `up_m` place the grasp point, `turns_rad` (inwards) its
    heading; the nearer to `best_m` (ahead, aside) the better.
    """

    ahead_m: q.Several[q.Offset]
    aside_m: q.Several[q.Offset]
    up_m: q.Several[q.Offset]
    turns_rad: q.Several[q.Angle]
    best_m: tuple[q.Offset, q.Offset]


class Raising(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where a hand is raised before its goal, for stepping in: every combination, best first.

    Attributes:
        up_m, back_m: above the goal, and back from it.
        over_up_m, over_back_m: the same over an edge: the trunk stands up lower than it reached
            out, so the hand is raised more,
        over_turns_rad: and may turn about the vertical.
    """

    up_m: q.Several[q.Margin]
    back_m: q.Several[q.Margin]
    over_up_m: q.Several[q.Margin]
    over_back_m: q.Several[q.Margin]
    over_turns_rad: q.Several[q.Angle]


class SteppingIn(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From the standoff to the stance with a raised hand, and back.

    Attributes:
        in_line_m, in_line_rad: off the line to the stance: what the step in corrects.
        bring_in_m, bring_in_rad: as near as this to the standoff, going back, the arm comes in.
        short_m, short_rad: what a step nearer cures where an arm does not get there.
        nearer_m: by how much more than that is stepped, and
        nearer_tolerance_m: how exactly.
        beside_edge_m: where it stands that reaches over an edge, from that edge.
    """

    in_line_m: q.Margin
    in_line_rad: q.Turn
    bring_in_m: q.Margin
    bring_in_rad: q.Turn
    short_m: q.Margin
    short_rad: q.Turn
    nearer_m: q.Margin
    nearer_tolerance_m: q.Margin
    beside_edge_m: q.Margin


class Reaching(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where to stand and how, so that a hand gets somewhere; see robot/planning/stances.py.

    Attributes:
        leans: postures, the upright one first.
        far_m: further ahead of the feet an upright robot's arm is stretched.
        aside_m, best_aside_m: distances of the grasp point from the middle, to the arm's side.
        inward_rad, inward_rad_m: the hand points inwards by the first less the second times its
            distance from the middle.
        upright_m: furthest ahead of the feet that the raised hand is carried, upright.
        raised_hand_m: grasp point of a hand held out level, in S, of the left hand.
        step_in_m: lengths of the last straight steps before a stance, in the order of trying.
        arm_room_m: clearance of a standing place at which an arm can be raised freely.
        over_room_m: the same for an arm that goes up and over an edge beside it.
        floor_m: what is lower lies on the floor: no stance brings a hand there.
        raise_within_m: how near the standoff the hand begins to be raised while the feet go on.
        steps_back_m: straight back, to get a hand out from among things: the first that is free.
        narrow_m, roomy_m: least clearance of a stance's middle, and that which costs nothing.
        carrying: of things in the hand.
        deep_m: how far from the edge of a surface a hand picks up, by the surface's height, rising:
            (height, depth); for the words of a refusal. Empty: not measured.
        surfaces_m: least and greatest height of a surface that something is put on. None: not
            measured.
        raising: the hand, before the steps in.
        stepping_in: with it.
    """

    leans: q.Several[Lean]
    far_m: q.Length
    aside_m: q.Several[q.Offset]
    best_aside_m: q.Offset
    inward_rad: q.Angle
    inward_rad_m: q.Slope
    upright_m: q.Length
    raised_hand_m: tuple[q.Offset, q.Offset, q.Offset]
    step_in_m: q.Several[q.Length]
    arm_room_m: q.Margin
    over_room_m: q.Margin
    floor_m: q.Length
    raise_within_m: q.Length
    steps_back_m: q.Several[q.Length]
    narrow_m: q.Margin
    roomy_m: q.Margin
    carrying: Carrying
    deep_m: q.Several[tuple[q.Offset, q.Offset]] = ()
    surfaces_m: tuple[q.Offset, q.Offset] | None = None
    raising: Raising
    stepping_in: SteppingIn


class HandSpeeds(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of the hand on straight lines, see executive/skills/pick.py and place.py.

    Attributes:
        approach_m_s: to an object, and back from it with open fingers.
        lift_m_s, carry_m_s: with it: up, and over its place.
        lower_m_s: with it down onto its place: what it is met with.
        give_back_m_s: the same after a lift that failed.
    """

    approach_m_s: q.Speed
    lift_m_s: q.Speed
    carry_m_s: q.Speed
    lower_m_s: q.Speed
    give_back_m_s: q.Speed


class Giving(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Handing things over.

    Attributes:
        before_person_m: from the person's middle to the feet; the hand comes half of the way.
        held_out_m: grasp points to hold something out at, in S, of the left hand, best first.
        pull_n, pulled_m: a change of the wrist's load, or a way of the hand, that is a pull,
        pull_s: once it has lasted so long.
    """

    before_person_m: q.Length
    held_out_m: q.Several[tuple[q.Offset, q.Offset, q.Offset]]
    pull_n: q.Force
    pulled_m: q.Length
    pull_s: q.Duration


class Handling(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a robot's hands are good for."""

    gripping: Gripping
    reaching: Reaching
    speeds: HandSpeeds
    giving: Giving


class Signs(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Gestures: names of postures, and how far a pointing hand is stretched from the shoulder.

    `ahead_m` is how far ahead of where it hangs a raised hand waves, about.
    """

    raised: str
    waving: q.Several[str]
    pointing_m: q.Several[q.Length]
    ahead_m: q.Margin
