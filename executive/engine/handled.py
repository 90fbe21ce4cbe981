"""Where the things that went through the hands came from, and to whom they went."""

from __future__ import annotations

from executive.skills.holding import Holdings
from executive.skills.motions.support import rests_on
from robot.messages import WorldMap, WorldState
from robot.se3 import SE3


class Handled:
    """Follows what stands where, from tick to tick.

    Attributes:
        taken_from: id of a thing to where it stood before a hand took it last, X_WO.
        given: id of a thing to that of whom it was given to and who has it, as far as is known.
    """

    def __init__(self, holdings: Holdings) -> None:
        """Nothing was seen yet."""
        self.taken_from: dict[str, SE3] = {}
        self._holdings = holdings
        self._stood: dict[str, SE3] = {}
        self._held: set[str] = set()
        self._given_s: dict[str, float] = {}

    @property
    def given(self) -> dict[str, str]:
        """As `Holdings` knows it."""
        return self._holdings.given

    def look(self, world: WorldState | None, world_map: WorldMap | None) -> None:
        """Take the newest of what is believed."""
        held = {one.object_id for one in self._holdings.all()}
        for object_id in held - self._held:
            if object_id in self._stood:
                self.taken_from = {**self.taken_from, object_id: self._stood[object_id]}
        self._held = held
        if world is None:
            return
        for track in world.tracks:
            if track.X_WO is not None and track.held_by is None and track.id not in held:
                self._stood[track.id] = track.X_WO
        if world_map is not None:
            self._see_put_away(world, world_map)

    def _see_put_away(self, world: WorldState, world_map: WorldMap) -> None:
        """Who was given something has put it down if it is seen to stand somewhere since."""
        given = self.given
        self._given_s = {id_: self._given_s.get(id_, world.stamp_s) for id_ in given}
        for track in world.tracks:
            info = world_map.object(track.id) if track.id in given else None
            if info is None or track.X_WO is None or track.missing:
                continue
            since = track.seen_s > self._given_s[track.id]
            if since and any(rests_on(track.X_WO, info, place) for place in world_map.places):
                self._holdings.put_away(track.id)
