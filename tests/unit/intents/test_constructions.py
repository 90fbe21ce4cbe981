"""Clauses whose verb is not the act, questions in any wording, conditions and repetition."""

import pytest
from workshop_words import WORKSHOP

from intents.goals import from_json, to_json
from intents.outcomes import Goals
from intents.parser import parse

WAVE = '{"goal":"gesture","kind":"wave"}'
CASES = {
    # light verbs
    "give Noor a big wave": '[{"goal":"gesture","kind":"wave","at":"Noor"}]',
    "do three squats": (
        '[{"goal":"repeat","times":3,"goals":[{"goal":"balance","mode":"squat"}]}]'
    ),
    "make a right turn": '[{"goal":"go_to","by":{"turn_rad":-1.570796}}]',
    "do an about-face": '[{"goal":"go_to","by":{"turn_rad":3.141593}}]',
    "have a quick peek at the locker": '[{"goal":"look_at","place":"locker"}]',
    # results
    "pull the front door open": '[{"goal":"open","what":"front door"}]',
    "push the front door shut": '[{"goal":"close","what":"front door"}]',
    "get the lamp going": '[{"goal":"switch","what":"lamp","on":true}]',
    "the lamp should be off": '[{"goal":"switch","what":"lamp","on":false}]',
    "make sure the lamp is on": '[{"goal":"switch","what":"lamp","on":true}]',
    # a thing into another, and the next one
    "put the screwdriver into the toolbox and the toolbox on the workbench": (
        '[{"goal":"place","object":{"name":"screwdriver"},"in":"toolbox"},'
        '{"goal":"place","object":{"name":"toolbox"},"on":"workbench"}]'
    ),
    "put the orange into the toolbox, and the thermos next to the screwdriver": (
        '[{"goal":"place","object":{"name":"orange"},"in":"toolbox"},'
        '{"goal":"place","object":{"name":"thermos"},'
        '"relation":{"how":"near","of":{"name":"screwdriver"}}}]'
    ),
    # the thing first
    "the thermos belongs on the workbench": (
        '[{"goal":"place","object":{"name":"thermos"},"on":"workbench"}]'
    ),
    "the thermos must be brought to Ada": (
        '[{"goal":"bring","object":{"name":"thermos"},"to":{"name":"Ada"}}]'
    ),
    # people
    "help Emil get from the sofa to the garage": (
        '[{"goal":"guide","person":{"name":"Emil","at":"sofa"},"to":"garage"}]'
    ),
    "show Ada where the locker is": '[{"goal":"guide","person":{"name":"Ada"},"to":"locker"}]',
    "have Emil follow you to the office": (
        '[{"goal":"guide","person":{"name":"Emil"},"to":"office"}]'
    ),
    "I want you in the garage": '[{"goal":"go_to","place":"garage"}]',
    "when you see Noor, nod": (
        '[{"goal":"find","person":{"name":"Noor"}},{"goal":"gesture","kind":"nod"}]'
    ),
    # time
    "in ten seconds, wave": f'[{{"goal":"wait","duration_s":10.0}},{WAVE}]',
    "squat and hold that for four seconds": (
        '[{"goal":"balance","mode":"squat","duration_s":4.0}]'
    ),
    "wave, and do that twice": f'[{{"goal":"repeat","times":2,"goals":[{WAVE}]}}]',
    "say ahoy three times": (
        '[{"goal":"repeat","times":3,"goals":[{"goal":"say","what":"ahoy"}]}]'
    ),
    # relations
    "grab the mug on the thermos's left": (
        '[{"goal":"pick","object":{"name":"mug","relation":{"how":"left","of":{"name":"thermos"}}}}]'
    ),
    "take the orange between the mug and the thermos": (
        '[{"goal":"pick","object":{"name":"orange","relation":{"how":"between",'
        '"of":{"name":"mug"},"other":{"name":"thermos"}}}}]'
    ),
    "which mug is heavier?": (
        '[{"goal":"tell","of":{"name":"mug","superlative":"heaviest"},"property":"name"}]'
    ),
    # conditions
    "if the front door is open, close it": (
        '[{"goal":"if","condition":{"is":"state","what":"front door","state":"open"},'
        '"then":[{"goal":"close","what":"front door"}]}]'
    ),
    "wave if your hands are empty, otherwise nod": (
        '[{"goal":"if","condition":{"is":"holding","object":{},"negated":true},'
        f'"then":[{WAVE}],"else":[{{"goal":"gesture","kind":"nod"}}]}}]'
    ),
    "collect all the tools and load them into the toolbox": (
        '[{"goal":"for_each","object":{"category":"tool"},"goals":[{"goal":"pick",'
        '"object":{"held":true}},{"goal":"place","object":{"held":true},"in":"toolbox"}]}]'
    ),
}  # fmt: skip
REPORTS = {
    "holding": ["what's that in your left hand?", "are your grippers empty?"],
    "seeing": ["tell me what is in front of you", "do you see anything?"],
    "location": ["in which room are you?", "where exactly are you standing"],
    "status": ["how far along are you?", "is the job finished?"],
    "health": ["is your battery low?", "are any of your joints broken?"],
    "why": ["how come you did not move?", "tell me why you dropped it", "what stopped you?"],
    "capabilities": ["what kinds of things do you understand?", "list your skills"],
}


@pytest.mark.parametrize(("said", "wanted"), CASES.items())
def test_what_is_said_in_other_ways_means_the_same(said: str, wanted: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert to_json(outcome.goals) == to_json(from_json(wanted))


@pytest.mark.parametrize(
    ("topic", "said"), [(topic, said) for topic, texts in REPORTS.items() for said in texts]
)
def test_questions_about_the_robot_are_known_by_what_they_are_about(topic: str, said: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert to_json(outcome.goals) == f'[{{"goal":"report","topic":"{topic}"}}]'


@pytest.mark.parametrize(
    "said",
    ["walk 700 metres forward", "nod five thousand times", "wait for 900 hours",
     "stir the soup", "play the drums", "will it rain tomorrow", "what's two times two"],
)  # fmt: skip
def test_what_is_beyond_it_is_not_goals(said: str) -> None:
    assert not isinstance(parse(said, WORKSHOP), Goals)


@pytest.mark.parametrize("call", ["Juno, ", "hey Juno, ", "Good morning! ", "ok, "])
def test_being_called_by_a_name_changes_nothing(call: str) -> None:
    said = "bring Ada the thermos"
    called, plain = parse(call + said, WORKSHOP), parse(said, WORKSHOP)
    assert isinstance(called, Goals)
    assert isinstance(plain, Goals)
    assert called.goals == plain.goals
