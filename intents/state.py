"""What the robot knows of itself when it is spoken to; questions are answered from it."""

from collections.abc import Callable

import msgspec

from intents.grounding import Entity
from intents.relations import Viewpoint

_NO_ENTITIES: tuple[Entity, ...] = ()


def _unforeseen() -> None:
    """Nothing is known of how long anything takes."""


class RobotState(msgspec.Struct, frozen=True, kw_only=True):
    """A snapshot, made by the executive for each turn. Everything has a default.

    Attributes:
        entities: The objects known, with where they are as far as that is known; ``held`` marks
            those in a hand.
        seen: Ids of those in view now.
        spots: The places by their names, with the middle of each, x and y [m].
        place: Name of the place it stands at, or empty.
        room: Name of the room it is in, or empty.
        view: Where it stands and looks, for "the leftmost" and "behind the bottle".
        doing: What it is doing, in words; empty when idle.
        step: The step that it is at, in words.
        worked_s: How long it has been at that by now; None when idle.
        foresee_s: Says how long that takes in all, which may take a while to find out; None if
            that cannot be foreseen.
        operator: Where the person is whom it listens to, in words ("at the table in the kitchen");
            empty if it does not know.
        examples: Says sentences that could be done here and now; that may take a while too.
        waiting: The jobs that wait, in words.
        mode: "idle", "working", "paused" or "stopped".
        holds: Why it stands with something to do, in words; empty when it does not.
        problems: What is wrong with it, in words; empty when all is well.
        battery: State of charge, 0 to 1; None without a battery.
        last: How the last job ended, in words, with its reason ("I could not ...: ...").
        did: What the last job that is over was asked in, as it was said; empty if there is none.
        skills: Types of goals that it has skills for ("pick"); empty means all.
    """

    entities: tuple[Entity, ...] = _NO_ENTITIES
    seen: tuple[str, ...] = ()
    spots: tuple[tuple[str, float, float], ...] = ()
    place: str = ""
    room: str = ""
    view: Viewpoint | None = None
    doing: str = ""
    step: str = ""
    worked_s: float | None = None
    foresee_s: Callable[[], float | None] = _unforeseen
    operator: str = ""
    examples: Callable[[], tuple[str, ...]] = tuple
    waiting: tuple[str, ...] = ()
    mode: str = "idle"
    holds: str = ""
    problems: tuple[str, ...] = ()
    battery: float | None = None
    last: str = ""
    did: str = ""
    skills: frozenset[str] = frozenset()

    @property
    def held(self) -> tuple[Entity, ...]:
        """What it has in its hands."""
        return tuple(entity for entity in self.entities if entity.held)
