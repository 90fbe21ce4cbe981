"""When, or how often, something is to be done is never dropped: no goal waits for an occasion."""

from itertools import product

import pytest

from intents.goals import Say, each
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary

FARM = Vocabulary.of(
    objects=["milk churn", "pitchfork", "lantern", "feed bucket", "Sunday hat"],
    places=["trough", "hay loft", "barn door", "generator"],
    rooms=["dairy", "stable"],
    people=["Gwen", "Osric"],
)
_ORDERS = (
    "switch on the generator", "put the lantern on the trough", "bring the pitchfork to Gwen",
    "close the barn door", "take the milk churn to the dairy",
)  # fmt: skip
_OCCASIONS = (
    "every evening", "daily at six", "tomorrow", "tonight", "at dusk", "first thing tomorrow",
    "on Tuesdays", "each Friday", "twice a week", "at half past five", "at nine o'clock",
    "from now on", "once I am back", "when she gets home", "in the morning", "next week",
    "as soon as he's done", "at the end of the day",
)  # fmt: skip


@pytest.mark.parametrize(("order", "occasion"), [*product(_ORDERS, _OCCASIONS)])
def test_no_order_is_done_at_once_that_has_an_occasion(order: str, occasion: str) -> None:
    for said in (f"{order} {occasion}", f"{occasion}, {order}", f"please {order}, {occasion}"):
        assert not isinstance(parse(said, FARM), Goals), said


@pytest.mark.parametrize("order", _ORDERS)
@pytest.mark.parametrize(
    "told",
    ["we milk at six", "it's for tomorrow", "Osric comes tomorrow", "I am off in the morning",
     "I always sit here on Sundays"],
)  # fmt: skip
def test_what_is_only_told_of_waits_for_nothing(order: str, told: str) -> None:
    outcome = parse(f"{told}, {order}", FARM)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == _goals(order)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("bring me the Sunday hat", "bring me the Sunday hat"),
        ("put the lantern on the trough now", "put the lantern on the trough"),
        ("is the barn door open? if not, open it", "if the barn door is not open, open it"),
        ("check if the barn door is shut and if not shut it",
         "if the barn door is not shut, shut the barn door"),
        ("see whether the generator is on and switch it off if it is",
         "if the generator is on, switch off the generator"),
        ("let Gwen have the lantern", "give Gwen the lantern"),
        ("get Osric to close the barn door", "tell Osric to close the barn door"),
        ("have Gwen bring the churn", "tell Gwen to bring the churn"),
        ("get Gwen to the dairy", "guide Gwen to the dairy"),
    ],
)  # fmt: skip
def test_what_is_meant_by_it(said: str, plainly: str) -> None:
    assert _goals(said) == _goals(plainly)


@pytest.mark.parametrize(
    "said",
    [
        "if there is a feed bucket that does not leak, bring it",
        "if there's a lantern nobody uses, take it to the dairy",
        "if there is a pitchfork we can use, bring it to Gwen",
        "greet somebody who isn't Osric",
        "if there's somebody in the stable who isn't Gwen, say hello",
        "how many buckets that aren't full are there?",
    ],
)
def test_what_tells_which_one_is_no_remark(said: str) -> None:
    assert not isinstance(parse(said, FARM), Goals)


@pytest.mark.parametrize(
    "said",
    [
        "leave the iron on",
        "leave the kettle",
        "let Gwen sleep",
        "let Osric in",
        "I wonder if you could wrap the lantern in paper for the little boy",
    ],
)
def test_what_nobody_can_do_is_not_taken_for_something_else(said: str) -> None:
    outcome = parse(said, FARM)
    assert not isinstance(outcome, Goals), outcome


def _goals(said: str) -> tuple[object, ...]:
    outcome = parse(said, FARM)
    assert isinstance(outcome, Goals), outcome
    assert not any(isinstance(goal, Say) and not goal.what for goal in each(outcome.goals))
    return outcome.goals
