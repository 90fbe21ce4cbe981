"""What people have said to the robot lately: written by the executive's senses, read by skills."""

from __future__ import annotations

from robot.messages import Heard


class Hearing:
    """The newest words of everybody. One per mission, handed to every skill in its context."""

    def __init__(self) -> None:
        """Nothing was heard yet."""
        self._newest: dict[str, Heard] = {}

    def note(self, heard: Heard) -> None:
        """Keep what somebody said in place of what they said before."""
        self._newest[heard.person_id] = heard

    def since(self, person_id: str, since_s: float) -> str:
        """What somebody has said after a moment; empty: nothing."""
        heard = self._newest.get(person_id)
        return heard.text if heard is not None and heard.stamp_s > since_s else ""

    def newest(self) -> dict[str, str]:
        """The newest words of everybody who has said something, by the person's id."""
        return {person_id: heard.text for person_id, heard in self._newest.items()}
