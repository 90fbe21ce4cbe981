"""Light verbs, whose noun is the act: "give Ada a wave", "do two squats", "make a left turn"."""

from math import pi

from intents.english.clauses.verb_clauses import framed, without_favours
from intents.english.frames import FRAMES
from intents.english.phrases.complements import Clause, Complement, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import is_person
from intents.english.reading import Found, Sentence
from intents.english.repeating import repeated
from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.english.words.measures import Measure, number
from intents.english.words.text import Text

_ACTS: dict[str, tuple[str, str]] = {
    "wave": ("gesture", "wave"), "nod": ("gesture", "nod"), "bow": ("gesture", "bow"),
    "clap": ("gesture", "clap"), "applause": ("gesture", "clap"), "dance": ("gesture", "dance"),
    "shrug": ("gesture", "shrug"), "curtsy": ("gesture", "bow"), "squat": ("squat", "squat"),
    "crouch": ("squat", "squat"), "turn": ("turn", "turn"), "rotation": ("turn", "turn"),
    "spin": ("turn", "spin"),
    "look": ("look", "look at"), "glance": ("look", "look at"), "peek": ("look", "look at"),
    "thumbs-up": ("gesture", "thumbs up"), "greeting": ("greet", "greet"),
    "welcome": ("greet", "greet"), "hello": ("greet", "greet"),
    "handshake": ("gesture", "shake hands"), "search": ("find", "search"),
}  # fmt: skip
"""Nouns of acts: the sense and the verb that say the same."""
_TWO_WORD_ACTS = {
    ("high", "five"): ("gesture", "high five"), ("thumbs", "up"): ("gesture", "thumbs up"),
    ("shake", "hands"): ("gesture", "shake hands"),
}  # fmt: skip
_ABOUT_FACE = dict.fromkeys(
    lexicon.phrases("u turn,you turn,about face,about turn,180,one eighty"), pi
) | dict.fromkeys(lexicon.phrases("360,three sixty,full 360"), 2 * pi)
_TURNS = {"full": 2 * pi, "whole": 2 * pi, "complete": 2 * pi, "half": pi, "quarter": pi / 2}
_ADJECTIVES = lexicon.words("quick good little big small long short nice friendly proper close "
                            "sharp deep polite careful gentle single slow hard warm wee "
                            "hearty big fast tiny")  # fmt: skip


def light_verb(sentence: Sentence, at: int) -> Found | None:
    """Give Ada a friendly wave; do two squats; make a left turn; have a look at the sink."""
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(lexicon.LIGHT_VERBS, at)
    if start is None:
        return None
    receiver = noun_phrase(text, start)
    complements: list[Complement] = []
    if receiver and is_person(receiver, scope) and receiver.noun != "unknown":
        if receiver.noun != "operator":
            complements.append(Complement(role="to", phrases=[receiver]))
        start = receiver.end
    about = text.lookup(_ABOUT_FACE, start + (text.word(start) in ("a", "an")))
    if about:
        angle, end = about
        around = [Complement(measure=Measure("angle", angle, end))]
        more, end = read_complements(text, end)
        return framed(sentence, "turn", text.word(at), around + more, first=at + 1, end=end)
    found = _act(text, start, complements)
    if found is None:
        return None
    (sense, verb), times, end = found
    more, end = read_complements(text, end)
    more = without_favours(sense, more)
    clause = Clause(text, sense, verb, end, end, complements + more)
    goals = FRAMES[sense](clause, scope)
    often = clause.measure("times")
    return repeated(goals, times if often is None else often), end


def _act(
    text: Text, at: int, complements: list[Complement]
) -> tuple[tuple[str, str], float, int] | None:
    """An act as a noun: which, how often, and where it ends; its adjectives are complements."""
    times = 1.0
    amount = number(text.words, at) if text.word(at) != "a" else None
    if amount and amount.value >= 1:
        times, at = amount.value, amount.end
    at += text.word(at) in lexicon.DETERMINERS
    while True:
        word = text.word(at)
        phrase = text.lookup(_TWO_WORD_ACTS, at)
        if phrase:
            return phrase[0], times, phrase[1]
        act = _ACTS.get(singular(word))
        if act and not text.name_at(at):
            return act, times, at + 1
        if word in _TURNS:
            complements.append(Complement(measure=Measure("angle", _TURNS[word], at + 1)))
        elif word in ("left", "right"):
            complements.append(
                Complement(direction="left" if word == "left" else "right", particle=word)
            )
        elif word not in _ADJECTIVES:
            return None
        at += 1
