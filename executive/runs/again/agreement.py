"""Whether the world is as a journal says that it was left: what is done, and what is not any more.

The journal says which steps were done. Of those that leave something behind, the world model is
asked whether it is still so: what was put somewhere lies there, what was picked up is in the hand.
A step whose result is gone is done again, with the picking up that it takes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import msgspec

from executive.journal.journal import Event
from executive.meaning.knowledge import Knowledge
from executive.skills.holding import Held
from executive.skills.motions.support import stands_on
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.trees.build import finished, meanings
from executive.trees.parts import Errand, Part, of_any_attempt, walk
from robot.errors import ConfigError
from robot.link import BodyLink
from robot.messages import BodyState, ObjectInfo, Side, WorldState
from robot.model.description import RobotDescription
from robot.se3 import SE3

SAME_SPOT_M = 0.1
"""How far a thing may be from the exact spot it was put on."""


class Agreement(msgspec.Struct, frozen=True, kw_only=True):
    """What to go on with.

    Attributes:
        done: paths of the steps that are done and whose results are still there.
        held: what the hands hold.
        again: names of steps that were done and are not any more, each with the reason.
    """

    done: frozenset[str]
    held: tuple[Held, ...]
    again: tuple[tuple[str, str], ...]


def look(
    events: Iterable[Event],
    task: Part,
    *,
    link: BodyLink,
    knowledge: Knowledge,
    robot: RobotDescription,
    done: frozenset[str] = frozenset(),
) -> Agreement:
    """Compare a journal with the world.

    Args:
        events: of the job that is gone on with.
        task: of that job.
        done: what was done before those events.
        link: to a body that is up, with a world model.
        knowledge: of the world.
        robot: its description.
    """
    events = list(events)
    done |= finished({"event": e.event, **e.data} for e in events)
    world = link.world()
    if link.body() is None or world is None:
        return Agreement(done=done, held=(), again=())
    held = in_hand(events, link=link, knowledge=knowledge, robot=robot)
    parts = walk(task, means=meanings(done))
    steps = [(path, part) for path, part in parts if isinstance(part, Errand)]
    newest = {of_any_attempt(path): path for path in sorted(done)}
    things = _Things(steps, frozenset(newest), {one.object_id for one in held}, world, knowledge)
    gone = things.gone()
    names = {path: step.name for path, step in steps}
    return Agreement(
        done=(done - {newest[path] for path in gone}) | things.nearly_done(events),
        held=held,
        again=tuple((names[path], why) for path, why in gone.items() if why),
    )


def in_hand(
    events: Iterable[Event], *, link: BodyLink, knowledge: Knowledge, robot: RobotDescription
) -> tuple[Held, ...]:
    """What the hands hold, with the grips that a journal knows; arguments as of `look`."""
    body, world = link.body(), link.world()
    if body is None or world is None:
        return ()
    hands = _Hands(body, world, knowledge, robot)
    return tuple(hands.held(_journalled(list(events))))


# --- what the hands hold -----------------------------------------------------------------------


def _journalled(events: list[Event]) -> dict[Side, Held]:
    """The newest grips in the journal, by hand."""
    for event in reversed(events):
        if event.event == "held":
            try:
                held = msgspec.convert(event.data.get("hands", {}), dict[str, Held])
            except msgspec.ValidationError as error:
                text = f"event {event.n} of the journal holds no grips: {error}"
                raise ConfigError(text) from None
            return {one.side: one for one in held.values()}
    return {}


@dataclass(frozen=True)
class _Hands:
    body: BodyState
    world: WorldState
    knowledge: Knowledge
    robot: RobotDescription

    def held(self, known: Mapping[Side, Held]) -> Iterator[Held]:
        """What the world model has in closed hands, with the grip as the journal knows it."""
        for track in self.world.tracks:
            side, X_WO = track.held_by, track.X_WO
            if side is None or X_WO is None:
                continue
            if self.body.hands[side].opening_m < self.robot.handy.gripping.least_gap_m:
                continue
            before = known.get(side)
            if before is not None and before.object_id == track.id:
                yield before
            elif (info := self.knowledge.object(track.id)) is not None:
                yield self._felt(info, side, X_WO)

    def _felt(self, info: ObjectInfo, side: Side, X_WO: SE3) -> Held:
        """A grip that the journal does not know, as it is felt: the arm carries as it is now."""
        hand = self.body.hands[side]
        X_WG = self.world.X_WN @ hand.X_NG
        joints = dict(zip(self.robot.motor_names, self.body.q_rad, strict=True))
        return Held(
            object_id=info.id,
            side=side,
            X_GO=X_WG.inverse() @ X_WO,
            gap_m=hand.opening_m,
            mass_kg=info.mass_kg,
            carry_rad=tuple(joints[name] for name in self.robot.groups[f"{side}_arm"]),
        )


# --- what is still so --------------------------------------------------------------------------


class _Things:
    """The steps that move things about, and where the things are."""

    def __init__(
        self,
        steps: list[tuple[str, Errand]],
        done: frozenset[str],
        held: set[str],
        world: WorldState,
        knowledge: Knowledge,
    ) -> None:
        self._steps: list[tuple[str, PickParams | PlaceParams]] = []
        for path, step in steps:
            if isinstance(step.params, PickParams | PlaceParams):
                self._steps.append((path, step.params))
        self._done = done
        self._held = held
        self._tracks = {track.id: track for track in world.tracks}
        self._knowledge = knowledge

    def gone(self) -> dict[str, str]:
        """Path of each step that was done and is not any more, and why; "" for what goes with it.

        Of several steps with the same thing only the last one counts.
        """
        last = {params.object_id: (path, params) for path, params in self._steps
                if path in self._done}  # fmt: skip
        gone: dict[str, str] = {}
        for object_id, (path, params) in last.items():
            why = self._why_not(params)
            if why:
                gone[path] = why
            if why and isinstance(params, PlaceParams) and object_id not in self._held:
                gone |= self._fetching(path, object_id)
        return gone

    def nearly_done(self, events: list[Event]) -> frozenset[str]:
        """The step that was under way, if it put a thing down and the thing is there."""
        begun = [str(e.data["id"]) for e in events if e.event == "step" and e.data.get("id")]
        for path, params in self._steps:
            if begun and path == of_any_attempt(begun[-1]) and isinstance(params, PlaceParams):
                return frozenset() if self._why_not(params) else frozenset({begun[-1]})
        return frozenset()

    def _fetching(self, path: str, object_id: str) -> dict[str, str]:
        """The picking up before a putting down."""
        before: dict[str, str] = {}
        for other, params in self._steps:
            if other == path:
                break
            if isinstance(params, PickParams) and params.object_id == object_id:
                before = {other: ""} if other in self._done else {}
        return before

    def _why_not(self, params: PickParams | PlaceParams) -> str:
        """Why what a step left behind is not so; empty when it is."""
        info = self._knowledge.object(params.object_id)
        if info is None:
            return ""
        name = info.full_name
        holding = params.object_id in self._held
        if isinstance(params, PickParams):
            return "" if holding else f"{name} is in no hand"
        if holding:
            return f"{name} is in the hand"
        track = self._tracks.get(params.object_id)
        if track is None or track.X_WO is None:
            return f"{name} has not been seen where it was put"
        if track.missing or not self._is_where(params, track.X_WO):
            on = None if track.missing else self._knowledge.surface_under(track.X_WO)
            return f"{name} is {f'on the {on.name}' if on else 'not there any more'}"
        return ""

    def _is_where(self, params: PlaceParams, X_WO: SE3) -> bool:
        if params.X_WO is not None:
            return math.dist(params.X_WO.p, X_WO.p) < SAME_SPOT_M
        place = self._knowledge.place(params.place_id) if params.place_id else None
        return place is None or stands_on(X_WO, place)
