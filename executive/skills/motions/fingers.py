"""Fingers: opening, closing, and noticing that something is, or is no longer, between them."""

from __future__ import annotations

from executive.skills.motions.body_access import Body
from executive.skills.motions.script import Script, give_up
from robot.messages import Grip, Payload, Side

LONGER_S = 1.0
"""Than the hand's own control waits for its fingers, which says so itself then."""


def begin_opening(body: Body, side: Side, *, opening_m: float | None = None) -> float:
    """Have them open to a width (None: as far as they go); returns the width asked for [m]."""
    most_m = body.description.hands[side].max_opening_m
    wanted_m = most_m if opening_m is None else min(opening_m, most_m)
    body.send(Grip(**body.header(), side=side, opening_m=wanted_m))
    return wanted_m


def open_fingers(body: Body, side: Side, *, opening_m: float | None = None) -> Script[None]:
    """Open to a width (None: as far as they go) and wait until they have."""
    wanted_m = begin_opening(body, side, opening_m=opening_m)
    yield from _settle(body, side)
    if body.hand(side).opening_m < wanted_m - 0.02:
        raise give_up(
            "arm_stalled",
            f"the {side} fingers do not open",
            opening_m=round(body.hand(side).opening_m, 3),
        )


def close_fingers(body: Body, side: Side) -> Script[float]:
    """Close with full force until the fingers rest; returns the gap left between them [m]."""
    force_n = body.description.hands[side].max_force_n
    body.send(Grip(**body.header(), side=side, opening_m=0.0, force_n=force_n))
    yield from _settle(body, side)
    return body.hand(side).opening_m


def set_payload(body: Body, side: Side, mass_kg: float) -> None:
    """Tell the body what a hand carries, so that its balance reckons with it."""
    body.send(Payload(**body.header(), side=side, mass_kg=mass_kg))


def closed_on_air(body: Body, gap_m: float) -> bool:
    """Whether fingers that are so far apart hold nothing (effort cannot tell)."""
    return gap_m < body.description.handy.gripping.least_gap_m


def check_grips(body: Body) -> None:
    """Give up when a hand has lost what it held: its fingers have met."""
    for held in body.context.holdings.all():
        gap_m = body.hand(held.side).opening_m
        if closed_on_air(body, gap_m):
            body.context.holdings.release(held.side)
            set_payload(body, held.side, 0.0)
            name = body.object_info(held.object_id).name
            raise give_up(
                "object_dropped",
                f"the {name} left the {held.side} hand while {body.phase}",
                object=held.object_id,
                gap_m=round(gap_m, 4),
                gap_at_grasp_m=round(held.gap_m, 4),
            )


def check_taken(body: Body) -> None:
    """Give up when the eyes say by now that what a hand took is another thing than was wanted."""
    for held in body.context.holdings.all():
        track, name = body.track(held.object_id), body.object_info(held.object_id).full_name
        if track is not None and track.unlike:
            raise give_up(
                "wrong_object",
                f"what the {held.side} hand took for {name} is {track.unlike}",
                object=held.object_id,
                is_=track.unlike,
            )


def _settle(body: Body, side: Side) -> Script[None]:
    """Wait until the fingers have rested for a moment."""
    gripping = body.description.handy.gripping
    end_s = body.now_s + gripping.give_up_s + LONGER_S
    still_since_s = body.now_s + 0.1
    while body.now_s < end_s:
        yield
        if abs(body.hand(side).opening_m_s) > gripping.still_m_s:
            still_since_s = body.now_s
        if body.now_s - still_since_s >= gripping.rest_s:
            return
