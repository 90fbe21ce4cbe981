"""What can be foreseen: how long a job takes, and what could be asked of the robot here."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from executive.meaning.request import Setting, Understood, request
from executive.missions.plan import forecast
from robot.se3 import SE3

MOST = 4
"""Examples that are told at once."""
TRIES = 3
"""Things that each kind of example is tried with: a forecast takes a few tenths of a second."""


def takes_s(asked: Understood, where: Setting, X_WS: SE3 | None) -> float | None:
    """How long a job takes from where the robot stands; None where that cannot be said."""
    plan = forecast(asked.task, where, X_WS=X_WS)
    return None if plan.problems else plan.total_s


def examples(where: Setting, X_WS: SE3 | None) -> tuple[str, ...]:
    """Sentences that can be done in this world, each of another kind, as far as can be foreseen."""
    return tuple(islice(_possible(where, X_WS), MOST))


def _possible(where: Setting, X_WS: SE3 | None) -> Iterator[str]:
    known = where.world_map
    surfaces = [place.name for place in known.places if not place.floor]
    things = [info.full_name.removeprefix("the ") for info in known.objects]
    for said, names in (
        ("go to the {}", surfaces),
        ("pick up the {}", things),
        ("bring me the {}", things),
        ("look at the {}", [*things, *surfaces]),
        ("squat for {}", ["five seconds"]),
        ("walk {} forward", ["half a metre"]),
        ("say {}", ["hello"]),
    ):
        sentences = (said.format(name) for name in dict.fromkeys(names[:TRIES]))
        yield from islice((one for one in sentences if _can_be_done(one, where, X_WS)), 1)


def _can_be_done(sentence: str, where: Setting, X_WS: SE3 | None) -> bool:
    asked = request(sentence, where)
    return isinstance(asked, Understood) and takes_s(asked, where, X_WS) is not None
