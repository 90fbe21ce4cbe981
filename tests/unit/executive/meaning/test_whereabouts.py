"""A sentence means later what it meant when it was taken, wherever the robot stands by then."""

import json
from math import pi

import msgspec
import pytest
from msgspec.structs import replace

from executive.journal.journal import Event
from executive.meaning import request
from executive.meaning.knowledge import Knowledge
from executive.runs.again import recording
from executive.runs.session import Session
from executive.trees.parts import Settle, errands, walk
from intents.goals import from_builtins
from intents.relations import Viewpoint
from intents.state import RobotState
from robot.errors import ConfigError
from tests.fakes.worlds import WHERE, world_map

FACING = Viewpoint(x_m=0.0, y_m=0.0, yaw_rad=0.0)
BEHIND = Viewpoint(x_m=4.0, y_m=0.0, yaw_rad=pi)
SPOTS = {"cup_red": (2.0, 0.3, 0.8), "cup_blue": (2.0, -0.3, 0.8)}


def seen(view: Viewpoint) -> RobotState:
    """Both cups on the table, seen from somewhere."""
    entities = tuple(
        replace(entity, p_WO=SPOTS.get(entity.id)) for entity in Knowledge(world_map()).entities()
    )
    return RobotState(entities=entities, view=view)


def meant(state: RobotState | None, **query: object) -> request.Understood:
    goals = from_builtins([{"goal": "look_at", "object": {"name": "cup", **query}}])
    understood = request.meant("look at it", goals, WHERE, state=state)
    assert isinstance(understood, request.Understood), understood
    return understood


def objects(understood: request.Understood) -> list[str]:
    return [errand.params.object_id for errand in errands(understood.task)]


def submitted(understood: request.Understood) -> Event:
    """The event of its submission, as it comes back from a journal."""
    origins: list[dict] = []

    class Executive:
        def submit(self, _build, *, origin, **_):
            origins.append(json.loads(msgspec.json.encode(origin)))
            return 1

    session = Session.__new__(Session)
    session.executive = Executive()  # type: ignore[assignment]
    session.submit(understood)
    return Event(0, 0.0, "request", {"text": understood.text, "origin": origins[0]})


@pytest.mark.parametrize(
    "query",
    [{"superlative": "leftmost"}, {"superlative": "nearest", "color": "red"},
     {"relation": {"how": "left", "of": {"name": "cup", "color": "blue"}}}],
)  # fmt: skip
@pytest.mark.parametrize("view", [FACING, BEHIND])
def test_it_is_restored_as_it_was_meant(query: dict, view: Viewpoint, tmp_path):
    if view is BEHIND and "relation" in query:
        query = {"relation": {"how": "left", "of": {"name": "cup", "color": "red"}}}
    understood = meant(seen(view), **query)
    restored = recording.restore(submitted(understood), tmp_path, WHERE)
    assert objects(restored) == objects(understood)
    assert restored.whereabouts == understood.whereabouts


def test_what_is_leftmost_depends_on_where_it_stood():
    assert objects(meant(seen(FACING), superlative="leftmost")) == ["cup_red"]
    assert objects(meant(seen(BEHIND), superlative="leftmost")) == ["cup_blue"]


def test_without_what_was_known_then_it_has_to_be_looked_for(tmp_path):
    event = submitted(meant(seen(FACING), superlative="leftmost"))
    del event.data["origin"]["whereabouts"]
    restored = recording.restore(event, tmp_path, WHERE)
    assert any(isinstance(part, Settle) for _, part in walk(restored.task))


def test_what_means_the_same_everywhere_keeps_nothing():
    assert meant(seen(FACING), color="red").whereabouts is None
    assert "whereabouts" not in submitted(meant(seen(FACING), color="red")).data["origin"]


def test_nonsense_in_the_journal_is_a_sentence(tmp_path):
    event = submitted(meant(seen(FACING), superlative="leftmost"))
    event.data["origin"]["whereabouts"] = {"things": 3}
    with pytest.raises(ConfigError, match="cannot be read"):
        recording.restore(event, tmp_path, WHERE)
