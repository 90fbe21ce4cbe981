"""Goals become steps that make sense here, or are refused before anything moves."""

from __future__ import annotations

import pytest

from benchmarks.intents.endpoint import Reply, serving
from executive.meaning.knowledge import Knowledge
from executive.meaning.request import Refused, Understood, request
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.trees.parts import errands
from intents.language_model import Endpoint, LanguageModel
from intents.outcomes import Question
from tests.fakes.worlds import WHERE, world_map


def steps(text: str) -> list[str]:
    outcome = request(text, WHERE)
    assert not isinstance(outcome, Refused), outcome
    return [errand.name for errand in errands(outcome.task)]


def refusal(text: str) -> Refused:
    outcome = request(text, WHERE)
    assert isinstance(outcome, Refused), outcome
    return outcome


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
        ("take the red cup from the table", ["find the red cup", "pick up the red cup"]),
        ("go to the kitchen and then squat", ["go to the kitchen", "squat for 3 s"]),
        (
            "bring the bottle to the upper shelf",
            ["pick up the green bottle", "put the green bottle on the upper shelf"],
        ),
        ("wait 3 seconds", ["wait 3 s"]),
        ("say hello to ann", ["look at Ann", "say hello"]),
        ("what are you holding", ["report holding"]),
    ],
)
def test_sentences_become_steps(text, expected):
    assert steps(text) == expected


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
        ("put the red cup beside the table", "refusal", "next to"),
        ("put the red cup near the table", "refusal", "next to"),
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


TIDY = """{"outcome": "goals", "goals": [
    {"goal": "place", "object": {"name": "cup", "color": "red"}, "on": "table"}]}"""


def asked_a_model(answer: str | None) -> tuple[Understood | Refused, list[str]]:
    """What comes of words that only the model knows, and what a person was asked."""
    questions: list[str] = []

    def ask(question: Question) -> str | None:
        questions.append(question.question)
        return answer

    with serving(Reply(content=TIDY)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        return request("tidy up a bit", WHERE, ask=ask, fallback=model), questions


def test_what_a_model_makes_of_words_is_done_once_a_person_agrees():
    outcome, questions = asked_a_model("yes")
    assert isinstance(outcome, Understood)
    assert [errand.name for errand in errands(outcome.task)][-1] == "put the red cup on the table"
    assert len(questions) == 1
    assert "put the red cup on the table" in questions[0]


@pytest.mark.parametrize("answer", ["no", "well, hm", "", None])
def test_without_that_nothing_is_done(answer: str | None):
    outcome, _ = asked_a_model(answer)
    assert isinstance(outcome, Refused)


def test_nor_where_nobody_can_be_asked():
    with serving(Reply(content=TIDY)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        outcome = request("tidy up a bit", WHERE, fallback=model)
    assert isinstance(outcome, Refused)
    assert outcome.outcome == "question"
