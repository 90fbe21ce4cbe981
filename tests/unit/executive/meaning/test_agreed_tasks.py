"""What a language model makes of words is done once a person agrees."""

from __future__ import annotations

import pytest

from benchmarks.intents.endpoint import Reply, serving
from executive.meaning.request import Refused, Understood, request, unable
from executive.trees.parts import errands
from intents import goals
from intents.language_model import Endpoint, LanguageModel
from intents.outcomes import Question
from tests.fakes.worlds import WHERE

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


STEPS = """{"outcome": "goals", "goals": [
    {"goal": "place", "object": {"name": "cup", "color": "red"}, "on": "table"},
    {"goal": "gesture", "kind": "wave"},
    {"goal": "place", "object": {"name": "bottle"}, "on": "table"}]}"""


def test_a_plan_is_changed_before_it_is_agreed_to():
    asked: list[str] = []
    answers = iter(["skip two", "first the bottle", "yes"])

    def ask(question: Question) -> str | None:
        asked.append(question.question)
        return next(answers)

    with serving(Reply(content=STEPS)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        outcome = request("tidy up a bit", WHERE, ask=ask, fallback=model)
    assert isinstance(outcome, Understood)
    assert [goal.object.name for goal in outcome.goals] == ["bottle", "cup"]
    assert "  2. wave\n" in asked[0]
    assert "wave" not in asked[1]
    assert len(server.requests) == 1


def test_what_is_no_answer_to_a_plan_is_read_like_any_words_and_may_lead_to_another_plan():
    answers = iter(["something livelier, if you could", "yes"])
    lively = """{"outcome": "goals", "goals": [{"goal": "gesture", "kind": "wave"}]}"""
    with serving(Reply(content=STEPS), Reply(content=lively)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        outcome = request("tidy up a bit", WHERE, ask=lambda _: next(answers), fallback=model)
    assert isinstance(outcome, Understood)
    assert [errand.name for errand in errands(outcome.task)] == ["wave"]
    assert "open_question" in server.requests[1]["messages"][1]["content"]


def test_what_no_skill_does_is_known_before_a_person_is_asked():
    drawer = goals.Open(what="drawer")
    assert "cannot" in unable((drawer,), WHERE)
    cup = goals.ObjectQuery(name="cup")
    assert unable((goals.Pick(object=cup),), WHERE) == ""  # it depends on which is meant
