"""Conditions of several parts: all of them are read, or the robot asks; none is dropped."""

import pytest

from intents.goals import from_json, to_json
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.wording import in_words
from tests.unit.intents.workshop_words import WORKSHOP


def read(said: str) -> str:
    """What a sentence is read as, in words."""
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert from_json(to_json(outcome.goals)) == outcome.goals
    return in_words(outcome.goals)


RED_AND_THERMOS = (
    "if the red mug at the workbench is there and the thermos at the sofa is there, wave"
)
EITHER_PLACE = "if the thermos at the sofa is there or the thermos at the workbench is there, nod"
NEITHER_PLACE = (
    "if the thermos at the sofa is not there and the thermos at the workbench is not there, wave"
)
NEITHER_THING = (
    "if the thermos at the sofa is not there and the orange at the sofa is not there, wave"
)

READ = [
    # clauses
    ("if the red mug is on the workbench and the thermos is on the sofa, wave", RED_AND_THERMOS),
    ("if the red mug is on the workbench, and the thermos is on the sofa, wave", RED_AND_THERMOS),
    ("if the red mug is on the workbench and if the thermos is on the sofa, wave", RED_AND_THERMOS),
    ("wave if the red mug is on the workbench and the thermos is on the sofa", RED_AND_THERMOS),
    ("wave only if the red mug is on the workbench and the thermos is on the sofa",
     RED_AND_THERMOS),
    ("if the thermos is on the sofa, the toolbox is on the workbench and Ada is in the office, nod",
     "if the thermos at the sofa is there and the toolbox at the workbench is there and Ada at the "
     "office is there, nod"),
    ("if Noor is there and she is sitting, wave",
     "if Noor is there and Noor sitting is there, wave"),
    ("if you hold nothing and the thermos is on the sofa, nod",
     "if I do not hold the thing and the thermos at the sofa is there, nod"),
    ("if the front door is open and Ada is in the office, wave",
     "if the front door is open and Ada at the office is there, wave"),
    # what the second clause leaves out
    ("if the red mug is on the sofa but the blue one is not, bow",
     "if the red mug at the sofa is there and the blue mug at the sofa is not there, bow"),
    ("if the red mug is not on the sofa but the blue one is, bow",
     "if the red mug at the sofa is not there and the blue mug at the sofa is there, bow"),
    ("if the red mug is on the sofa and so is the thermos, bow",
     "if the red mug at the sofa is there and the thermos at the sofa is there, bow"),
    ("if the red mug is on the sofa and the thermos is too, bow",
     "if the red mug at the sofa is there and the thermos at the sofa is there, bow"),
    ("if the red mug is on the sofa and the thermos on the workbench, bow, otherwise nod",
     "if the red mug at the sofa is there and the thermos at the workbench is there, bow, "
     "otherwise nod"),
    # places
    ("if the thermos is on the sofa or the workbench, nod", EITHER_PLACE),
    ("if the thermos is on the sofa or on the workbench, nod", EITHER_PLACE),
    ("nod if the thermos is either on the sofa or on the workbench", EITHER_PLACE),
    ("wave if the thermos is neither on the sofa nor on the workbench", NEITHER_PLACE),
    ("wave if the thermos is not on the sofa or the workbench", NEITHER_PLACE),
    ("if the front door is open or closed, wave",
     "if the front door is open or the front door is closed, wave"),
    ("go to the office unless Ada is in the garage or in the living room",
     "if Ada at the garage is there or Ada at the living room is there, do nothing, otherwise go "
     "to the office"),
    # things
    ("if both the thermos and the toolbox are on the sofa, wave",
     "if the thermos at the sofa is there and the toolbox at the sofa is there, wave"),
    ("if the thermos, the toolbox or the orange is on the sofa, wave",
     "if the thermos at the sofa is there or the toolbox at the sofa is there or the orange at the "
     "sofa is there, wave"),
    ("if neither the thermos nor the orange is on the sofa, wave", NEITHER_THING),
    ("wave if there is no thermos or orange on the sofa", NEITHER_THING),
    ("wave if there is no thermos and no orange on the sofa", NEITHER_THING),
    ("wave if there is an orange or a thermos on the sofa",
     "if an orange at the sofa is there or a thermos at the sofa is there, wave"),
    ("wave if there is a thermos on the sofa or on the workbench",
     "if a thermos at the sofa is there or a thermos at the workbench is there, wave"),
    ("wave if you see the thermos or the orange",
     "if the thermos is there or the orange is there, wave"),
    ("if you hold the red mug or the thermos, nod",
     "if I do hold the red mug or I do hold the thermos, nod"),
    ("go to the office unless Ada or Emil is in the garage",
     "if Ada at the garage is there or Emil at the garage is there, do nothing, otherwise go to "
     "the office"),
    # what is done then
    ("if you hold the red mug and the thermos is on the workbench, put it on the sofa",
     "if I do hold the red mug and the thermos at the workbench is there, put the red mug on the "
     "sofa"),
    ("when you see the thermos and the orange, wave",
     "look for the thermos, then look for the orange, then wave"),
    ("say lunch is ready if the thermos is on the sofa and Ada is in the office",
     "if the thermos at the sofa is there and Ada at the office is there, say “lunch is ready”"),
    ("check whether the thermos is on the sofa and the orange is on the workbench",
     "look for the thermos at the sofa, then look for the orange at the workbench"),
    # one or the other
    ("bring me the orange, or the thermos if it is not there",
     "if the orange is there, bring the orange to you, otherwise bring the thermos to you"),
    ("bring me the orange, or bring me the thermos if you cannot find it",
     "if the orange is there, bring the orange to you, otherwise bring the thermos to you"),
    ("nod, then bring me the orange, or the thermos if there is none",
     "nod, then if the orange is there, bring the orange to you, otherwise bring the thermos to "
     "you"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "meant"), READ, ids=[said for said, _ in READ])
