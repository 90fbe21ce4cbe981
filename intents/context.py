"""What was said before, and how an answer completes the question that is open."""

import re
from typing import Literal

import msgspec
from msgspec.structs import replace

from intents.english.substitution import substitute
from intents.english.words import lexicon
from intents.english.words.lexer import tokenize
from intents.goals import Goal, ObjectQuery, Person, each
from intents.grounding import Entity
from intents.outcomes import Choice, Question
from intents.relations import Viewpoint


class Said(msgspec.Struct, frozen=True):
    """One turn of a conversation, in words."""

    who: Literal["person", "robot"]
    text: str


class Context(msgspec.Struct, frozen=True, kw_only=True):
    """What a sentence may refer to; give the one of an outcome to the next sentence.

    Attributes:
        object: What "it" is.
        person: Who "him" or "her" is.
        place: Where "there" is.
        goals: What was asked last, for "do it again".
        question: The question that is open.
        said: The last turns, the newest last.
        entities: What is known to be there; without any, nothing is found ambiguous.
        view: Where the robot stands, for "the leftmost".
    """

    object: ObjectQuery | None = None
    person: Person | None = None
    place: str | None = None
    goals: tuple[Goal, ...] = ()
    question: Question | None = None
    said: tuple[Said, ...] = ()
    entities: tuple[Entity, ...] = ()
    view: Viewpoint | None = None


MAX_SAID = 12
"""Turns that are remembered in words."""


def of_goals(goals: tuple[Goal, ...]) -> Context:
    """What a sentence may refer to after such goals, in whatever words they were asked for."""
    things: list[ObjectQuery] = []
    people: list[Person] = []
    for goal in each(goals):
        for slot in goal.__struct_fields__:
            value = getattr(goal, slot)
            things += [value] if isinstance(value, ObjectQuery) else []
            people += [value] if isinstance(value, Person) else []
    return Context(
        object=things[-1] if things else None, person=people[-1] if people else None, goals=goals
    )


def noted(context: Context, person: str, robot: str) -> Context:
    """A conversation after a person and the robot have spoken."""
    said = (*context.said, Said("person", person[:1000]), Said("robot", robot[:1000]))
    return replace(context, said=said[-MAX_SAID:])


def answered(text: str, question: Question) -> tuple[Goal, ...] | None:
    """The goals of an open question once a text answers it; None if it does not.

    An answer names what one of the choices has and the others have not ("blue", "the one on the
    shelf"), or its position ("the second"); "any" is the first of them, "both" are all.
    """
    if question.kind == "confirmation":
        return question.goals if verdict_of(text) else None
    about, said = question.about, tuple(t.text for t in tokenize(text) if t.text.isalpha())
    said = tuple(word for word in said if word != "please")
    if said in _ALL and about is not None and question.choices:
        every = replace(about, count="all")
        return tuple(substitute(goal, about, every) for goal in question.goals)
    choice = question.choices[0] if said in _ANY and question.choices else None
    choice = choice or _choice(text, question.choices)
    if choice is None or choice.query is None or question.about is None:
        return None
    refined = replace(choice.query, count=question.about.count)
    return tuple(substitute(goal, question.about, refined) for goal in question.goals)


def completed(text: str, question: Question) -> list[str]:
    """What was said before with an answer in it, in the ways in which it may fit."""
    choice = _choice(text, question.choices)
    if choice is not None and question.said:
        said = re.compile(rf"\b{re.escape(question.said)}\b", re.IGNORECASE)
        return [said.sub(choice.label, question.text)]
    if question.choices or not question.text:
        return []
    if question.said:
        said = re.compile(rf"\b{re.escape(question.said)}\b", re.IGNORECASE)
        return [said.sub(f"{link}{text}", question.text) for link in ("", "on ", "to ")]
    before = question.text.rstrip(" .!?")
    return [f"{before}{link}{text}" for link in (" ", " on ", " to ")]


_ANY = lexicon.phrases(
    "any,either,any of them,either of them,either one,any one,anyone,whichever,whichever you like,"
    "you choose,your choice,it does not matter,does not matter,i do not care,i do not mind,whatever"
)
_ALL = lexicon.phrases("both,all,both of them,all of them,each,every one,both please,the both")
_ORDINALS = {"first": 0, "former": 0, "second": 1, "latter": 1, "third": 2, "fourth": 3, "last": -1}
_EMPTY = lexicon.DETERMINERS | lexicon.ONES | lexicon.words("at on in please")


def _choice(text: str, choices: tuple[Choice, ...]) -> Choice | None:
    said = [t.text for t in tokenize(text) if t.text not in _EMPTY and t.text[0].isalnum()]
    if not said or len(said) > 6:
        return None
    if len(choices) == 1 and verdict_of(text):
        return choices[0]
    fitting = [c for c in choices if all(w in c.label.split() for w in said)]
    if len(fitting) == 1:
        return fitting[0]
    position = next((_ORDINALS[w] for w in said if w in _ORDINALS), None)
    if position is not None and -1 <= position < len(choices) and len(said) <= 2:
        return choices[position]
    return None


_YES = lexicon.words(
    "yes yeah yep yup sure ok okay affirmative confirm confirmed correct right indeed absolutely "
    "certainly definitely proceed continue y ja si oui aye"
)
_YES_PHRASES = lexicon.phrases(
    "do it,go ahead,of course,please do,do that,go on,sounds good,that is right,i am sure,you may,"
    "go for it,carry on"
)
_NO = lexicon.words(
    "no nope nah not never negative neither none nothing nein non don't n nevermind"
)
_NO_PHRASES = lexicon.phrases(
    "never mind,forget it,leave it,forget that,better not,rather not,stop that,do not,let it be,"
    "i changed my mind"
)


def verdict_of(text: str) -> bool | None:
    """Whether a text is a yes or a no and nothing else."""
    said = [token.text for token in tokenize(text) if token.text[0].isalnum()]
    said = [word for word in said if word not in ("please", "robot", "thanks", "thank", "you")]
    short = " ".join(said)
    if not 0 < len(said) <= 5:
        return None
    if said[0] in _NO or any(short.startswith(" ".join(p)) for p in _NO_PHRASES):
        plain = len(said) == 1 or all(w in _NO | _YES | _REST for w in said[1:])
        return False if plain or tuple(said) in _NO_PHRASES else None
    if said[0] == "cancel" and len(said) <= 2:
        return False
    if said[0] in _YES or tuple(said[:2]) in _YES_PHRASES or tuple(said) in _YES_PHRASES:
        rest = said[1:] if said[0] in _YES else []
        plain = all(w in _YES | _REST for w in rest) or tuple(rest) in _YES_PHRASES
        return True if plain else None
    return None


_REST = lexicon.words("it that do of them thing wait i want mind all one these go on ahead is the")
