"""Sentences and the goals they ask for."""

import pytest
from workshop_words import WORKSHOP

from intents.goals import from_json, to_json
from intents.outcomes import Goals
from intents.parser import parse

ME = '"to":{"who":"operator"}'

HANDLING = {
    "pick up the red mug": '[{"goal":"pick","object":{"name":"mug","color":"red"}}]',
    "grab the screwdriver from the workbench": (
        '[{"goal":"pick","object":{"name":"screwdriver","at":"workbench"}}]'
    ),
    "take the mugs that are on the sofa": '[{"goal":"pick","object":{"name":"mug","at":"sofa"}}]',
    "pick the tape measure up, please": '[{"goal":"pick","object":{"name":"tape measure"}}]',
    "get the heaviest tool on the workbench": (
        '[{"goal":"pick","object":{"category":"tool","superlative":"heaviest","at":"workbench"}}]'
    ),
    "take the thing to the left of the thermos": (
        '[{"goal":"pick","object":{"relation":{"how":"left","of":{"name":"thermos"}}}}]'
    ),
    "put the mug on the workbench": '[{"goal":"place","object":{"name":"mug"},"on":"workbench"}]',
    "put the orange into the toolbox": (
        '[{"goal":"place","object":{"name":"orange"},"in":"toolbox"}]'
    ),
    "place the orange that is on the sofa on the workbench": (
        '[{"goal":"place","object":{"name":"orange","at":"sofa"},"on":"workbench"}]'
    ),
    "put it on the upper rack": '[{"goal":"place","object":{"held":true},"on":"upper rack"}]',
    "put down the thermos": '[{"goal":"place","object":{"name":"thermos"}}]',
    "put it down": '[{"goal":"place","object":{"held":true}}]',
    "take the thermos from the locker to the sofa": (
        '[{"goal":"place","object":{"name":"thermos","at":"locker"},"on":"sofa"}]'
    ),
    "bring me the lemonade": f'[{{"goal":"bring","object":{{"name":"lemonade"}},{ME}}}]',
    "fetch me something to drink": f'[{{"goal":"bring","object":{{"category":"drink"}},{ME}}}]',
    "I'd like a drink from the locker": (
        f'[{{"goal":"bring","object":{{"category":"drink","count":1,"at":"locker"}},{ME}}}]'
    ),
    "deliver the screwdriver to Ada in the garage": (
        '[{"goal":"bring","object":{"name":"screwdriver"},"to":{"name":"Ada","at":"garage"}}]'
    ),
    "bring the woman wearing a blue coat an orange": (
        '[{"goal":"bring","object":{"name":"orange","count":1},"to":{"gender":"female",'
        '"wearing":{"color":"blue","item":"coat"}}}]'
    ),
    "bring the thermos to the office": (
        '[{"goal":"bring","object":{"name":"thermos"},"to":"office"}]'
    ),
    "hand it to Emil": '[{"goal":"give","object":{"held":true},"to":{"name":"Emil"}}]',
    "give Noor the red mug": (
        '[{"goal":"bring","object":{"name":"mug","color":"red"},"to":{"name":"Noor"}}]'
    ),
    "bring me the thermos and the orange": (
        f'[{{"goal":"bring","object":{{"name":"thermos"}},{ME}}},'
        f'{{"goal":"bring","object":{{"name":"orange"}},{ME}}}]'
    ),
    "bring me all the tools": (
        '[{"goal":"for_each","object":{"category":"tool"},"goals":'
        f'[{{"goal":"bring","object":{{"held":true}},{ME}}}]}}]'
    ),
    "bring me two mugs": f'[{{"goal":"bring","object":{{"name":"mug","count":2}},{ME}}}]',
}
SEQUENCES = {
    "pick up the red mug and put it on the lower rack": (
        '[{"goal":"pick","object":{"name":"mug","color":"red"}},'
        '{"goal":"place","object":{"name":"mug","color":"red"},"on":"lower rack"}]'
    ),
    "go to the garage, then find the blue mug, and after that bring it to me": (
        '[{"goal":"go_to","place":"garage"},{"goal":"find","object":{"name":"mug","color":"blue"}},'
        f'{{"goal":"bring","object":{{"name":"mug","color":"blue"}},{ME}}}]'
    ),
    "There is an orange on the sofa. Take it to the workbench.": (
        '[{"goal":"place","object":{"name":"orange","count":1,"at":"sofa"},"on":"workbench"}]'
    ),
    "the red mug, could you bring it here": (
        f'[{{"goal":"bring","object":{{"name":"mug","color":"red"}},{ME}}}]'
    ),
    "find Emil in the office and follow him to the garage": (
        '[{"goal":"find","person":{"name":"Emil","at":"office"}},'
        '{"goal":"follow","person":{"name":"Emil","at":"office"},"to":"garage"}]'
    ),
    "meet Ada at the sofa and take her to the front door": (
        '[{"goal":"meet","person":{"name":"Ada","at":"sofa"}},'
        '{"goal":"guide","person":{"name":"Ada"},"to":"front door"}]'
    ),
    "go to the workbench and wait there for two seconds": (
        '[{"goal":"go_to","place":"workbench"},{"goal":"wait","duration_s":2.0}]'
    ),
    "pick up the red mug, no wait, the blue one": (
        '[{"goal":"pick","object":{"name":"mug","color":"blue"}}]'
    ),
    "go to the office. Sorry, I mean the garage": '[{"goal":"go_to","place":"garage"}]',
    "turn around and walk back two metres": (
        '[{"goal":"go_to","by":{"turn_rad":3.141593}},{"goal":"go_to","by":{"forward_m":-2.0}}]'
    ),
}
MOTION = {
    "walk two metres forward": '[{"goal":"go_to","by":{"forward_m":2.0}}]',
    "go forward by 50 cm": '[{"goal":"go_to","by":{"forward_m":0.5}}]',
    "take three steps back": '[{"goal":"go_to","by":{"forward_m":-0.9}}]',
    "step half a metre to the right": '[{"goal":"go_to","by":{"left_m":-0.5}}]',
    "turn left ninety degrees": '[{"goal":"go_to","by":{"turn_rad":1.570796}}]',
    "rotate 45° to the right": '[{"goal":"go_to","by":{"turn_rad":-0.785398}}]',
    "turn right": '[{"goal":"go_to","by":{"turn_rad":-1.570796}}]',
    "come here": '[{"goal":"go_to","place":"operator"}]',
    "come back": '[{"goal":"go_to","place":"operator"}]',
    "would you mind going to the office": '[{"goal":"go_to","place":"office"}]',
    "navigate to the sofa in the living room": '[{"goal":"go_to","place":"sofa"}]',
    "enter the garage": '[{"goal":"go_to","place":"garage"}]',
    "look at the thermos": '[{"goal":"look_at","object":{"name":"thermos"}}]',
    "inspect the locker": '[{"goal":"look_at","place":"locker"}]',
    "look for the tape measure in the garage": (
        '[{"goal":"find","object":{"name":"tape measure","at":"garage"}}]'
    ),
    "where is the screwdriver?": '[{"goal":"find","object":{"name":"screwdriver"}}]',
    "wait for 5 seconds": '[{"goal":"wait","duration_s":5.0}]',
    "wait a minute and a half": '[{"goal":"wait","duration_s":90.0}]',
}
BODY = {
    "stand on one leg": '[{"goal":"balance","mode":"one_leg"}]',
    "stand on your left leg for ten seconds": (
        '[{"goal":"balance","mode":"one_leg","side":"left","duration_s":10.0}]'
    ),
    "balance on the right foot": '[{"goal":"balance","mode":"one_leg","side":"right"}]',
    "lift your left foot": '[{"goal":"balance","mode":"one_leg","side":"right"}]',
    "squat for 5 seconds": '[{"goal":"balance","mode":"squat","duration_s":5.0}]',
    "crouch down": '[{"goal":"balance","mode":"squat"}]',
    "stand up": '[{"goal":"balance","mode":"stand"}]',
    "stand still for three seconds": '[{"goal":"balance","mode":"stand","duration_s":3.0}]',
    "lean to the left": '[{"goal":"balance","mode":"lean","side":"left"}]',
    "sit down": '[{"goal":"balance","mode":"sit"}]',
    "wave to Noor": '[{"goal":"gesture","kind":"wave","at":"Noor"}]',
    "nod your head": '[{"goal":"gesture","kind":"nod"}]',
    "point at the red mug": '[{"goal":"gesture","kind":"point","at":"red mug"}]',
    "give me a thumbs up": '[{"goal":"gesture","kind":"thumbs_up"}]',
    "squat three times": (
        '[{"goal":"repeat","times":3,"goals":[{"goal":"balance","mode":"squat"}]}]'
    ),
}
PEOPLE = {
    "say hello to Ada": '[{"goal":"greet","person":{"name":"Ada"}}]',
    "introduce yourself to the man raising his right arm in the office": (
        '[{"goal":"greet","person":{"gender":"male","gesture":"raising right arm","at":"office"}}]'
    ),
    "guide Noor from the sofa to the front door": (
        '[{"goal":"guide","person":{"name":"Noor","at":"sofa"},"to":"front door"}]'
    ),
    "follow me": '[{"goal":"follow","person":{"who":"operator"}}]',
    "follow whoever is pointing left": ('[{"goal":"follow","person":{"gesture":"pointing left"}}]'),
    "get to know the woman sitting on the sofa": (
        '[{"goal":"meet","person":{"gender":"female","posture":"sitting","at":"sofa"}}]'
    ),
    'say "lunch is ready" to Emil': (
        '[{"goal":"say","what":"lunch is ready","to":{"name":"Emil"}}]'
    ),
    "tell Emil that lunch is ready": (
        '[{"goal":"say","what":"lunch is ready","to":{"name":"Emil"}}]'
    ),
    "tell me the time": f'[{{"goal":"say","what":"the time",{ME}}}]',
    "answer Noor's question": '[{"goal":"answer","what":"question","person":{"name":"Noor"}}]',
    "how many tools are on the workbench?": (
        '[{"goal":"count","object":{"category":"tool","at":"workbench"}}]'
    ),
    "tell me how many women wear green in the garage": (
        '[{"goal":"count","person":{"gender":"female","wearing":{"color":"green"},"at":"garage"},'
        + ME
        + "}]"
    ),
    "which is the smallest of the things on the sofa?": (
        '[{"goal":"tell","of":{"superlative":"smallest","at":"sofa"},"property":"name"}]'
    ),
    "tell me Noor's pose": (
        '[{"goal":"tell","of":{"name":"Noor"},"property":"posture",' + ME + "}]"
    ),
}
MISSION = {
    "what are you holding?": '[{"goal":"report","topic":"holding"}]',
    "where are you": '[{"goal":"report","topic":"location"}]',
    "what do you see?": '[{"goal":"report","topic":"seeing"}]',
    "why did you stop?": '[{"goal":"report","topic":"why"}]',
    "report your status": '[{"goal":"report","topic":"status"}]',
    "what can you do?": '[{"goal":"report","topic":"capabilities"}]',
    "pause": '[{"goal":"pause"}]',
    "carry on": '[{"goal":"resume"}]',
    "never mind": '[{"goal":"cancel"}]',
    "stop": '[{"goal":"stop"}]',
    "walk to the sofa, then stop": '[{"goal":"go_to","place":"sofa"},{"goal":"stop"}]',
    "open the locker": '[{"goal":"open","what":"locker"}]',
    "close your hand": '[{"goal":"close","what":"hand"}]',
    "turn the lamp off": '[{"goal":"switch","what":"lamp","on":false}]',
    "switch on the coffee machine": '[{"goal":"switch","what":"coffee machine","on":true}]',
    "if the red mug is not on the sofa, bring me the blue one, otherwise wait a second": (
        '[{"goal":"if","condition":{"is":"present","object":{"name":"mug","color":"red",'
        '"at":"sofa"},"negated":true},"then":[{"goal":"bring","object":{"name":"mug",'
        f'"color":"blue"}},{ME}}}],"else":[{{"goal":"wait","duration_s":1.0}}]}}]'
    ),
    "bring me the thermos if the locker is open": (
        '[{"goal":"if","condition":{"is":"state","what":"locker","state":"open"},'
        f'"then":[{{"goal":"bring","object":{{"name":"thermos"}},{ME}}}]}}]'
    ),
    "for each tool on the workbench, put it in the toolbox": (
        '[{"goal":"for_each","object":{"category":"tool","at":"workbench"},"goals":'
        '[{"goal":"place","object":{"held":true},"in":"toolbox"}]}]'
    ),
    "repeat twice: wave and bow": (
        '[{"goal":"repeat","times":2,"goals":[{"goal":"gesture","kind":"wave"},'
        '{"goal":"gesture","kind":"bow"}]}]'
    ),
}
SPELLING = {
    "pick up the scewdriver": '[{"goal":"pick","object":{"name":"screwdriver"}}]',
    "go to teh workbnch": '[{"goal":"go_to","place":"workbench"}]',
    "bring me the lemonaid": f'[{{"goal":"bring","object":{{"name":"lemonade"}},{ME}}}]',
    "go to the couch": '[{"goal":"go_to","place":"sofa"}]',
    "take theorange": '[{"goal":"pick","object":{"name":"orange"}}]',
    "PICK UP THE ORANGE!!!": '[{"goal":"pick","object":{"name":"orange"}}]',
}

