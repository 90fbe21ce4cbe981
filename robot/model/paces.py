"""How long a body typically takes, as measured: forecasts are made of it, nothing else is."""

from __future__ import annotations

import msgspec

from robot.files import quantities as q


class SignSpans(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Gestures alone [s], from standing to standing; `raise_arm` is one of either side."""

    wave: q.Duration
    point: q.Duration
    nod: q.Duration
    shake_head: q.Duration
    bow: q.Duration
    raise_arm: q.Duration
    raise_both_arms: q.Duration


class PostureSpans(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Taking a posture and coming back from it [s]."""

    stand: q.Duration
    get_up: q.Duration
    squat: q.Duration
    one_leg: q.Duration
    lean: q.Duration
    hold: q.Duration


class Paces(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Typical spans, walks there left out.

    Attributes:
        walk_m_s, turn_rad_s: where no way is planned: steps by so much, and one too many.
        begin_s: of such steps: getting under way, coming to a stand.
        set_off_s, step_in_s: of a planned way: getting under way, exact steps at its end.
        sway: by how much a body is slower on its way than a point on the same.
        pick_s, place_s, give_s: of what hands do, the feet at their stance.
        look_s, search_s, inspect_s: turning the head and looking; around; a surface over.
        signs_s, postures_s: of gestures and postures.
    """

    walk_m_s: q.Speed
    turn_rad_s: q.TurnRate
    begin_s: q.Duration
    set_off_s: q.Duration
    step_in_s: q.Duration
    sway: q.Ratio
    pick_s: q.Duration
    place_s: q.Duration
    give_s: q.Duration
    look_s: q.Duration
    search_s: q.Duration
    inspect_s: q.Duration
    signs_s: SignSpans
    postures_s: PostureSpans
