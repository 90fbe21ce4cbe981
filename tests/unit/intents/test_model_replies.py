"""What language models say, in the shapes that they say it in, and what is made of it."""

import pytest

from benchmarks.intents import replies
from benchmarks.intents.endpoint import Reply, Server, serving
from benchmarks.intents.replies import CASES, HOME, Case, is_right
from intents.allowed import fault
from intents.context import Context
from intents.language_model import Endpoint, LanguageModel
from intents.language_model.answers import answer_in
from intents.language_model.mending import goals_from
from intents.language_model.peeling import values
from intents.language_model.prompt import EXAMPLE_HOME, EXAMPLES


@pytest.fixture(scope="module")
def server():
    with serving(Reply()) as running:
        yield running


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.shape)
def test_a_reply_is_read_as_it_is_meant_or_not_at_all(case: Case, server: Server) -> None:
    server.replies = [Reply(content=case.said)]
    model = LanguageModel(Endpoint(base_url=server.url, model="scripted"))
    outcome = model("get this room into shape", HOME, Context(entities=replies.THERE))
    assert is_right(case, outcome), (outcome, model.trouble)


@pytest.mark.parametrize(
    "said",
    ["{" * 50_000, "[" * 50_000, '{"' * 30_000, "<think>" * 9_000, "['" * 30_000, '["[",' * 12_000,
     "</think>{" * 7_000, "<|" * 30_000, "{'a': " * 10_000,
     '{"a":"' + "\\" * 60_000, ",]" * 30_000],
    ids=range(11),
)  # fmt: skip
def test_no_text_makes_it_look_twice(said: str) -> None:
    assert [one for one in values(said) if one not in ([], {})] == []


def test_a_part_of_a_plan_that_is_cut_off_is_no_plan() -> None:
    whole = '{"goals": [{"goal": "pick", "object": {"name": "plate"}}, {"goal": "wait"}]}'
    assert answer_in(whole) is not None
    assert all(answer_in(whole[:length]) is None for length in range(len(whole)))


@pytest.mark.parametrize(("_said", "answer"), EXAMPLES)
def test_the_examples_that_a_model_is_shown_are_right(_said: str, answer: dict) -> None:
    goals = answer.get("goals")
    if goals is None:
        assert set(answer) == {"outcome", "text"}
    else:
        assert fault(goals_from(goals, EXAMPLE_HOME), EXAMPLE_HOME) == ""
