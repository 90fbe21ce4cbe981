"""Turning the head and waiting to see."""

from __future__ import annotations

import math

from executive.skills.motions.body_access import Body
from executive.skills.motions.script import Script, give_up
from executive.skills.motions.support import pose_on_support
from robot.messages import Look, Track
from robot.se3 import SE3, Vector3

HEAD_TIMEOUT_S = 2.0
SIGHT_TIMEOUT_S = 2.5
SIGHTINGS = 3
MISSED_AFTER_S = 0.6
"""An object whose place is in clear view is seen by then, or it is not there."""
CAMERA_SILENT_S = 0.5


def look_at(body: Body, p_W: Vector3) -> int:
    """Send the head to look at a point of the world; returns the command's id."""
    return body.send(Look(**body.header(), p_N=body.to_N(SE3(p_W)).p))


def turn_head(body: Body, p_W: Vector3) -> Script[None]:
    """Look at a point and wait until the head is there, or as far as it turns."""
    command_id = look_at(body, p_W)
    end_s = body.now_s + HEAD_TIMEOUT_S
    while body.now_s < end_s:
        yield
        activity = body.activity("head", command_id)
        if activity is not None and activity.status != "running":
            return


def see(
    body: Body,
    object_id: str,
    *,
    p_W: Vector3 | None = None,
    remembered_since_s: float = math.inf,
) -> Script[SE3]:
    """Look at an object where it is believed to be (or at p_W) and wait for fresh sightings.

    Returns its pose X_WO; one that is hidden now, as behind the robot's own hand, is where it was
    seen last, if that was since `remembered_since_s`. Gives up with `object_not_seen` if it does
    not show, and with `sensor_silent` if the camera is silent.
    """
    name = body.object_info(object_id).name
    track = body.track(object_id)
    if p_W is None and track is not None and track.X_WO is not None:
        p_W = track.X_WO.p
    if p_W is None:
        raise give_up("object_not_seen", f"the {name} has not been seen yet", object=object_id)
    yield from turn_head(body, p_W)
    check_camera(body)
    X_WO = yield from _fresh(body, object_id)
    if X_WO is None:
        hidden = fresh_track(body, object_id, remembered_since_s)
        if hidden is not None and hidden.X_WO is not None:
            return pose_on_support(body, object_id, hidden.X_WO)
        check_camera(body)
        raise give_up(
            "object_not_seen",
            f"looked for the {name} at ({p_W[0]:.2f}, {p_W[1]:.2f}) m and did not see it",
            object=object_id,
            last_seen_s=round(track.seen_s, 2) if track and track.X_WO else "never",
        )
    return X_WO


def check_camera(body: Body) -> None:
    """Give up when the camera has been silent for a while: nobody reaches blindly."""
    image = body.link.depth()
    if image is None:
        return  # there is none yet, or this body has none
    age_s = body.now_s - image.stamp_s
    if age_s > CAMERA_SILENT_S:
        raise give_up(
            "sensor_silent",
            f"the camera has been silent for {age_s:.1f} s while {body.phase}",
            sensor="camera",
            age_s=round(age_s, 2),
        )


def fresh_track(body: Body, object_id: str, since_s: float) -> Track | None:
    """The track of an object if it was seen at or after a time."""
    track = body.track(object_id)
    if track is None or track.X_WO is None or track.missing or track.seen_s < since_s:
        return None
    return track


def _fresh(body: Body, object_id: str) -> Script[SE3 | None]:
    """Wait for a few sightings newer than now; the last pose, or None if they do not come."""
    begin_s = body.now_s
    seen_s = begin_s
    count = 0
    while body.now_s < begin_s + SIGHT_TIMEOUT_S:
        yield
        track = fresh_track(body, object_id, begin_s)
        if track is not None and track.seen_s > seen_s:
            seen_s, count = track.seen_s, count + 1
        if track is not None and count >= SIGHTINGS:
            break
        now = body.track(object_id)
        if now is not None and now.missing and body.now_s - begin_s > MISSED_AFTER_S:
            break
    track = fresh_track(body, object_id, begin_s)
    if track is None or track.X_WO is None:
        return None
    return pose_on_support(body, object_id, track.X_WO)
