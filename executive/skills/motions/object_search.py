"""Finding an object: look where it was, then wherever it may be, what is likely and near first."""

from __future__ import annotations

import math
from collections.abc import Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import SIGHTINGS, fresh_track, see
from executive.skills.motions.likelihood import prospects
from executive.skills.motions.look_closer import look_closer, unclear, unclear_words
from executive.skills.motions.look_over import look_over, walk_to_see
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.support import pose_on_support
from executive.skills.motions.survey import Survey
from robot.messages import Track
from robot.se3 import SE3

SIGHT_M = 3.0
"""From as near as this it is tried from here first whether an object is where it was."""
IN_VIEW_S = 2.0
"""What was seen that lately need not be looked for again."""
FRESH_S = 600.0
"""What was looked over longer ago may hold something else by now."""
GLIMPSED_S = 0.8
"""What shows in one picture on the way shows in more by then, or the feet stop for it."""


def find(
    body: Body, object_id: str, *, place_ids: Sequence[str] = (), by_sight: bool = False
) -> Script[SE3]:
    """Find an object: returns its pose X_WO, seen or (unless `by_sight`) remembered.

    Looks at the places first, then wherever else it may be. What the world model has seen since the
    object was seen last is not looked at again, whichever skill or job that was for; but a search
    after one that was in vain begins anew. Gives up with `object_not_seen`, saying where it looked.

    The feet do not stop for what is seen well enough on the way: who takes it sets out again at
    once. Where nobody tells them to go on they come to rest by themselves.
    """
    name = body.object_info(object_id).name
    believed = _believed(body, object_id)
    if believed is not None and body.context.holdings.find(object_id) is not None:
        return believed  # what a hand holds need not be seen
    just_now = fresh_track(body, object_id, body.now_s - IN_VIEW_S) is not None
    if believed is not None and (just_now or not by_sight):
        return believed
    if believed is not None:
        found = yield from _check_belief(body, object_id, believed)
        if found is not None:
            return found
    body.phase = f"looking around for the {name}"
    survey = _survey(body, object_id, place_ids)
    while (shows := (yield from _look_further(body, survey, object_id))).count:
        X_WO = shows.X_WO() if shows.enough else (yield from _make_sure(body, object_id))
        if X_WO is not None:
            return X_WO
    closer = yield from _look_closer(body, object_id)
    if closer is not None:
        return closer
    body.context.searched_s[object_id] = body.now_s
    raise give_up(
        "object_not_seen",
        f"did not find the {name}; {survey.words()}{_without_name(body, object_id)}",
        object=object_id,
        looked="everywhere",
    )


def _look_closer(body: Body, object_id: str) -> Script[SE3 | None]:
    """Look closer at what may be an object and has no name, until it shows."""
    shows = _Sightings(body, object_id)
    if not (yield from look_closer(body, (object_id,), (), shows)):
        return None
    return shows.X_WO() if shows.enough else (yield from _make_sure(body, object_id))


def _look_further(body: Body, survey: Survey, object_id: str) -> Script[_Sightings]:
    """Look over what a survey has left until an object shows."""
    shows = _Sightings(body, object_id)
    yield from look_over(body, survey, shows, in_passing=lambda: shows.enough)
    return shows


def _without_name(body: Body, object_id: str) -> str:
    """What it cannot name and may be what it looked for, else what it cannot name at all."""
    seen = unclear(body.world, (object_id,)) or tuple(one for one in body.world.unnamed if one.near)
    words = unclear_words(seen, body.map)
    return f"; has no name for {words}" if words else ""


def _survey(body: Body, object_id: str, place_ids: Sequence[str]) -> Survey:
    """What is left to look at for an object."""
    info, track = body.object_info(object_id), body.track(object_id)
    since_s = max(body.now_s - FRESH_S, body.context.searched_s.get(object_id, -math.inf))
    if track is not None and track.X_WO is not None:
        since_s = max(since_s, track.seen_s)
    likely = prospects(info, body.map, body.world.tracks, said=place_ids)
    return Survey(likely, since_s=since_s, fallen_from=_last_place(track))


def _believed(body: Body, object_id: str) -> SE3 | None:
    track = body.track(object_id)
    return track.X_WO if track is not None and not track.missing else None


def _check_belief(body: Body, object_id: str, X_WO: SE3) -> Script[SE3 | None]:
    """Look where the object was last, from nearby if need be."""
    body.phase = f"looking where the {body.object_info(object_id).name} was"
    if math.dist(X_WO.p[:2], body.X_WS.p[:2]) <= SIGHT_M:
        found = yield from _make_out(body, object_id)
        if found is not None:
            return found
    shows = _Sightings(body, object_id, within_m=SIGHT_M)
    if not (yield from walk_to_see(body, X_WO.p, lambda: shows() and shows.enough)):
        return None
    return shows.X_WO() if shows.enough else (yield from _make_out(body, object_id))


class _Sightings:
    """In how many pictures an object has been seen since now; called, whether the feet may stop.

    On the way for one picture they do not, unless no other follows.
    """

    def __init__(self, body: Body, object_id: str, *, within_m: float = math.inf) -> None:
        """Those from as near as that count."""
        self._body, self._object_id, self._within_m = body, object_id, within_m
        self._first_s = self._last_s = body.now_s
        self.count = 0

    def __call__(self) -> bool:
        """Take note of what has been seen; asked in every tick."""
        body, track = self._body, fresh_track(self._body, self._object_id, self._last_s)
        if track is not None and track.X_WO is not None and track.seen_s > self._last_s:
            far_m = math.dist(track.X_WO.p[:2], body.X_WS.p[:2])
            if far_m <= self._within_m:
                self._first_s = self._first_s if self.count else body.now_s
                self._last_s, self.count = track.seen_s, self.count + 1
        waits = body.state.mode == "walk" and body.now_s - self._first_s < GLIMPSED_S
        return self.enough or (self.count > 0 and not waits)

    @property
    def enough(self) -> bool:
        """Whether no look is needed any more."""
        return self.count >= SIGHTINGS

    def X_WO(self) -> SE3 | None:
        """Where it was seen last."""
        X_WO = _believed(self._body, self._object_id)
        return None if X_WO is None else pose_on_support(self._body, self._object_id, X_WO)


def _make_out(body: Body, object_id: str) -> Script[SE3 | None]:
    """Look at where an object is believed to be; None if it does not show."""
    try:
        return (yield from see(body, object_id))
    except GaveUp as end:
        if end.failure.code != "object_not_seen":
            raise
        return None


def _make_sure(body: Body, object_id: str) -> Script[SE3 | None]:
    """Look at what was glimpsed; from far or half hidden, the glimpse has to do."""
    glimpse = _believed(body, object_id)
    found = yield from _make_out(body, object_id)
    return found if found is not None else _believed(body, object_id) and glimpse


def _last_place(track: Track | None) -> tuple[float, float, float] | None:
    """Where the object was last, whether it is still there or not."""
    return track.X_WO.p if track is not None and track.X_WO is not None else None
