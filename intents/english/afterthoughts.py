"""What is said after a clause and changes it: a correction, a condition, how often, in which order.

"The red cup, no wait, the blue one"; "... if it is there"; "..., four times"; "... after that".
"""

from abc import ABC, abstractmethod

from msgspec.structs import replace

from intents.english import lexicon
from intents.english.complements import Complement, ends_clause
from intents.english.conditions import IF, condition
from intents.english.constructions import Constructions
from intents.english.corrections import correction_end, substitute
from intents.english.frames.devices import device_names
from intents.english.lexer import COMMA, FULL_STOP
from intents.english.measures import measure
from intents.english.noun_phrases import noun_phrase
from intents.english.phrase import NounPhrase
from intents.english.questions import Reading
from intents.english.referents import is_person, to_object, to_person, to_place
from intents.english.remarks import asks_end
from intents.english.trouble import Misfit, ReadingError
from intents.english.verbs import verbs_at
from intents.goals import (
    Answer,
    Bring,
    Close,
    Condition,
    Find,
    Follow,
    Give,
    Goal,
    GoTo,
    Greet,
    Guide,
    If,
    LookAt,
    Meet,
    Open,
    Pick,
    Place,
    Present,
    Repeat,
    Switch,
)

OVER = lexicon.phrases("over,in a row,in total,altogether,in all,each")
"""What may follow "three times" and adds nothing."""
_TOO = lexicon.phrases("too,also,as well,likewise")
_MORE = lexicon.phrases("more,a bit more,a little more,some more,further,a bit further,again more")
_LINKING = ("and", "also", "then", "plus", "next", "about")
_WHEN = lexicon.phrases("when,once,as soon as,whenever")
_OPENINGS = ("sorry", "oh", "wait")


