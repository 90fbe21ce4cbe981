"""What a controller that takes over cannot know, told to it."""

from __future__ import annotations

from executive.skills.holding import Holdings
from robot.link import BodyLink
from robot.messages import BodyState, Payload


class Reminder:
    """Tells a controller that has not been told before what the hands carry."""

    def __init__(self, link: BodyLink, holdings: Holdings) -> None:
        """Remind the controller behind the link of what is held."""
        self._link = link
        self._holdings = holdings
        self._since_s: float | None = None

    def look(self, body: BodyState | None, now_s: float) -> None:
        """Look once a tick whether another controller reports."""
        if body is None or body.since_s == self._since_s:
            return
        self._since_s = body.since_s
        for held in self._holdings.all():
            self._link.send(
                Payload(
                    id=self._link.next_id(), stamp_s=now_s, side=held.side, mass_kg=held.mass_kg
                )
            )
