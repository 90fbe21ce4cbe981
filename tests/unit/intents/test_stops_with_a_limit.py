"""A stop that hangs on something is no step after what it limits, and no cry to a robot at rest."""

from itertools import product

import pytest
from hotel_words import heard

from intents.dialogue import Dialogue
from intents.goals import GoTo, Stop, each
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.state import RobotState
from intents.stopping import is_stop
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="kettle"), Thing(name="mug")],
    places=["stove", "sofa", "porch"],
    people=["Ida"],
)
ACTS = (
    "walk 3 metres forward", "go to the sofa", "follow Ida", "pick up the mug",
)  # fmt: skip
LINKS = ("but", ", and", ",")
ENDS = ("stop", "halt", "freeze", "stop moving", "pause", "quit")
LIMITS = (
    "before the stove", "if Ida comes close", "when I call", "as soon as you hear me",
    "once I am back", "unless Ida nods", "whenever Ida is near", "until I am back",
    "before you get too warm", "half a metre short of the stove",
)  # fmt: skip


@pytest.mark.parametrize("end", ENDS)
def test_what_cannot_be_told_is_asked_and_never_a_step(end: str) -> None:
    for act, link, limit in product(ACTS, LINKS, LIMITS):
        said = f"{act}{'' if link[0] == ',' else ' '}{link} {end} {limit}"
        outcome = parse(said, HOME)
        assert isinstance(outcome, Question), (said, outcome)
        assert not any(isinstance(goal, Stop) for goal in each(outcome.goals)), said


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("walk 3 metres forward but stop after 2 metres", "walk 2 metres forward"),
        ("walk three metres forward, but halt after two", "walk three metres forward, then nod"),
        ("walk 3 metres back and stop after one metre", "walk 1 metre back"),
        ("walk 3 metres forward but stop after 5 metres", "walk 3 metres forward"),
        ("walk 3 metres forward, stopping after 1 metre", "walk 1 metre forward"),
        ("walk 3 metres forward but stop halfway", "walk 1.5 metres forward"),
        ("walk 3 metres forward but stop once you have gone 1 metre", "walk 1 metre forward"),
        ("walk forward and stop after 2 metres", "walk 2 metres forward"),
        ("walk forward and stop at the sofa", "go to the sofa"),
        ("turn around but stop after 90 degrees", "turn left 90 degrees"),
        ("turn left and stop after 30 degrees", "turn left 30 degrees"),
        ("squat for 9 seconds but stop after 4 seconds", "squat for 4 seconds"),
        ("squat for 9 seconds, stop after 4 seconds", "squat for 4 seconds"),
        ("squat and stop after 4 seconds", "squat for 4 seconds"),
        ("wait a minute but stop waiting after 20 seconds", "wait 20 seconds"),
        ("nod six times but stop after 2 times", "nod twice"),
        ("follow Ida but stop at the porch", "follow Ida to the porch"),
        ("go to the sofa and stop for 3 seconds", "go to the sofa, then wait 3 seconds"),
        (
            "nod, then walk 3 metres forward but stop after 1 metre",
            "nod, then walk 1 metre forward",
        ),
    ],
)
def test_what_the_act_can_carry_is_done(said: str, plainly: str) -> None:
    if plainly.endswith("then nod"):
        assert isinstance(parse(said, HOME), Question)  # two what?
        return
    one, other = parse(said, HOME), parse(plainly, HOME)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals)
    assert one.goals == other.goals


@pytest.mark.parametrize(
    "end",
    ["and stop", ", then stop", "and stop there", "and stop when you are done", "and stop moving",
     "and stop once you get there", "and stop in front of it", "and stop at the sofa",
     "and stop as soon as you reach the sofa", "and stop after that"],
)  # fmt: skip
def test_a_stop_at_the_end_of_an_act_is_a_step(end: str) -> None:
    outcome = parse(f"go to the sofa {end}", HOME)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (GoTo(place="sofa"), Stop())


def test_an_errand_on_the_way_is_none() -> None:
    outcome = heard("go to the spa, but stop at the bar first")
    assert isinstance(outcome, Goals)
    assert outcome.goals == (GoTo(place="bar"), GoTo(place="spa"))


@pytest.mark.parametrize(
    "said",
    ["stop after you reached the sofa", "stop when Ida calls", "stop if Ida is near",
     "stop after 2 seconds", "stop nodding after 2 seconds", "stop before the stove"],
)  # fmt: skip
def test_alone_it_is_asked_about_at_rest_and_a_stop_at_work(said: str) -> None:
    assert isinstance(parse(said, HOME), Question)
    assert is_stop(said)
    assert Dialogue(HOME).hear(said, RobotState(doing="go to the sofa")) == Goals(
        goals=(Stop(),), parser="stop"
    )


@pytest.mark.parametrize(
    "said",
    ["walk 3 metres forward, but stop after 1 metre", "go to the sofa, stop if Ida is near",
     "nod, and stop when I say so"],
)  # fmt: skip
def test_a_limit_of_an_order_is_no_cry(said: str) -> None:
    assert not is_stop(said)


@pytest.mark.parametrize(
    "said",
    ["go to the sofa, stop at once", "no, stop before you hit it", "go to the sofa. stop",
     "turn around, stop before the stove!", "careful, stop before the stove",
     "go to the sofa. Stop after 1 metre", "nod, no stop, stop if you can hear me",
     "go to the sofa no stop"],
)  # fmt: skip
def test_cries_with_other_words_around_them_stay_cries(said: str) -> None:
    assert is_stop(said)


def test_no_further_than_is_asked_about() -> None:
    assert isinstance(
        parse("walk 3 metres forward but do not go further than 1 metre", HOME), Question
    )
