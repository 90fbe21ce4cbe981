"""Clauses whose verb is not the act.

"Give Ada a wave", "lights off", "help Ada find the door", "I need you in the cellar", "in ten
seconds, ...", "patrol between the table and the shelf".
"""

from math import pi

from msgspec.structs import replace

from intents.english import lexicon
from intents.english.complements import Clause, Complement, ends_clause, read_complements
from intents.english.frames import FRAMES
from intents.english.lexer import COMMA, singular
from intents.english.measures import Measure, measure, number
from intents.english.noun_phrases import noun_phrase
from intents.english.phrase import NounPhrase
from intents.english.questions import Reading
from intents.english.referents import is_person, to_person, to_place
from intents.english.results import WISHES, Results
from intents.english.saying import content_end
from intents.english.sentences import without_favours
from intents.english.trouble import Unclear
from intents.english.verbs import verbs_at
from intents.goals import (
    OPERATOR,
    Close,
    GoTo,
    Guide,
    LookAt,
    Repeat,
    Switch,
    Wait,
)

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

_HELPS = lexicon.words("help assist let")
_FINDS_WAY = lexicon.phrases(
    "get,go,find,reach,navigate,find his way,find her way,find their way,find the way,walk,move,"
    "make his way,make her way,make their way,come,travel,find way,get back,return"
)
_CAUSES = lexicon.words("have let make ask get tell")
_LIFTS = lexicon.words("raise lift lower")
_LOOKS = lexicon.phrases("look,see,check,go see,go and see,find out,have a look,go check")
_TO_AND_FRO = lexicon.phrases(
    "patrol between,commute between,pace between,pace back and forth between,"
    "go back and forth between,walk back and forth between,move back and forth between,"
    "run back and forth between,go to and fro between,walk to and fro between"
)
_TIDIES = lexicon.phrases("tidy by,tidy up by,clean up by,clear up by")
_ASIDE = lexicon.phrases(
    "step aside,move aside,go aside,stand aside,get out of the way,get out of my way,"
    "move out of the way,move out of my way,go out of the way,out of the way,out of my way,"
    "make way,make room,clear the way,move over,step to the side,move to the side,go to the side,"
    "take a step aside,take a step to the side,sidestep,side step,stay out of the way,"
    "step out of the way,keep out of the way,let me pass,let me through,let us through"
)
_TOLD = lexicon.phrases(
    "until i,until we,until further notice,until you are told,until told,until you hear,"
    "until my signal,until my command,until my word,until someone tells you,"
    "until somebody tells you"
)
_ARRIVED = lexicon.phrases(
    "when you are,once you are,when you get to,once you get to,when you reach,once you reach,"
    "as soon as you are,as soon as you reach,as soon as you get to,when you arrive,once you arrive,"
    "when you have reached,once you have reached,when you come to,when you enter,once you enter,"
    "after you get to,after you reach"
)
_GIVE_IT = lexicon.phrases("give it,take,give me")
_IN_A_WHILE = lexicon.words("in after")


