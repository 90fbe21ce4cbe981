"""What is announced, what comes first, what is repaired, and what stands there without a verb."""

import pytest

from intents.goals import If
from intents.outcomes import Goals
from intents.parser import parse
from intents.stopping import is_stop
from intents.vocabulary import Thing, Vocabulary

STABLE = Vocabulary.of(
    objects=[
        Thing(name="saddle", category="tack"),
        Thing(name="bridle", category="tack"),
        Thing(name="oats", category="feed"),
        Thing(name="carrot", category="feed"),
        "brush",
        "bucket",
        "blanket",
    ],
    places=["manger", "rack", "hook", "stall", "gate", "chest"],
    rooms=["tack room", "yard", "loft"],
    people=["Ilse", "Bram", "Wout"],
    categories={"feed": "feed", "tack": "tack"},
)


def goals_of(said: str) -> object:
    outcome = parse(said, STABLE)
    assert isinstance(outcome, Goals), outcome
    return outcome.goals


SAME = [
    # announcements
    ("Three things I need from you. Close the gate. Bring me the brush. Wave.",
     "close the gate, bring me the brush, wave"),
    ("Right, a couple of jobs for you: close the gate, then wave", "close the gate, then wave"),
    ("here's the plan: go to the yard and wave", "go to the yard and wave"),
    ("you do one thing, go to the yard", "go to the yard"),
    ("just the one small favour today: close the gate", "close the gate"),
    ("to begin with, close the gate", "close the gate"),
    # what comes first
    ("go to the yard, but only after you have closed the gate", "close the gate, go to the yard"),
    ("go to the yard once you've closed the gate", "close the gate, go to the yard"),
    ("bring Bram the brush as soon as you have hung the bridle on the hook",
     "hang the bridle on the hook, bring Bram the brush"),
    ("bring me the brush, but before that close the gate", "close the gate, bring me the brush"),
    ("bring me the brush, but first close the gate", "close the gate, bring me the brush"),
    ("bring me the brush, but close the gate first", "close the gate, bring me the brush"),
    ("bring me the brush, having first closed the gate", "close the gate, bring me the brush"),
    ("do not go to the yard until you have closed the gate", "close the gate, go to the yard"),
    ("go to the yard, but not before you have closed the gate", "close the gate, go to the yard"),
    ("close the gate and, when that's done, and only when that's done, wave",
     "close the gate, wave"),
    ("close the gate. Only then go to the yard", "close the gate, go to the yard"),
    ("before anything else, close the gate; then wave", "close the gate, wave"),
    ("bring me the brush when you're finished pottering about", "bring me the brush"),
    # repairs
    ("get the saddle, the - no, forget the saddle, bring me the bridle instead",
     "bring me the bridle"),
    ("take the brush to Bram. Pardon, not Bram, Wout needs it", "take the brush to Wout"),
    ("take the brush to Bram. Sorry sorry, not Bram, Wout was the one who asked for it",
     "take the brush to Wout"),
    ("take the brush to Bram, not Bram but Wout", "take the brush to Wout"),
    ("bring me the carrot, ah nah scrap that, make it the oats", "bring me the oats"),
    ("go to the yard, I wanted to say the loft", "go to the loft"),
    ("guide Bram to the yard, no wait, he has been there already, I mean the loft",
     "guide Bram to the loft"),
    ("bring Bram the oats. No hang on. It's Wout who wants them. Bring them to Wout.",
     "bring Wout the oats"),
    ("fetch the saddle, no, what do I need a saddle for, fetch the bridle", "fetch the bridle"),
    ("bring me the carrot. My back hurts. No, I mean the oats", "bring me the oats"),
    ("bring me the oats, and I mean it, bring me the oats", "bring me the oats"),
    # without a verb
    ("both buckets off the rack, into the chest", "take both buckets from the rack into the chest"),
    ("saddle and bridle from the stall to the rack",
     "put the saddle and the bridle from the stall on the rack"),
    ("the brush in the stall, rack, please", "put the brush from the stall on the rack"),
    ("two buckets and a brush on the rack, please", "put two buckets and a brush on the rack"),
    ("oats to Ilse, carrot to Bram, bucket to the yard",
     "bring the oats to Ilse, bring the carrot to Bram, bring the bucket to the yard"),
    ("one carrot for Wout, please", "bring Wout one carrot"),
    # background
    ("you'll find the brush behind the bucket; do bring it to me",
     "bring me the brush behind the bucket"),
    ("there's a bucket hiding behind the chest, bring it here",
     "bring me a bucket behind the chest"),
    ("I need the brush, I left it in the loft, can you get it for me",
     "bring me the brush from the loft"),
    ("take Bram's blanket back to him, he left it in the yard",
     "take the blanket in the yard to Bram"),
    # what is not to be done, and what need not be
    ("you needn't come back, simply leave the brush on the rack", "put the brush on the rack"),
    ("no need to bring me the brush, just hang it on the hook", "hang the brush on the hook"),
    ("do not touch the saddle; only tell me whether it is on the rack",
     "tell me whether the saddle is on the rack"),
    ("bring me all the feed, but the oats no", "bring me all the feed but not the oats"),
    ("bring Ilse the oats, then the carrot", "bring Ilse the oats, bring Ilse the carrot"),
    ("bring the buckets here, both of them", "bring both buckets here"),
    ("see how many buckets are in the yard, come back and tell me the number",
     "see how many buckets are in the yard, come back"),
    # conditions and what is left
    ("if there are oats in the chest, bring me some, and if there aren't, well, the carrot will do",
     "if there are oats in the chest, bring me the oats in the chest, "
     "otherwise bring me the carrot"),
    ("bring Bram the oats from the chest; if there are none, bring him the carrot",
     "if there are oats in the chest, bring the oats in the chest to Bram, "
     "otherwise bring Bram the carrot"),
    ("if Wout is in the yard, give him the brush, otherwise never mind",
     "if Wout is in the yard, give him the brush"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), SAME, ids=[said for said, _ in SAME])
