"""The grammar: a sentence becomes goals, deterministically and offline.

A sentence is a sequence of clauses; a clause is a verb with its complements, a question, a
statement ("there is a cup on the table") or a condition with clauses of its own. A verb may have
several senses; the first one whose frame accepts the complements is the one that was meant.
"""

from intents.english import lexicon
from intents.english.clauses import Clause, Complement, connector_end, ends_clause, read_complements
from intents.english.conditions import condition
from intents.english.corrections import correction_end, substitute
from intents.english.frames import FRAMES
from intents.english.lexer import COMMA, FULL_STOP
from intents.english.measures import measure
from intents.english.noun_phrases import NounPhrase, noun_phrase
from intents.english.postmodifiers import is_spot, read_postmodifiers
from intents.english.questions import Reading, about_robot, question
from intents.english.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.speech import answer, describe, inform, say, tell
from intents.english.text import Text
from intents.english.trouble import Misfit, NotUnderstood, ReadingError, Unclear
from intents.english.verbs import verbs_at
from intents.goals import (
    Bring,
    Condition,
    Count,
    Find,
    ForEach,
    Give,
    Goal,
    GoTo,
    Holding,
    If,
    ObjectQuery,
    Pick,
    Repeat,
    State,
    Tell,
)

_ELSE = lexicon.phrases("else,otherwise,or else,if not,if not so,in the other case,if that fails")
_IF = lexicon.phrases("if,in case,when,whenever,unless,only if,as long as,provided that")
_EACH = lexicon.phrases("for each,for every,for all,for each of,for all of,for each one of")
_SPEECH = {"say": say, "tell": tell, "inform": inform, "describe": describe, "answer": answer}