FREE_SPEECH = {
    "put the red mug on the sofa and the blue mug on the workbench": (
        '[{"goal":"place","object":{"name":"mug","color":"red"},"on":"sofa"},'
        '{"goal":"place","object":{"name":"mug","color":"blue"},"on":"workbench"}]'
    ),
    "pick up the red mug, then the blue one": (
        '[{"goal":"pick","object":{"name":"mug","color":"red"}},'
        '{"goal":"pick","object":{"name":"mug","color":"blue"}}]'
    ),
    "grab the orange and the thermos and put them on the sofa": (
        '[{"goal":"pick","object":{"name":"orange"}},{"goal":"pick","object":{"name":"thermos"}},'
        '{"goal":"place","object":{"name":"orange"},"on":"sofa"},'
        '{"goal":"place","object":{"name":"thermos"},"on":"sofa"}]'
    ),
    "before you go to the sofa, pick up the orange": (
        '[{"goal":"pick","object":{"name":"orange"}},{"goal":"go_to","place":"sofa"}]'
    ),
    "after picking up the orange, go to the sofa": (
        '[{"goal":"pick","object":{"name":"orange"}},{"goal":"go_to","place":"sofa"}]'
    ),
    "go to the sofa after picking up the orange": (
        '[{"goal":"pick","object":{"name":"orange"}},{"goal":"go_to","place":"sofa"}]'
    ),
    "go to x = 1.5, y = -2": '[{"goal":"go_to","pose":{"x_m":1.5,"y_m":-2.0}}]',
    "turn 180": '[{"goal":"go_to","by":{"turn_rad":3.141593}}]',
    "walk over to the locker and look at it": (
        '[{"goal":"go_to","place":"locker"},{"goal":"look_at","place":"locker"}]'
    ),
    "go get me the thermos": f'[{{"goal":"bring","object":{{"name":"thermos"}},{ME}}}]',
    "bring me what is on the workbench": (
        f'[{{"goal":"bring","object":{{"at":"workbench"}},{ME}}}]'
    ),
    "hand me the tool that weighs the least": (
        '[{"goal":"bring","object":{"category":"tool","superlative":"lightest"},' + ME + "}]"
    ),
    "On the workbench there is a screwdriver. Bring it to Ada.": (
        '[{"goal":"bring","object":{"name":"screwdriver","count":1,"at":"workbench"},"to":{"name":"Ada"}}]'
    ),
    "of the tools on the workbench, which is the heaviest?": (
        '[{"goal":"tell","of":{"category":"tool","superlative":"heaviest","at":"workbench"},'
        '"property":"name"}]'
    ),
    "look at the sofa and tell me how many mugs there are": (
        '[{"goal":"count","object":{"name":"mug","at":"sofa"},' + ME + "}]"
    ),
    "find the heaviest tool and tell me what it is": (
        '[{"goal":"tell","of":{"category":"tool","superlative":"heaviest"},"property":"name",'
        + ME
        + "}]"
    ),
    "meet and greet Noor": (
        '[{"goal":"meet","person":{"name":"Noor"}},{"goal":"greet","person":{"name":"Noor"}}]'
    ),
    "I want the lemonade from the locker, please fetch it": (
        f'[{{"goal":"bring","object":{{"name":"lemonade","at":"locker"}},{ME}}}]'
    ),
    "Emil is on the sofa, bring him the thermos": (
        '[{"goal":"bring","object":{"name":"thermos"},"to":{"name":"Emil","at":"sofa"}}]'
    ),
    "hello": '[{"goal":"greet","person":{"who":"operator"}}]',
}


def check(said: str, goals: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert to_json(outcome.goals) == to_json(from_json(goals))


@pytest.mark.parametrize(("said", "goals"), HANDLING.items())
def test_handling(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), SEQUENCES.items())
def test_sequences_pronouns_and_corrections(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), MOTION.items())
def test_motion(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), BODY.items())
def test_posture_and_gestures(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), PEOPLE.items())
def test_people_and_questions(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), MISSION.items())
def test_mission_devices_and_control_flow(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), FREE_SPEECH.items())
def test_free_speech(said: str, goals: str) -> None:
    check(said, goals)


@pytest.mark.parametrize(("said", "goals"), SPELLING.items())
def test_spelling(said: str, goals: str) -> None:
    check(said, goals)
