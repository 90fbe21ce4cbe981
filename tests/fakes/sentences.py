"""What sentences mean in the kitchen of tests, and what is believed to be on its table."""

from __future__ import annotations

from executive.blackboard import WORLD, Blackboard
from executive.meaning.request import Refused, request
from executive.trees.parts import errands
from robot.messages import Track, WorldState
from robot.se3 import SE3
from tests.fakes.worlds import WHERE, world_map


def steps(text: str) -> list[str]:
    outcome = request(text, WHERE)
    assert not isinstance(outcome, Refused), outcome
    return [errand.name for errand in errands(outcome.task)]


def refusal(text: str) -> Refused:
    outcome = request(text, WHERE)
    assert isinstance(outcome, Refused), outcome
    return outcome


def with_things_on_the_table(aside_m: dict[str, float]) -> Blackboard:
    """A board on which things were seen on the table, so far from its middle."""
    x, y, z = world_map().place("table").X_WP.p
    tracks = tuple(
        Track(id=name, X_WO=SE3((x, y + off, z + 0.05)), seen_s=0.0)
        for name, off in aside_m.items()
    )
    board = Blackboard()
    world = WorldState(stamp_s=0.0, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=tracks)
    board.claim(WORLD.writer).set(WORLD, world)
    return board