class Constructions(Results):
    """Reads clauses whose meaning is not that of their verb."""

    def construction(self, at: int) -> Reading | None:
        """The first construction that a clause is, if it is one."""
        return (
            self._light_verb(at)
            or self.resultative(at)
            or self._helped(at)
            or self._followed(at)
            or self._wanted_there(at)
            or self._out_of_the_way(at)
            or self._until_told(at)
            or self._arrived(at)
            or self._later(at)
            or self._to_and_fro(at)
            or self._tidied(at)
            or self._whether(at)
            or self._verbless(at)
        )

    def _light_verb(self, at: int) -> Reading | None:
        """Give Ada a friendly wave; do two squats; make a left turn; have a look at the sink."""
        text = self.text
        start = text.phrase_end(lexicon.LIGHT_VERBS, at)
        if start is None:
            return None
        receiver = noun_phrase(text, start)
        complements: list[Complement] = []
        if receiver and is_person(receiver, self.scope) and receiver.noun != "unknown":
            if receiver.noun != "operator":
                complements.append(Complement(role="to", phrases=[receiver]))
            start = receiver.end
        about = text.lookup(_ABOUT_FACE, start + (text.word(start) in ("a", "an")))
        if about:
            angle, end = about
            around = [Complement(measure=Measure("angle", angle, end))]
            more, end = read_complements(text, end)
            return self.framed("turn", at, at + 1, around + more, end)
        found = self._act(start, complements)
        if found is None:
            return None
        (sense, verb), times, end = found
        more, end = read_complements(text, end)
        more = without_favours(sense, more)
        clause = Clause(text, sense, verb, end, end, complements + more)
        goals = FRAMES[sense](clause, self.scope)
        times = int(clause.measure("times") or times)
        return ([Repeat(times=times, goals=tuple(goals))] if times > 1 else goals), end

    def _act(
        self, at: int, complements: list[Complement]
    ) -> tuple[tuple[str, str], int, int] | None:
        """An act as a noun: which, how often, and where it ends; its adjectives are complements."""
        text, times = self.text, 1
        amount = number(text.words, at) if text.word(at) != "a" else None
        if amount and amount.value >= 1:
            times, at = int(amount.value), amount.end
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

    def _verbless(self, at: int) -> Reading | None:
        """Lights off; three steps forward; into the kitchen."""
        text = self.text
        if text.words[at : at + 3] in (["make", "a", "fist"], ["form", "a", "fist"]):
            return [Close(what="hand")], at + 3
        if text.words[at + 1 : at + 3] == ["your", "head"] and text.word(at) in _LIFTS:
            up = text.word(at) != "lower"
            return [LookAt(place="up" if up else "down")], at + 3 + (text.word(at + 3) == "up")
        if text.word(at) in ("light", "lights") and text.word(at + 1) in ("on", "off", "out"):
            return [Switch(what="light", on=text.word(at + 1) == "on")], at + 2
        moved = self._moved(at)
        if moved:
            return moved
        if verbs_at(text.words, at) and not text.name_at(at):
            return None
        on_or_off = self.brought_about(at)
        if on_or_off and isinstance(on_or_off[0][0], Switch):
            return on_or_off
        return None

    def _moved(self, at: int) -> Reading | None:
        """Three steps forward; left 90 degrees."""
        text = self.text
        if verbs_at(text.words, at) or text.name_at(at):
            return None
        complements, end = read_complements(text, at)
        kinds = [c.measure.kind for c in complements if c.measure]
        moves = all(c.direction or c.measure for c in complements) and len(complements) > 1
        if not moves or kinds not in (["length"], ["angle"]):
            return None
        return self.framed("go" if kinds == ["length"] else "turn", at, at, complements, end)

    def _helped(self, at: int) -> Reading | None:
        """Help Ada find her way from the gate to the lab; show Ada where the lab is."""
        text = self.text
        if text.word(at) not in _HELPS | {"show", "how"}:
            return None
        start = at + 1
        if text.word(at) == "how":
            start += text.word(start) in ("does", "can", "do", "could", "should")
        phrase = noun_phrase(text, start)
        if phrase is None or not is_person(phrase, self.scope) or phrase.noun == "operator":
            return None
        end = phrase.end + (text.word(phrase.end) == "to")
        person = to_person(phrase, self.scope)
        if text.word(at) == "show":
            return self._shown(person_end=phrase.end, phrase=phrase)
        way = text.phrase_end(_FINDS_WAY, end)
        if way is None:
            return None
        complements, stop = read_complements(text, way)
        source = next((c for c in complements if c.phrases and c.role == "from"), None)
        goal = next((c for c in complements if c.phrases and c.role in ("to", "into", "")), None)
        if goal is None:
            return None
        if source:
            person = replace(person, at=to_place(source.phrase, self.scope, objects=True))
        to = OPERATOR if goal.phrase.noun in ("operator", "here") else None
        return [Guide(person=person, to=to or to_place(goal.phrase, self.scope))], stop

    def _shown(self, *, person_end: int, phrase: NounPhrase) -> Reading | None:
        text = self.text
        if text.word(person_end) != "where":
            return None
        start = person_end + 1 + (text.word(person_end + 1) in ("is", "are"))
        place = noun_phrase(text, start)
        if place is None:
            return None
        end = place.end + (text.word(place.end) in ("is", "are"))
        to = to_place(place, self.scope, objects=True)
        return [Guide(person=to_person(phrase, self.scope), to=to)], end

    def _followed(self, at: int) -> Reading | None:
        """Have her follow you to the office: to guide her."""
        text = self.text
        phrase = noun_phrase(text, at + 1) if text.word(at) in _CAUSES else None
        if phrase is None or not is_person(phrase, self.scope):
            return None
        end = phrase.end + (text.word(phrase.end) == "to")
        if text.words[end : end + 2] not in (["follow", "you"], ["come", "with"]):
            return None
        complements, stop = read_complements(text, end + 2)
        goal = next((c for c in complements if c.phrases and c.role in ("to", "into")), None)
        to = to_place(goal.phrase, self.scope) if goal else None
        return [Guide(person=to_person(phrase, self.scope), to=to)], stop

    def _wanted_there(self, at: int) -> Reading | None:
        """I need you in the cellar."""
        text = self.text
        start = text.phrase_end(WISHES, at)
        if start is None or text.word(start) != "you":
            return None
        start += 3 if text.words[start + 1 : start + 3] == ["to", "be"] else 1
        complements, end = read_complements(text, start)
        if len(complements) != 1 or complements[0].role not in ("at", "to"):
            return None
        return [GoTo(place=to_place(complements[0].phrase, self.scope))], end

    def _out_of_the_way(self, at: int) -> None:
        """Step aside.

        Raises:
            Unclear: That is what was said: to which side is to be asked.
        """
        end = self.text.phrase_end(_ASIDE, at)
        if end is not None and ends_clause(self.text, end):
            sides = ("step to the left", "step to the right")
            raise Unclear("To the left or to the right?", sides, self.text.raw(at, end))

    def _until_told(self, at: int) -> Reading | None:
        """Wait at the door *until I call you*: without an end of its own."""
        text = self.text
        first = next((end for sense, end in verbs_at(text.words, at) if sense == "wait"), None)
        until = first
        while until is not None and not ends_clause(text, until) and text.word(until) != "until":
            until += 1
        if first is None or until is None or not text.phrase_end(_TOLD, until):
            return None
        complements, _ = read_complements(text, first)
        complements = [c for c in complements if not c.phrases or c.phrase.start < until]
        return self.framed("wait", at, first, complements, content_end(text, until))

    def _arrived(self, at: int) -> Reading | None:
        """*When you are in the lab*, look for the pencil: first go there."""
        text = self.text
        start = text.phrase_end(_ARRIVED, at)
        if start is None:
            return None
        complements, end = read_complements(text, start)
        there = complements[0] if len(complements) == 1 and complements[0].phrases else None
        if there is None or there.role not in ("at", "to", "into", "") or not there.phrase.is_spot:
            return None
        place = to_place(there.phrase, self.scope)
        return [GoTo(place=place)], end + (text.word(end) == COMMA)

    def _later(self, at: int) -> Reading | None:
        """In twenty seconds, ...; give it five seconds."""
        text = self.text
        if text.word(at) == "for":
            amount = measure(text.words, at + 1)
            start = amount.end + (text.word(amount.end) == COMMA) if amount else at
            timed = amount and amount.kind == "time" and verbs_at(text.words, start)
            return self.verb(start, [Complement(measure=amount)]) if timed else None
        start = at + 1 if text.word(at) in _IN_A_WHILE else text.phrase_end(_GIVE_IT, at)
        amount = measure(text.words, start) if start else None
        if amount is None or amount.kind != "time":
            return None
        goes_on = text.word(at) in _IN_A_WHILE
        if goes_on and amount.end >= len(text):
            return None
        end = amount.end + (goes_on and text.word(amount.end) == COMMA)
        return [Wait(duration_s=amount.value)], end

    def _to_and_fro(self, at: int) -> Reading | None:
        """Patrol between the table and the shelf three times."""
        text = self.text
        start = text.phrase_end(_TO_AND_FRO, at)
        one = noun_phrase(text, start) if start else None
        other = noun_phrase(text, one.end + 1) if one and text.word(one.end) == "and" else None
        if one is None or other is None:
            return None
        there = tuple(GoTo(place=to_place(phrase, self.scope)) for phrase in (one, other))
        often = measure(text.words, other.end)
        if often is None or often.kind != "times":
            raise Unclear("How many times shall I go to and fro?")
        return [Repeat(times=int(often.value), goals=there)], often.end

    def _tidied(self, at: int) -> Reading | None:
        """Tidy up by putting everything on the shelf."""
        start = self.text.phrase_end(_TIDIES, at)
        return self.verb(start) if start else None

    def _whether(self, at: int) -> Reading | None:
        """Look whether the ball is behind the box."""
        start = self.text.phrase_end(_LOOKS, at)
        return (
            self.question(start) if start and self.text.word(start) in ("if", "whether") else None
        )
