"""Whom the robot has asked to step aside, and in which words: nobody is asked the same twice."""

from __future__ import annotations

from dataclasses import dataclass

EXCUSE = "Excuse me."
PLEAS = (
    EXCUSE,
    "Could you step aside, please?",
    "Please let me pass.",
)
"""From afar or before them; where they have not left; and when the robot has stepped back."""
OVER_S = 20.0
"""Who has not been in the way for so long is met anew."""


@dataclass
class _Encounter:
    said: int
    last_s: float


class Encounters:
    """Who was in the way lately. One per mission, handed to every skill in its context."""

    def __init__(self) -> None:
        """Nobody was met yet."""
        self._met: dict[str, _Encounter] = {}

    def open(self, person_id: str, now_s: float) -> str:
        """What to say to somebody who is in the way ahead; nothing where they know already."""
        met = self._meet(person_id, now_s)
        return "" if met.said else self._next(met)

    def plead(self, person_id: str, now_s: float, *, made_room: bool = False) -> str:
        """What to say to somebody before whom the robot stands; nothing once all was said.

        Who has been given more room since has something new to go by: the last is said again.
        """
        met = self._meet(person_id, now_s)
        return PLEAS[-1] if made_room and met.said == len(PLEAS) else self._next(met)

    def _meet(self, person_id: str, now_s: float) -> _Encounter:
        met = self._met.get(person_id)
        if met is None or now_s - met.last_s > OVER_S:
            met = self._met[person_id] = _Encounter(0, now_s)
        met.last_s = now_s
        return met

    @staticmethod
    def _next(met: _Encounter) -> str:
        if met.said == len(PLEAS):
            return ""
        met.said += 1
        return PLEAS[met.said - 1]
