"""Asking who stands in the way to step aside, and making room for who cannot."""

from __future__ import annotations

import math

from executive.skills.motions.back_away import make_way
from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import look_at
from executive.skills.motions.script import Script
from robot.messages import PersonInfo

REACT_S = 2.0
"""Who has not stirred after that either did not hear it or has nowhere to go."""
STILL_S = 0.6
"""Who has stood for that long after some steps has arrived."""
STIR_M = 0.1
"""People sway, and where they are believed to be does."""
ASIDE_M = 0.5
"""Who has gone as far as this has stepped aside, and may go on while the robot passes."""
ENOUGH_S = 6.0
FACE_M = 1.2
"""How high somebody is looked at, who may be anything from a child to tall."""


def call_ahead(body: Body, person: PersonInfo) -> None:
    """Ask somebody beside the way ahead to make room, once an encounter."""
    _say(body, body.context.encounters.open(person.id, body.now_s))


def ask_aside(body: Body, person: PersonInfo) -> Script[None]:
    """Ask somebody to step aside; step back if they do not, and ask again.

    Not in the same words: who was asked from afar is asked more plainly, and who has been asked in
    every way is waited for.
    """
    look_at(body, (*body.X_WPerson(person.id).p[:2], FACE_M))
    _plead(body, person)
    if not (yield from _stirs(body, person)):
        made_room = yield from make_way(body, person)
        _plead(body, person, made_room=made_room)
        yield from _stirs(body, person)


def ask_for_room(body: Body, person: PersonInfo) -> Script[None]:
    """Ask somebody to leave room who stands beside where a hand is to work; once, then goes on.

    Planners keep arms clear of them, or find no way past them; whoever stays is no reason to fail.
    """
    look_at(body, (*body.X_WPerson(person.id).p[:2], FACE_M))
    _plead(body, person)
    yield from _stirs(body, person)


def _plead(body: Body, person: PersonInfo, *, made_room: bool = False) -> None:
    _say(body, body.context.encounters.plead(person.id, body.now_s, made_room=made_room))


def _say(body: Body, words: str) -> None:
    if words:
        body.context.say(words)


def _stirs(body: Body, person: PersonInfo) -> Script[bool]:
    """Wait for somebody as long as they are on the move; whether they were at all."""
    words, body.phase = body.phase, f"waiting for {person.name} to step aside"
    first = last = body.X_WPerson(person.id).p[:2]
    start_s = since_s = body.now_s
    while body.now_s - start_s < ENOUGH_S:
        p = body.X_WPerson(person.id).p[:2]
        if math.dist(p, last) > STIR_M:
            last, since_s = p, body.now_s
        still_s = STILL_S if last != first else REACT_S
        if math.dist(p, first) > ASIDE_M or body.now_s - since_s > still_s:
            break
        yield
    body.phase = words
    return last != first
