"""Sentences as people type them: many ways to ask for the same."""

from __future__ import annotations

import re

import numpy as np

from sim.homes.draws import one_of

ASIDE = ("{}",) * 10 + (
    "please {}", "{} please", "could you {}?", "can you {} please?", "hey, {}", "ok, {}",
    "{}, thanks", "would you {}?", "robot, {}", "now {}",
)  # fmt: skip
"""What is said around a command; mostly nothing."""
COMMANDS = frozenset(
    [
        "bring",
        "put",
        "take",
        "move",
        "fetch",
        "place",
        "carry",
        "pick",
        "get",
        "grab",
        "go",
        "walk",
        "visit",
        "find",
        "look",
        "search",
        "say",
        "tell",
        "give",
        "collect",
        "gather",
        "set",
        "patrol",
        "make",
        "do",
        "let",
        "clear",
    ]
)
"""First words of sentences that such words go around: nobody says "please if"."""
CAREFULLY = 0.2
"""How many begin with a capital letter and end with a full stop."""

FETCH = (
    "bring {o} from {p} to {q}", "put {o} on {q}", "take {o} off {p} and put it on {q}",
    "move {o} from {p} to {q}", "fetch {o} and set it down on {q}", "place {o} on {q}",
    "carry {o} over to {q} and leave it there", "pick up {o} and put it on {q}",
    "get {o} from {p} and place it on {q}", "grab {o} and bring it to {q}",
    "take {o} to {q}", "put {o} that is on {p} on {q}",
)  # fmt: skip
WISHES = (
    "I need {o} on {q}", "{o} belongs on {q}, take it there please", "{o} should be on {q}",
    "I want {o} moved to {q}", "I would like to have {o} on {q}",
)  # fmt: skip
TWO_TOGETHER = (
    "put {a} and {b} on {q}", "bring {a} and {b} to {q}", "take {a} and also {b} to {q}",
    "move both {a} and {b} to {q}", "get {a} and {b} and put them on {q}",
    "put {a} on {q}, and {b} too",
)  # fmt: skip
TWO_APART = (
    "put {a} on {q} and {b} on {r}", "bring {a} to {q} and {b} to {r}",
    "first take {a} to {q}, then bring {b} to {r}", "move {a} to {q}, after that put {b} on {r}",
    "take {a} from {p} to {q} and then carry {b} to {r}",
)  # fmt: skip
RELATIVE = (
    "take the {c} {rel} {b} and put it on {q}", "bring the {c} {rel} {b} to {q}",
    "pick up the {c} {rel} {b} and bring it to {q}", "move the {c} that is {rel} {b} to {q}",
    "the {c} {rel} {b} belongs on {q}", "get the {c} standing {rel} {b} and place it on {q}",
)  # fmt: skip
RELATIONS = {
    "near": ("next to", "beside", "right beside", "next to"),
    "behind": ("behind",),
    "in_front": ("in front of",),
    "left": ("to the left of", "left of"),
    "right": ("to the right of", "right of"),
}
IF_ANY = (
    "if there is {a_c} on {p}, bring it to {q}, otherwise go to {s}",
    "if you find {a_c} on {p}, put it on {q}; if not, go to {s}",
    "if there is {a_c} on {p}, take it to {q}", "bring {a_c} from {p} to {q} if there is one",
    "is there {a_c} on {p}? if so, put it on {q}",
    "check whether there is {a_c} on {p}. if there is, take it to {q}",
)  # fmt: skip
IF_THERE = (
    "if {o} is on {p}, take it to {q}", "if {o} is on {p}, put it on {q}, otherwise go to {s}",
    "take {o} to {q} if it is on {p}", "should {o} be on {p}, move it to {q}",
    "if {o} is still on {p} bring it to {q}, else walk to {s}",
)  # fmt: skip
IF_NOT_THERE = (
    "if {o} is on {p}, take it to {q}, otherwise go to {s}",
    "if {o} is on {p} put it on {q}, else walk to {s}",
    "check if {o} is on {p}. if it is, bring it to {q}, if not, go to {s}",
    "go to {s} if {o} is not on {p}, otherwise put it on {q}",
)  # fmt: skip
IF_NONE = (
    "if there is no {c} on {p}, put {o} there", "if there is no {c} on {p}, bring {o} there",
    "put {o} on {p} if there is no {c} on it yet", "if {p} has no {c} on it, put {o} there",
)  # fmt: skip
ROUTE = (
    "go to {a}, then to {b}", "walk to {a} and then come to {b}", "go to {a} and after that to {b}",
    "go to {a}, wait three seconds and then go to {b}", "first visit {a}, then {b}",
    "walk over to {a}, and from there to {b}", "go to {a}, look around, then go on to {b}",
)  # fmt: skip
SEARCH = (
    "find {o} and bring it to {q}", "where is {o}? find it and put it on {q}",
    "look for {o} and put it on {q}", "search for {o} and take it to {q}",
    "I cannot find {o}. look for it and put it on {q}", "find {o}, then put it on {q}",
    "I have lost {o}, find it please and put it on {q}",
)  # fmt: skip
SEARCH_SPOT = (
    "find {o} and bring it to {s}", "look for {o} and come to {s} with it",
    "search for {o} and take it to {s}",
)  # fmt: skip
HELLO = (
    "find {P} and say hello to {them}", "go to {P} and say hello", "say hello to {P}",
    "go and greet {P}", "look for {P} and say hello to {them}",
)  # fmt: skip
TELL = (
    "tell {P} that {m}", "go to {P} and tell {them} that {m}", "find {P} and say that {m}",
    "let {P} know that {m}",
)  # fmt: skip
NEWS = (
    "lunch is ready", "the taxi is here", "the parcel has arrived", "the visitors are here",
    "the meeting is over", "it is raining",
)  # fmt: skip
HAND_OVER = (
    "bring {P} {o}", "take {o} to {P}", "give {P} {o}", "give {o} to {P}",
    "get {o} and hand it to {P}", "bring {o} from {p} to {P}", "fetch {o} for {P}",
)  # fmt: skip
NEEDS = ("{P} needs {o}, bring it to {them}", "{P} wants {o}, get it for {them}")
COUNT = (
    "how many {cs} are on {p}?", "how many {cs} are there on {p}?", "count the {cs} on {p}",
    "tell me how many {cs} are on {p}", "how many {cs} do we have on {p}?",
)  # fmt: skip
COUNT_IN = (
    "how many {cs} are in {p}?", "how many {cs} are there in {p}?", "count the {cs} in {p}",
    "go and see how many {cs} there are in {p}",
)  # fmt: skip
ALL = (
    "put all {cs} on {q}", "bring all the {cs} to {q}", "put every {c} on {q}",
    "collect all {cs} and put them on {q}", "take all the {cs} to {q}", "all {cs} go on {q}",
    "gather the {cs} on {q}",
)  # fmt: skip
BOTH = (
    "put both {cs} on {q}", "bring the two {cs} to {q}", "take both {cs} to {q}",
    "put both of the {cs} on {q}",
)  # fmt: skip
ALL_FROM = (
    "move all {cs} from {p} to {q}", "take all the {cs} on {p} and put them on {q}",
    "put the {cs} that are on {p} on {q}", "clear the {cs} off {p} and put them on {q}",
)  # fmt: skip
NEXT_TO = (
    "put {o} next to {b}", "place {o} beside {b}", "bring {o} and put it next to {b}",
    "set {o} down beside {b}", "take {o} and place it right next to {b}",
    "{o} belongs next to {b}, put it there",
)  # fmt: skip
PATROL = {
    1: ("patrol {all}", "patrol {all} once", "do a round through {all}", "make one tour of {all}"),
    2: ("patrol {all} twice", "do two rounds through {all}", "patrol {all} two times"),
}
NUMBERS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def asked(sentence: str, rng: np.random.Generator) -> str:
    """A sentence with what people say around a command, written carefully or not."""
    is_whole = re.search(r"[?.]( |$)|please", sentence)
    if sentence.split(maxsplit=1)[0] in COMMANDS and not is_whole:
        sentence = one_of(ASIDE, rng).format(sentence)
    if rng.random() < CAREFULLY:
        sentence = sentence[0].upper() + sentence[1:]
        if sentence[-1] not in "?.":
            sentence += "."
    return sentence


def listed(names: list[str]) -> str:
    """Names as a list: a, b and c."""
    return f"{', '.join(names[:-1])} and {names[-1]}"


def an(noun: str) -> str:
    """A noun with its article."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"
