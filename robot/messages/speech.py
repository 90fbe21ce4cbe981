"""What the robot says, and what people say to it."""

from __future__ import annotations

from robot.messages.basics import Message, Source


class Spoken(Message, frozen=True, kw_only=True):
    """What the robot says aloud: people who stand near can hear it."""

    text: str


class Heard(Message, frozen=True, kw_only=True):
    """What a person says to the robot; `source` is "oracle" for people who are simulated."""

    text: str
    person_id: str
    source: Source = "oracle"