class Grammar:
    """Reads one sentence.

    Attributes:
        scope: What pronouns stand for; goes on from what was said before.
        history: The goals of the sentence before, for "do it again".
    """

    def __init__(self, text: Text, scope: Scope, history: tuple[Goal, ...] = ()) -> None:
        self.text = text
        self.scope = scope
        self.history = history
        self._wanted = False

    def read(self) -> list[Goal]:
        """The goals of the whole sentence.

        Raises:
            ReadingError: Some of it makes no sense; the error says which part and why.
        """
        goals, end = self._sequence(0, nested=False)
        if end < len(self.text):
            raise self._not_understood(end)
        return goals

    def _sequence(self, at: int, *, nested: bool) -> tuple[list[Goal], int]:
        """Clauses one after the other; if nested only up to a full stop or "otherwise"."""
        goals: list[Goal] = []
        last = 0
        while True:
            if nested and goals and self._ends_nested(at):
                return goals, at
            at = self._skip(at)
            if at >= len(self.text) or (nested and self.text.phrase_end(_ELSE, at)):
                return goals, at
            corrected = self._correction(at, goals[last:]) if goals else None
            if corrected:
                goals[last:], at = corrected
                continue
            trailing = self._trailing_condition(at) if goals else None
            if trailing:
                goals[last:] = [_conditional(trailing[0], goals[last:], negate=trailing[2])]
                at = trailing[1]
                continue
            wanted = goals[-1:] if self._wanted else []
            self._wanted = False
            found, end = self._clause(at, goals)
            if wanted and _same_object(wanted[0], found[:1]):
                goals.pop()
            if goals and found and _already_sought(goals[-1], found[0]):
                goals.pop()
            last = len(goals)
            goals += found
            self._remember(found)
            at = max(end, at + 1)

    def _ends_nested(self, at: int) -> bool:
        if self.text.word(at) == FULL_STOP:
            return True
        return bool(self.text.phrase_end(_ELSE, at + (self.text.word(at) == COMMA)))

    def _skip(self, at: int) -> int:
        """Past connectors, signs and openings like "could you"."""
        text = self.text
        while at < len(text):
            if text.word(at) in (COMMA, FULL_STOP):
                at += 1
                continue
            verb = verbs_at(text.words, at)
            if self._sets_out(at):
                at += 1
                continue
            opening = text.phrase_end(lexicon.OPENERS, at)
            end = max(connector_end(text, at) or 0, opening or 0)
            if not end or about_robot(text, at) or (verb and verb[0][1] > end):
                return at
            opens_verb = verbs_at(text.words, end) or text.phrase_end(lexicon.OPENERS, end)
            if text.word(at) in ("to", "there", "you", "next") and not opens_verb:
                return at
            named = text.name_at(at)
            if text.phrase_end(_ELSE, at) or (named and named.end >= end):
                return at
            at = end
        return at

    def _sets_out(self, at: int) -> bool:
        """Go *get the cup*: the walk goes without saying."""
        text = self.text
        if text.word(at) not in ("go", "come", "run", "hurry"):
            return False
        whole = verbs_at(text.words, at)[0][1] > at + 1
        after = connector_end(text, at + 1) or at + 1
        goes_somewhere = text.lookup(lexicon.LOCATIVES, at + 1) or text.word(after) == "go"
        return not whole and not goes_somewhere and bool(verbs_at(text.words, after))

    def _clause(self, at: int, before: list[Goal]) -> Reading:
        """One clause, by the first kind of reading that succeeds.

        Raises:
            ReadingError: None does; the most telling of their errors.
        """
        errors: list[ReadingError] = []
        for reading in (self._mission, self._conditional, self._for_each, self._times,
                        self._question, self._verb, self._fronted, self._statement):  # fmt: skip
            try:
                found = reading(at, before)
            except ReadingError as error:
                errors.append(error)
                continue
            if found:
                return found
        if errors:
            raise max(errors, key=lambda e: e.weight)
        raise self._not_understood(at)

    def _not_understood(self, at: int) -> NotUnderstood:
        end = at + 1
        while end < len(self.text) and not ends_clause(self.text, end):
            end += 1
        return NotUnderstood(f"I do not understand “{self.text.raw(at, end)}”")

    def _mission(self, at: int, before: list[Goal]) -> Reading | None:
        del before
        return about_robot(self.text, at)

    def _question(self, at: int, before: list[Goal]) -> Reading | None:
        del before
        return question(self.text, at, self.scope)

    def _verb(
        self, at: int, before: list[Goal], fronted: list[Complement] | None = None
    ) -> Reading:
        """A verb and its complements, in the first sense that fits.

        Raises:
            ReadingError: None fits.
        """
        errors: list[ReadingError] = []
        loose: Reading | None = None
        for sense, first in verbs_at(self.text.words, at):
            try:
                reading = self._in_sense(sense, at, first, fronted or [], before)
            except ReadingError as error:
                errors.append(error)
                continue
            if self._goes_on(reading[1]):
                return reading
            loose = loose or reading
        if loose:
            return loose
        if errors:
            raise max(errors, key=lambda e: e.weight)
        raise self._not_understood(at)

    def _in_sense(
        self, sense: str, at: int, first: int, fronted: list[Complement], before: list[Goal]
    ) -> Reading:
        text, scope = self.text, self.scope
        if sense in _SPEECH:
            goals, end = _SPEECH[sense](text, first, scope)
            places = [to_place(c.phrase, scope) for c in fronted if c.role == "at"]
            return [*(GoTo(place=p) for p in places), *goals], end
        if sense == "count":
            return self._count(first)
        if sense == "repeat":
            return self._repeat(first, before)
        complements, end = read_complements(text, first)
        if sense == "stop":
            while end < len(text) and text.word(end) not in (FULL_STOP, COMMA):
                end += 1
        verb = " ".join(text.words[at:first])
        clause = Clause(text, sense, verb, first, end, complements + fronted)
        goals = FRAMES[sense](clause, scope)
        self._wanted = sense == "want"
        times = clause.measure("times")
        if times and times > 1:
            return [Repeat(times=int(times), goals=tuple(goals))], end
        return goals, end

    def _goes_on(self, at: int) -> bool:
        """Whether a clause may well end here."""
        text = self.text
        if ends_clause(text, at) or verbs_at(text.words, at):
            return True
        starts = text.word(at) in lexicon.PRONOUNS | {"to", "if", "unless", "you", "how", "what"}
        return starts or bool(text.phrase_end(lexicon.OPENERS, at))

    def _count(self, at: int) -> Reading:
        """Count the cups on the table."""
        for skipped in ("how", "many", "the", "number", "amount", "of"):
            at += self.text.word(at) == skipped
        phrase = noun_phrase(self.text, at)
        if phrase is None:
            raise Unclear("What shall I count?")
        if is_person(phrase, self.scope):
            return [Count(person=to_person(phrase, self.scope))], phrase.end
        return [Count(object=to_object(phrase, self.scope))], phrase.end

    def _repeat(self, at: int, before: list[Goal]) -> Reading:
        """Do it again; repeat that three times; repeat twice: ..."""
        text = self.text
        at += text.word(at) in ("it", "that", "this", "all", "everything")
        amount = measure(text.words, at)
        times = int(amount.value) if amount and amount.kind == "times" else 1
        at = amount.end if amount and amount.kind == "times" else at
        after = at + (text.word(at) == COMMA)
        if not before and after < len(text) and verbs_at(text.words, after):
            goals, end = self._sequence(after, nested=True)
            return [Repeat(times=times, goals=tuple(goals))], end
        again = list(before or self.history)
        if not again:
            raise Unclear("What shall I repeat?")
        if times > 1:
            return [Repeat(times=times, goals=tuple(again))], at
        return list(again), at

    def _times(self, at: int, before: list[Goal]) -> Reading | None:
        """Three times, walk around the table."""
        del before
        amount = measure(self.text.words, at)
        if amount is None or amount.kind != "times":
            return None
        goals, end = self._sequence(amount.end, nested=True)
        return ([Repeat(times=int(amount.value), goals=tuple(goals))], end) if goals else None

    def _for_each(self, at: int, before: list[Goal]) -> Reading | None:
        """For each cup on the table, bring it to me."""
        del before
        start = self.text.phrase_end(_EACH, at)
        phrase = noun_phrase(self.text, start) if start else None
        if phrase is None:
            return None
        query = to_object(phrase, self.scope)
        self.scope.mention(ObjectQuery(held=True))
        kept, self.scope.object = self.scope.object, None
        goals, end = self._sequence(phrase.end, nested=True)
        self.scope.object = kept
        if not goals:
            raise Unclear("What shall I do with each of them?")
        return [ForEach(object=query, goals=tuple(goals))], end

    def _conditional(self, at: int, before: list[Goal]) -> Reading | None:
        """If the cup is not there, bring the mug, otherwise wait."""
        del before
        start = self.text.phrase_end(_IF, at)
        if start is None:
            return None
        holds, end = condition(self.text, start, self.scope)
        if isinstance(holds, State | Holding):
            pass
        elif holds.object or holds.person:
            self.scope.mention(holds.object or holds.person)
        end += self.text.word(end) == COMMA
        end += self.text.word(end) == "then"
        then, end = self._sequence(end, nested=True)
        if not then:
            raise Unclear("What shall I do then?")
        skipped = end
        while self.text.word(skipped) in (COMMA, FULL_STOP) and skipped < len(self.text):
            skipped += 1
        otherwise = self.text.phrase_end(_ELSE, skipped)
        other: list[Goal] = []
        if otherwise:
            other, end = self._sequence(otherwise, nested=True)
        if self.text.word(at) == "unless":
            then, other = other, then
        return [If(condition=holds, then=tuple(then), else_=tuple(other))], end

    def _trailing_condition(self, at: int) -> tuple[Condition, int, bool] | None:
        """Bring the mug if the cup is not there."""
        start = self.text.phrase_end(_IF, at)
        if start is None or self.text.word(at - 1) == FULL_STOP:
            return None
        try:
            holds, end = condition(self.text, start, self.scope)
        except ReadingError:
            return None
        full = end >= len(self.text) or self.text.word(end) == FULL_STOP
        return (holds, end, self.text.word(at) == "unless") if full else None

    def _fronted(self, at: int, before: list[Goal]) -> Reading | None:
        """At the desk, find the cup; the red cup, bring it to me."""
        complements, end = read_complements(self.text, at)
        after = self._skip(end)
        usable = bool(complements) and all(
            c.phrases and c.role in ("", "at", "from", "into", "to") for c in complements
        )
        if not usable:
            return None
        asked = question(self.text, after, self.scope)
        if asked and complements[0].role == "at":
            at_place = to_place(complements[0].phrase, self.scope)
            return [GoTo(place=at_place), *asked[0]], asked[1]
        if not verbs_at(self.text.words, after):
            return None
        for complement in complements:
            if complement.role == "":
                for phrase in complement.phrases:
                    self._mention_phrase(phrase)
        return self._verb(after, before, [c for c in complements if c.role])

    def _mention_phrase(self, phrase: NounPhrase) -> None:
        if is_spot(phrase):
            self.scope.mention(to_place(phrase, self.scope))
            return
        what = (to_person if is_person(phrase, self.scope) else to_object)(phrase, self.scope)
        self.scope.mention(what.at)
        self.scope.mention(what)

    def _statement(self, at: int, before: list[Goal]) -> Reading | None:
        """There is a cup on the table; she is in the kitchen: no goals, but pronouns refer."""
        text, scope = self.text, self.scope
        if text.word(at) == "there" and text.word(at + 1) in ("is", "are"):
            phrase = noun_phrase(text, at + 2)
            if phrase is None:
                return None
            self._mention_phrase(phrase)
            return [], phrase.end
        phrase = noun_phrase(text, at)
        if phrase is None or text.word(phrase.end) not in ("is", "are", "should"):
            return None
        old = scope.person if is_person(phrase, scope) else scope.object
        phrase.end += 1 + (text.word(phrase.end + 1) == "be")
        start = phrase.end
        read_postmodifiers(text, phrase)
        if phrase.end == start:
            return None
        self._mention_phrase(phrase)
        new = scope.person if is_person(phrase, scope) else scope.object
        if old is not None and new is not None and phrase.noun == "pronoun":
            before[:] = [substitute(g, old, new) for g in before]
        return [], phrase.end

    def _correction(self, at: int, last: list[Goal]) -> tuple[list[Goal], int] | None:
        """No wait, the blue one; I mean go to the kitchen."""
        end = correction_end(self.text, at)
        if end is None:
            return None
        if verbs_at(self.text.words, end):
            return self._clause(end, [])
        phrase = noun_phrase(self.text, end)
        if phrase is None:
            return None
        scope = self.scope
        old = scope.person if is_person(phrase, scope) else scope.object
        new = None
        if is_spot(phrase):
            old, new = scope.place, to_place(phrase, scope)
        elif is_person(phrase, scope):
            new = to_person(phrase, scope)
        else:
            new = to_object(phrase, scope)
        if old is None:
            raise Misfit("I do not know what to correct")
        scope.mention(new)
        return [substitute(g, old, new) for g in last], phrase.end

    def _remember(self, goals: list[Goal]) -> None:
        """Let pronouns refer to what the goals speak of."""
        for goal in goals:
            self.scope.mention_goal(goal)


def _same_object(wanted: Goal, found: list[Goal]) -> bool:
    """I want the chips, can you bring them: one wish, said twice."""
    if not found or not isinstance(found[0], Bring | Pick | Find | Give):
        return False
    one, other = wanted.object if isinstance(wanted, Bring) else None, found[0].object
    return one is not None and other is not None and one.name == other.name


def _already_sought(before: Goal, goal: Goal) -> bool:
    """Find the largest things and tell me what they are: telling finds them."""
    if not (isinstance(before, Find | Tell) and isinstance(goal, Tell)):
        return False
    return goal.property == "name" and goal.object is not None and goal.object == before.object


def _conditional(holds: Condition, goals: list[Goal], *, negate: bool) -> If:
    if negate:
        return If(condition=holds, else_=tuple(goals))
    return If(condition=holds, then=tuple(goals))