def test_all_parts_of_a_condition_are_read(said: str, meant: str):
    assert read(said) == meant


@pytest.mark.parametrize(
    ("said", "about"),
    [
        ("if the thermos is on the sofa and the orange is on the workbench or Ada is in the "
         "office, wave", "which belong together"),
        ("wave if the thermos is on the sofa and nod", "“nod” in any case, or only then?"),
        ("wave if the thermos is on the sofa, then nod", "“nod” in any case, or only then?"),
        ("wave if the thermos is on the sofa and it is raining", "“it is raining”"),
        ("wave if the thermos is warm", "“warm”"),
        ("if the red mug and the thermos are on the sofa, bring it to me", "What is “it”"),
        ("if the thermos is on the sofa and there is an orange on the workbench, bring it to me",
         "What is “it”"),
        ("if there is no mug and thermos on the sofa, wave", "None of them, or not all"),
        ("if there is a mug on the sofa and a thermos, wave", "Where is a thermos to be?"),
        ("when you see the thermos or the orange, wave", "The one or the other"),
        ("check whether the thermos is on the sofa or the orange is on the workbench",
         "Whether the one or the other?"),
        ("wave if the thermos is not on the sofa and on the workbench", "denied of all"),
    ],
)  # fmt: skip
def test_what_is_not_clear_is_asked(said: str, about: str):
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Question), outcome
    assert about in outcome.question


@pytest.mark.parametrize(
    "said",
    [
        "if the thermos is on the sofa and it is raining, wave",
        "if the thermos is on the sofa, Ada is happy, wave",
        "if the thermos is on the sofa, the orange is on the workbench, wave",
        "unless the thermos is on the sofa or the cat is asleep, wave",
    ],
)
def test_what_cannot_be_checked_is_refused(said: str):
    assert isinstance(parse(said, WORKSHOP), Refusal)