def test_they_say_what_is_said_plainly(said: str, plainly: str) -> None:
    assert goals_of(said) == goals_of(plainly)


@pytest.mark.parametrize(
    "said",
    [
        "the brush on the rack, please",  # put it there, or bring it from there?
        "two buckets on the rack",
        "three tack on the rack for later",
        "bring me the oats, before that the unicorn",
    ],
)
def test_what_can_be_meant_otherwise_is_not_done(said: str) -> None:
    assert not isinstance(parse(said, STABLE), Goals)


def test_if_there_is_none_is_said_of_the_thing_and_not_of_who_gets_it() -> None:
    (goal,) = goals_of("bring Ilse the oats; if there isn't any, bring her the carrot")  # pyright: ignore[reportGeneralTypeIssues, reportUnknownVariableType]
    assert isinstance(goal, If)
    assert "oats" in str(goal.condition)


@pytest.mark.parametrize(
    "said",
    [
        "aaah stop stop stop you're going to crush my foot",
        "omg no no stop it the lamp is falling over",
        "haha okay okay oh no STOP STOP that is my hat",
        "bring me the oats you daft thing stop stop they are all over my trousers now",
        "arghh halt that was my toe you just stepped on there",
    ],
)
def test_a_cry_in_the_midst_of_chatter_is_one(said: str) -> None:
    assert is_stop(said)


@pytest.mark.parametrize(
    "said",
    [
        "do not move the saddle, just count the buckets",
        "don't move my brush",
        "Wout, stop teasing your brother",
        "is there a bus stop near the yard",
    ],
)
def test_what_is_to_stay_or_said_to_a_child_is_no_cry(said: str) -> None:
    assert not is_stop(said)


@pytest.mark.parametrize("said", ["do not move", "don't move a muscle", "do not move the arm"])
def test_what_is_meant_for_the_robot_is_one(said: str) -> None:
    assert is_stop(said)