class Afterthoughts(Constructions, ABC):
    """Reads what changes the goals of the clause before it."""

    @abstractmethod
    def clause(self, at: int, before: list[Goal]) -> Reading:
        """One clause, by the first kind of reading that succeeds."""

    @abstractmethod
    def sequence(self, at: int, *, nested: bool) -> Reading:
        """Clauses one after the other; if nested only up to a full stop or "otherwise"."""

    def change_of_last(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """What is said after a clause to change it: a correction, a condition, an order."""
        return (
            self._correction(at, last)
            or self._trailing(at, last)
            or self._after(at, last)
            or self._so_often(at, last)
            or self._who_asks(at, last)
        )

    def taken_back(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """The red cup, *no the blue one*: looked for before "no" is passed over as an opening."""
        while self.text.word(at) in (COMMA, FULL_STOP) and at < len(self.text):
            at += 1
        end = correction_end(self.text, at)
        if end is None or not last:
            return None
        begins = at == 0  # it takes back what was said before, if it is no command of its own
        plain = self.text.word(end - 1) != COMMA and end < at + 2  # no cup there?
        if begins and (verbs_at(self.text.words, end) or (plain and self.text.word(end) != "the")):
            return None
        new_sentence = self.text.word(at - 1) == FULL_STOP and self.text.word(at) in _OPENINGS
        return (
            None if new_sentence and verbs_at(self.text.words, end) else self._correction(at, last)
        )

    def _who_asks(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """Find someone *who has got a question*."""
        relative = self.text.word(at) in ("who", "that", "whose", "with")
        end = asks_end(self.text, at) if relative else None
        found = last[-1] if last else None
        if end is None or not isinstance(found, Find) or found.person is None:
            return None
        return [*last[:-1], Answer(what="question", person=found.person)], end

    def _so_often(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """Stand on one leg for three seconds, *four times*."""
        amount = measure(self.text.words, at)
        if amount is None or amount.kind != "times" or not last:
            return None
        end = self.text.phrase_end(OVER, amount.end) or amount.end
        if end < len(self.text) and self.text.word(end) != FULL_STOP:
            return None
        return [Repeat(times=int(amount.value), goals=tuple(last))], end

    def _after(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """Go to the shelf *after picking up the cup*; follow her *before coming back*."""
        word = self.text.word(at)
        if word not in ("after", "before") or not self.begins_clause(at + 1):
            return None
        other, end = self.clause(self.skip(at + 1), [])
        return ([*other, *last] if word == "after" else [*last, *other]), end

    def _trailing(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """Bring the mug *if the cup is not there*."""
        start = self.text.phrase_end(IF, at)
        if start is None or self.text.word(at - 1) == FULL_STOP:
            return None
        try:
            holds, end = condition(self.text, start, self.scope)
        except ReadingError:
            return None
        soon = self.as_soon_as(at, holds)
        if soon and (end >= len(self.text) or self.text.word(end) == FULL_STOP):
            return [soon, *last], end
        unless = self.text.word(at) == "unless"
        comma = self.text.word(end) == COMMA and end < len(self.text)
        otherwise = self.text.phrase_end(lexicon.ELSE, end + comma)
        if otherwise and not unless:
            other, end = self.sequence(otherwise, nested=True)
            return [If(condition=holds, then=tuple(last), else_=tuple(other))], end
        if end < len(self.text) and self.text.word(end) != FULL_STOP:
            return None
        return [_if(holds, last, unless=unless)], end

    def _correction(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """No wait, the blue one; I mean go to the kitchen."""
        end = correction_end(self.text, at) or self._told_apart(at)
        if end is None:
            return None
        if verbs_at(self.text.words, end):
            return self.clause(end, [])
        phrase = noun_phrase(self.text, end) or self._after_preposition(end)
        if phrase is None:
            return None
        scope = self.scope
        old = scope.person if is_person(phrase, scope) else scope.object
        if phrase.is_spot:
            old, new = scope.place, to_place(phrase, scope)
        elif is_person(phrase, scope):
            new = to_person(phrase, scope)
        else:
            new = to_object(phrase, scope)
        if old is None:
            raise Misfit("I do not know what to correct")
        scope.mention(new)
        return [substitute(g, old, new) for g in last], phrase.end

    def as_soon_as(self, at: int, holds: Condition) -> Find | None:
        """When you find a guest, ...: first find one."""
        end = self.text.phrase_end(_WHEN, at)
        when = end is not None and self.text.word(end) == "you"
        if not when or not isinstance(holds, Present) or holds.negated:
            return None
        return Find(object=holds.object, person=holds.person)

    def likewise(self, at: int, before: list[Goal]) -> Reading | None:
        """Put the cup on the shelf, *and the plate too*: the same with another."""
        text = self.text
        phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
        end = text.phrase_end(_TOO, phrase.end) if phrase else None
        if phrase is None or end is None or not before or not ends_clause(text, end):
            return None
        found = self._with_another(before[-1], phrase)
        return (found, end) if found else None

    def follow_up(self, at: int, history: tuple[Goal, ...]) -> Reading | None:
        """*And the plate on the table*, *the other one*, *a bit more*: the last goal anew."""
        text, last = self.text, history[-1] if history else None
        if last is None or verbs_at(text.words, at):
            return None
        more = text.phrase_end(_MORE, at)
        if more is not None and more == len(text) and isinstance(last, GoTo) and last.by:
            again: list[Goal] = [last]
            return again, more
        phrase = noun_phrase(text, at)
        linked = at > 0 and text.word(at - 1) in _LINKING
        if phrase is None or phrase.end < len(text) or not (linked or phrase.other):
            return None
        if isinstance(last, Place) and phrase.places:
            return self.framed("put", at, at + 1, [Complement(phrases=[phrase])], phrase.end)
        found = self._with_another(last, phrase)
        return (found, phrase.end) if found else None

    def _with_another(self, last: Goal, phrase: NounPhrase) -> list[Goal]:
        """A goal with another thing, device or person; none if it has nothing of the kind."""
        if isinstance(last, Open | Close | Switch):
            act = "switch" if isinstance(last, Switch) else "open"
            names = device_names(Complement(phrases=[phrase]), self.scope, act)
            return [replace(last, what=name) for name in names]
        if is_person(phrase, self.scope):
            person = to_person(phrase, self.scope)
            alike = isinstance(last, Find | Follow | Greet | Guide | Meet)
            return [replace(last, person=person)] if alike else []
        if isinstance(last, Pick | Place | Bring | Give | Find | LookAt):
            return [replace(last, object=to_object(phrase, self.scope))]
        return []

    def _after_preposition(self, at: int) -> NounPhrase | None:
        """No, *on the table*: the place, if it is one."""
        located = self.text.lookup(lexicon.LOCATIVES, at)
        start = located[1] if located else self.text.phrase_end(lexicon.GOALWARDS, at)
        phrase = noun_phrase(self.text, start) if start else None
        return phrase if phrase and phrase.is_spot else None

    def _told_apart(self, at: int) -> int | None:
        """Where *the blue one* begins that tells which cup was meant a sentence before."""
        text, old = self.text, self.scope.object
        if old is None or text.word(at - 1) not in (COMMA, FULL_STOP) or old.count not in (None, 1):
            return None
        phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
        if phrase is None or phrase.noun != "one":
            return None
        closed = phrase.end >= len(text) or text.word(phrase.end) == FULL_STOP
        told = (phrase.color and not old.color) or (phrase.size and not old.size)
        return at if closed and (told or (phrase.superlative and not old.superlative)) else None

    def begins_clause(self, at: int) -> bool:
        """Whether "you go" or "going" begins at a word."""
        word = self.text.word(at)
        return word in ("you", "that") or (word.endswith("ing") and bool(self.skip(at) >= at))


def _if(holds: Condition, goals: list[Goal], *, unless: bool) -> If:
    if unless:
        return If(condition=holds, else_=tuple(goals))
    return If(condition=holds, then=tuple(goals))
