"""Goals become steps that make sense here, or are refused before anything moves."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from executive.blackboard import HELD, WORLD, Blackboard
from executive.meaning.handlers.steps import to_look_over
from executive.meaning.identify import Scene
from executive.meaning.knowledge import Knowledge
from executive.meaning.request import Refused, Understood, meant, request
from executive.skills.inspect import InspectParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.trees.parts import Branch, Settle, errands, walk
from intents import goals
from intents.grounding import Entity
from intents.state import RobotState
from robot.failures import Failure
from robot.messages import Track, WorldState
from robot.se3 import SE3
from tests.fakes.sentences import refusal, steps, with_things_on_the_table
from tests.fakes.worlds import WHERE, MappedWorld, world_map


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "pick up the red cup and put it on the table",
            ["pick up the red cup", "put the red cup on the table"],
        ),
        (
            "put the red cup on the table",
            ["pick up the red cup", "put the red cup on the table"],
        ),
        ("pick up the cup that is not red", ["pick up the blue cup"]),
        ("look at a cup that isn't on the table", ["look around", "look at the red cup"]),
        ("take the red cup from the table", ["find the red cup", "pick up the red cup"]),
        ("go to the kitchen and then squat", ["go to the kitchen", "squat for 3 s"]),
        (
            "bring the bottle to the upper shelf",
            ["pick up the green bottle", "put the green bottle on the upper shelf"],
        ),
        ("wait 3 seconds", ["wait 3 s"]),
        ("look left", ["look left"]),
        ("look to your right, then up", ["look right", "look up"]),
        ("look down and then straight ahead", ["look down", "look ahead"]),
        ("look behind you", ["turn around", "look ahead"]),
        ("say hello to ann", ["go to Ann", "look at Ann", "say hello"]),
        (
            "tell ann that dinner is ready",
            ["go to Ann", "look at Ann", "say 'dinner is ready'"],
        ),
        ("ask ann if she is well", ["go to Ann", "look at Ann", "ask Ann"]),
        (
            "ask ann if she is well and tell me what she says",
            ["go to Ann", "look at Ann", "ask Ann", "go to operator", "say the answer"],
        ),
        ("say that dinner is ready", ["say 'dinner is ready'"]),
        ("what are you holding", ["report holding"]),
    ],
)
def test_sentences_become_steps(text, expected):
    assert steps(text) == expected


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("walk into the table", "I can walk to the table, not into it"),
        ("walk onto the table", "I can walk to the table, not onto it"),
        ("step on top of the upper shelf", "I can walk to the upper shelf, not onto it"),
        ("stand on the table", "I can walk to the table, not onto it"),
        ("enter the table", "I can walk to the table, not into it"),
        ("walk over the table", "I can walk to the table, not over it"),
        ("go through the table", "I can walk to the table, not through it"),
        ("walk onto the bottle", "I can walk to the bottle, not onto it"),
    ],
)
def test_nobody_walks_into_furniture_or_onto_things(text, words):
    assert words in refusal(text).reason


@pytest.mark.parametrize(
    ("text", "place"),
    [("walk into the kitchen", "kitchen"), ("go through the kitchen", "kitchen"),
     ("enter the kitchen", "kitchen"), ("walk over to the table", "table"),
     ("go on to the table", "table"), ("stand at the table", "table")],
)  # fmt: skip
def test_rooms_are_walked_into_and_furniture_up_to(text, place):
    assert steps(text) == [f"go to the {place}"]


@pytest.mark.parametrize(
    ("text", "look"),
    [
        ("if the red cup is on the table, wave", "look over the table"),
        ("if there is no red cup on the table, wave", "look over the table"),
        ("if there is a red cup, wave", "look around"),
        ("if you are holding the red cup, wave", None),
    ],
)
def test_where_a_condition_is_about_is_looked_at_before(text, look):
    assert steps(text) == [*([look] if look else []), "wave"]


def test_all_boards_of_a_shelf_and_all_surfaces_of_a_room_are_looked_over():
    known = world_map()
    lower, upper = (place for place in known.places if place.of == "shelf")
    shelf = replace(upper, id="shelf", name="shelf")
    inside = replace(lower, id="stool", of="stool", X_WP=SE3((0.0, 1.0, 0.5)), room="kitchen")
    places = (*known.places, shelf, inside)
    scene = Scene(Knowledge(replace(known, places=places)))
    looked = [to_look_over(scene.places(name), scene) for name in ("shelf", "kitchen", "table")]
    assert [[place.id for place in one] for one in looked] == [
        ["shelf_lower", "shelf_upper"],
        ["stool"],
        ["table"],
    ]


def test_what_is_there_is_taken_whichever_it_turns_out_to_be():
    text = "if there is a cup on the table, bring it to the upper shelf, otherwise wave"
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood)
    branch, _ = outcome.task.parts
    taken = [errand.params.object_id for errand in errands(branch.then)]
    assert set(taken) == {"cup_red"}
    assert branch.look is not None
    other = branch.otherwise
    assert isinstance(other, Branch)
    assert {errand.params.object_id for errand in errands(other.then)} == {"cup_blue"}
    assert other.look is None
    assert [errand.name for errand in errands(other.otherwise)] == ["wave"]


def test_counting_looks_over_all_of_the_place_first():
    outcome = request("how many cups are on the lower shelf?", WHERE)
    assert isinstance(outcome, Understood)
    look, say = errands(outcome.task)
    assert isinstance(look.params, InspectParams)
    assert look.params.object_ids == ()
    assert say.name == "say how many"


def test_who_is_to_be_told_how_many_is_gone_to_first():
    assert steps("count the cups on the table and let Ann know") == [
        "look over the table",
        "go to Ann",
        "look at Ann",
        "say how many",
    ]
    assert steps("tell me how many cups are on the table") == [
        "look over the table",
        "say how many",
    ]


def test_where_a_thing_is_is_told_to_who_is_to_know():
    assert steps("tell Ann where the bottle is") == [
        "find the green bottle",
        "go to Ann",
        "look at Ann",
        "say where the green bottle is",
    ]
    outcome = request("tell Ann where the bottle is", WHERE)
    assert isinstance(outcome, Understood)
    *_, say = errands(outcome.task)
    assert callable(say.params)
    told = [
        say.params(board).text
        for board in (
            board_with(bottle=(1.8, 0.2, 0.75)),
            board_with(bottle=(1.8, 0.2, 0.75), held={"left": "bottle"}),
            board_with(),
        )
    ]
    assert told == [
        "The green bottle is on the table in the kitchen.",
        "The green bottle is in my hand.",
        "I do not know where the green bottle is.",
    ]


def test_several_things_are_fetched_one_after_the_other():
    assert steps("bring all cups to the table") == [
        "find the red cup",
        "pick up the red cup",
        "put the red cup on the table",
        "find the blue cup",
        "pick up the blue cup",
        "put the blue cup on the table",
    ]


@pytest.mark.parametrize(
    ("text", "outcome", "words"),
    [
        ("", "refusal", ""),
        ("   ", "refusal", ""),
        ("xyzzy plugh", "refusal", "understand"),
        ("pick up the unicorn", "refusal", "unicorn"),
        ("put the red cup on the moon", "refusal", "moon"),
        ("pick up the cup", "question", "red"),
        ("pick up the crate", "no_grasp", "cm"),
        ("pick up the anvil", "invalid_goal", "kg"),
        ("put the red cup on the loft", "out_of_reach", "high"),
        ("put the red cup in the table", "invalid_goal", "no inside"),
        ("put the red cup down into the table", "invalid_goal", "no inside"),
        ("bring the red cup into the table", "invalid_goal", "no inside"),
        ("put the red cup above the table", "refusal", "above"),
        ("put the red cup over the shelf", "refusal", "above"),
        ("put the red cup beside the table", "no_free_spot", "next to"),
        ("put the red cup near the table", "no_free_spot", "next to"),
        ("put the red cup under the table", "refusal", "under"),
        ("put the red cup behind the table", "refusal", "behind"),
        ("put the red cup in front of the table", "refusal", "in front of"),
        ("put the red cup to the left of the table", "refusal", "to the left of"),
        ("put the red cup between the table and the loft", "refusal", "between"),
        ("walk behind the table", "refusal", "behind"),
        ("walk under the table", "refusal", "under"),
        ("open the door", "unsupported", "open"),
        ("clap", "unsupported", "clap"),
        ("stand on one leg for 500 seconds", "invalid_goal", "leg"),
        ("pick up the red cup, the blue cup and the bottle", "hands_full", "hands"),
    ],
)
def test_what_cannot_be_done_is_refused_with_its_reason(text, outcome, words):
    refused = refusal(text)
    assert refused.outcome == outcome, refused
    assert words in refused.reason
    assert refused.suggestion


@pytest.mark.parametrize("text", ["put it in the lower shelf", "put it in the upper shelf"])
def test_between_the_boards_of_a_shelf_is_in_it(text):
    outcome = request(f"pick up the red cup and {text}", WHERE)
    assert not isinstance(outcome, Refused), outcome
    *_, put = (errand.params for errand in errands(outcome.task))
    assert isinstance(put, PlaceParams)
    assert put.place_id.startswith("shelf")


def test_the_boards_of_a_shelf_will_all_do_and_one_that_was_named_alone():
    known = world_map()
    _, upper = (place for place in known.places if place.of == "shelf")
    shelf = replace(upper, id="shelf", name="bookcase")
    world = MappedWorld("test")
    world.map = replace(known, places=(*known.places, shelf))
    where = replace(WHERE, world=world)
    for text, places in (
        ("put the red cup on the bookcase", {"shelf", "shelf_lower"}),
        ("put the red cup on the lower shelf", {"shelf_lower"}),
        ("put the red cup on the table", {"table"}),
    ):
        outcome = request(text, where)
        assert not isinstance(outcome, Refused), outcome
        *_, put = (errand.params for errand in errands(outcome.task))
        assert isinstance(put, PlaceParams)
        assert {put.place_id, *put.or_place_ids} == places


def test_what_is_taken_to_be_put_somewhere_is_taken_for_that_place():
    outcome = request("put the red cup on the table", WHERE)
    assert not isinstance(outcome, Refused), outcome
    take, put = (errand.params for errand in errands(outcome.task))
    assert take.for_place_id == put.place_id
    outcome = request("pick up the red cup", WHERE)
    assert [errand.params.for_place_id for errand in errands(outcome.task)] == [None]


def test_a_question_is_put_to_a_person_and_its_answer_used():
    asked = []

    def ask(question):
        asked.append(question.question)
        return "the blue one"

    outcome = request("put the cup on the table", WHERE, ask=ask)
    assert not isinstance(outcome, Refused)
    params = [errand.params for errand in errands(outcome.task)]
    assert [type(p) for p in params] == [PickParams, PlaceParams]
    assert {p.object_id for p in params} == {"cup_blue"}
    assert len(asked) == 1
    assert "red" in asked[0]


def test_an_answer_that_is_none_leaves_the_question():
    refused = request("put the cup on the table", WHERE, ask=lambda _: None)
    assert isinstance(refused, Refused)
    assert refused.outcome == "question"


def test_knowledge_has_the_colour_out_of_the_name_and_finds_places_by_synonym():
    knowledge = Knowledge(world_map())
    things = {(thing.color, thing.name) for thing in knowledge.vocabulary().objects}
    assert ("blue", "cup") in things
    assert [place.id for place in knowledge.places("Desk")] == ["table"]
    assert knowledge.places("moon") == ()
    assert knowledge.person(None).id == "operator"


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("give the red cup to ann", ["pick up the red cup", "give the red cup to ann"]),
        ("follow ann to the table", ["follow ann"]),
        ("follow ann", ["follow ann"]),
        ("wave at ann, then nod", ["wave at ann", "nod"]),
        ("point at the red cup", ["point at red cup"]),
        ("point at the table", ["point at table"]),
        ("look around", ["look around"]),
    ],
)
def test_what_is_about_people_is_understood(text, names):
    outcome = request(text, WHERE)
    assert not isinstance(outcome, Refused), outcome
    assert [errand.name.lower() for errand in errands(outcome.task)] == names


def test_a_hand_that_was_named_is_the_one_that_waves():
    outcome = request("wave with your left hand", WHERE)
    assert isinstance(outcome, Understood)
    (wave,) = errands(outcome.task)
    assert wave.params.side == "left"


def test_a_count_without_a_place_looks_over_every_surface_of_the_room():
    outcome = request("how many cups are there?", WHERE)
    assert isinstance(outcome, Understood)
    look, say = errands(outcome.task)
    assert set(look.params.place_ids) >= {"table", "shelf_lower", "shelf_upper"}
    assert callable(say.params)
    told = say.params(with_things_on_the_table({"cup_red": 0.1})).text
    assert told.startswith("I see 1 cup. I have not looked at the table, ")


def test_what_is_counted_in_a_room_is_in_it():
    outcome = request("how many cups are in the kitchen?", WHERE)
    assert isinstance(outcome, Understood)
    *_, say = errands(outcome.task)
    assert callable(say.params)
    assert say.params(with_things_on_the_table({})).text == "I see 0 cups in the kitchen."


def board_with(
    *, held: dict[str, str] | None = None, **things: tuple[float, float, float]
) -> Blackboard:
    tracks = tuple(Track(id=name, X_WO=SE3(p_WO), seen_s=0.0) for name, p_WO in things.items())
    board = Blackboard()
    writer = board.claim(WORLD.writer)
    world = WorldState(stamp_s=0.0, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=tracks)
    writer.set(WORLD, world)
    writer.set(HELD, held or {})
    return board


@pytest.mark.parametrize(
    "text",
    ["bring me the bottle from the table", "pick up a bottle on the table",
     "put the bottle that is on the table on the lower shelf"],
)  # fmt: skip
def test_a_thing_is_taken_from_where_it_was_said_to_be_and_from_nowhere_else(text: str):
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood)
    (there,) = [part for _, part in walk(outcome.task) if isinstance(part, Settle)]
    assert there.looks == ()
    assert there.question(board_with(bottle=(2.0, 0.0, 0.75))) == ("bottle",)
    held = board_with(held={"left": "bottle"})
    assert there.question(held) == ("bottle",)
    away = there.question(board_with(bottle=(-2.0, 0.0, 0.9)))
    assert isinstance(away, Failure)
    assert away.cause.endswith("on the table; the green bottle is on the upper shelf")
    assert away.suggestion == "say it without “on the table”"


def test_of_several_that_are_not_where_it_was_said_each_is_told_where_it_is():
    outcome = request("put a cup that is on the table on the lower shelf", WHERE)
    assert isinstance(outcome, Understood)
    (there,) = [part for _, part in walk(outcome.task) if isinstance(part, Settle)]
    away = there.question(board_with(cup_red=(-2.0, 0.1, 0.9), cup_blue=(-2.0, 0.2, 0.4)))
    assert isinstance(away, Failure)
    told = "the red cup is on the upper shelf and the blue cup is on the lower shelf"
    assert away.cause.endswith(f"on the table; {told}")
    assert away.suggestion == "say which one, and where it is"
    unseen = there.question(board_with())
    assert isinstance(unseen, Failure)
    assert unseen.cause.endswith("on the table")


def test_the_place_that_was_said_is_looked_at_before_it_is_denied():
    bottle = Entity(id="bottle", name="bottle", at="upper shelf", p_WO=(-2.0, 0.0, 0.9))
    entities = [one for one in WHERE.knowledge.entities() if one.id != "bottle"]
    state = RobotState(entities=(*entities, bottle))
    goal = goals.Pick(object=goals.ObjectQuery(name="bottle", at="table"))
    outcome = meant("take it from there", (goal,), WHERE, state=state)
    assert isinstance(outcome, Understood)
    (there,) = [part for _, part in walk(outcome.task) if isinstance(part, Settle)]
    assert [look.name for look in there.looks] == ["look over the table"]


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("what is on the table?", "look over the table"),
        ("what's on the lower shelf", "look over the lower shelf"),
    ],
)
def test_what_is_at_a_place_is_looked_for_there(said: str, expected: str):
    assert steps(said) == [expected, "say what is there"]


def test_what_was_seen_there_is_told_by_name_and_nothing_else():
    outcome = request("what is on the table?", WHERE)
    assert isinstance(outcome, Understood)
    *_, say = errands(outcome.task)
    assert callable(say.params)
    told = say.params(with_things_on_the_table({"cup_red": 0.1, "cup_blue": -0.1})).text
    assert told == "I see the red cup and the blue cup on the table."
    assert say.params(with_things_on_the_table({})).text == "I see nothing on the table."


def test_what_else_a_thing_is_like_is_refused_still():
    assert refusal("how heavy is the bottle?").outcome == "unsupported"
