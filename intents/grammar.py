"""The grammar: a sentence becomes goals, deterministically and offline.

A sentence is a sequence of clauses; a clause is a verb with its complements, a question, a
statement ("there is a cup on the table") or a condition with clauses of its own. A verb may have
several senses; the first one whose frame accepts the complements is the one that was meant.
"""

import re

from intents.english import lexicon
from intents.english.afterthoughts import OVER, Afterthoughts
from intents.english.complements import connector_end
from intents.english.conditions import IF, condition
from intents.english.corrections import substitute
from intents.english.joining import as_wished, joined, or_else, same_object
from intents.english.lexer import COMMA, FULL_STOP
from intents.english.measures import measure
from intents.english.noun_phrases import noun_phrase
from intents.english.questions import Reading
from intents.english.referents import ME, Scope, to_object
from intents.english.self_talk import about_robot
from intents.english.text import Text
from intents.english.trouble import Misfit, NotUnderstood, Partly, ReadingError, Unclear
from intents.english.verbs import verbs_at
from intents.goals import (
    Bring,
    Cancel,
    ForEach,
    Give,
    Goal,
    GoTo,
    Greet,
    Holding,
    If,
    ObjectQuery,
    Pause,
    Person,
    Pick,
    Place,
    Present,
    Repeat,
    Resume,
    Stop,
)
from intents.risks import each

_EACH = lexicon.phrases("for each,for every,for all,for each of,for all of,for each one of")
_HELLO = lexicon.phrases(
    "hello,hi,hey,good morning,good evening,good afternoon,hello there,hi there"
)
_NAMED_HAND = re.compile(r"\b(with|using|use|in) (your|the) (left|right) (hand|arm|gripper)\b")
_DANGLING = lexicon.words("to into onto from with towards the a an of")
"""Words that no command ends with."""
_DEEPEST = 4


class Grammar(Afterthoughts):
    """Reads one sentence.

    Attributes:
        history: The goals of the sentence before, for "do it again".
        trace: Each clause as it was said, with what it was read as by itself.
    """

    def __init__(self, text: Text, scope: Scope, history: tuple[Goal, ...] = ()) -> None:
        super().__init__(text, scope)
        self.history = history
        self.trace: list[tuple[str, tuple[Goal, ...]]] = []
        self._depth = 0
        self._one_hand = False

    def read(self) -> list[Goal]:
        """The goals of the whole sentence.

        Raises:
            ReadingError: Some of it makes no sense; the error says which part and why.
        """
        if self.text.phrase_end(_HELLO, 0) == len(self.text):
            return [Greet(person=ME)]
        for at in range(1, len(self.text)):
            if self.text.word(at) == "myself" and self.text.word(at - 1) not in ("for", "to"):
                raise NotUnderstood("That is for you to do, as I hear it")
        goals, end = self.sequence(0, nested=False)
        if self.text.word(len(self.text) - 1) in _DANGLING and _acts(goals[-1:]):
            raise Unclear(f"“... {self.text.word(len(self.text) - 1)}” what?")
        if end < len(self.text):
            raise self.not_understood(end)
        if self._one_hand:
            raise Partly("I choose the hand myself", tuple(goals))
        return goals

    def sequence(self, at: int, *, nested: bool) -> tuple[list[Goal], int]:
        """Clauses one after the other; if nested only up to a full stop or "otherwise"."""
        self._depth += nested
        try:
            if self._depth > _DEEPEST:
                raise NotUnderstood("There are too many conditions in one another")
            return self._clauses(at, nested=nested)
        finally:
            self._depth -= nested

    def _clauses(self, at: int, *, nested: bool) -> tuple[list[Goal], int]:
        goals: list[Goal] = []
        last = 0
        while True:
            if nested and goals and self._ends_nested(at):
                return goals, at
            begun, at = at, self.skip(at)
            taken_back = self.taken_back(begun, goals[last:] if begun else list(self.history))
            if taken_back:
                goals[last:], at = taken_back
                continue
            if at >= len(self.text) or (nested and self.text.phrase_end(lexicon.ELSE, at)):
                return goals, at
            changed = self.change_of_last(at, goals[last:]) if goals else None
            if changed:
                goals[last:], at = changed
                continue
            wish = goals[-1:] if self.wanted else []
            self.wanted = False
            found, end = self._one_more(at, goals)
            self._one_hand |= _names_hand(self.text.raw(begun, end), tuple(found))
            if not self._depth:
                self.trace.append((self.text.raw(at, end), tuple(found)))
            if wish and same_object(wish[0], found[:1]):
                found[0] = as_wished(found[0], goals.pop())
            if goals and found and "or" in self.text.words[begun:at]:
                found[0] = or_else(goals, found[0])
            if goals and found:
                found[0] = joined(goals, found[0], first=self.text.word(at))
            last = len(goals)
            goals += found if found != goals[-1:] or not _once(found) else []
            if self.scope.parted:
                goals = [substitute(goal, *self.scope.parted) for goal in goals]
                self.scope.parted = None
            for goal in found:
                self.scope.mention_goal(goal)
            at = max(end, at + 1)

    def _one_more(self, at: int, before: list[Goal]) -> Reading:
        """The next clause.

        Raises:
            Partly: It makes no sense, but what stands before it does.
        """
        known = tuple(before)
        try:
            return self.clause(at, before)
        except (NotUnderstood, Misfit) as error:
            if not known or self._depth:
                raise
            raise Partly(str(error), known) from None

    def _ends_nested(self, at: int) -> bool:
        if self.text.word(at) == FULL_STOP:
            return True
        return bool(self.text.phrase_end(lexicon.ELSE, at + (self.text.word(at) == COMMA)))

    def clause(self, at: int, before: list[Goal]) -> Reading:
        """One clause, by the first kind of reading that succeeds.

        Raises:
            ReadingError: None does; the most telling of their errors.
        """
        readings = (
            lambda: about_robot(self.text, at),
            lambda: self._conditional(at),
            lambda: self._for_each(at),
            lambda: self._times(at),
            lambda: self._repeat(at, before),
            lambda: self._before(at),
            lambda: self.remark(at),
            lambda: self.construction(at),
            lambda: self.question(at),
            lambda: self.pose(at),
            lambda: self.asker(at),
            lambda: self.about_thing(at),
            lambda: self._verb(at),
            lambda: self.likewise(at, before or list(self.history)),
            lambda: None if before else self.follow_up(at, self.history),
            lambda: self.gapped(at) if self.text.word(at - 1) in ("then", "and") else None,
            lambda: self.fronted(at),
            lambda: self._statement(at, before),
            lambda: self.telegram(at),
            lambda: self.gapped(at),
            lambda: self.told_of(at),
            lambda: self.alone(at),
        )
        errors: list[ReadingError] = []
        for reading in readings:
            try:
                found = reading()
            except ReadingError as error:
                errors.append(error)
                continue
            if found:
                return found
        worst = max(errors, key=lambda e: e.weight, default=None)
        if worst is None or (isinstance(worst, Misfit) and str(worst).endswith("?")):
            raise self.not_understood(at)
        raise worst

    def _verb(self, at: int) -> Reading:
        """A verb with its complements; "meet and greet Ada" shares one."""
        try:
            return self.verb(at)
        except Unclear:
            first = verbs_at(self.text.words, at)[0][1]
            after = connector_end(self.text, first)
            if after is None or not verbs_at(self.text.words, after):
                raise
            for goal in self.clause(after, [])[0]:
                self.scope.mention_goal(goal)
            return self.verb(at)

    def _repeat(self, at: int, before: list[Goal]) -> Reading | None:
        """Do it again; repeat that three times; repeat twice: ..."""
        text = self.text
        verb = next((end for sense, end in verbs_at(text.words, at) if sense == "repeat"), None)
        if verb is None:
            return None
        at = verb + (text.word(verb) in ("it", "that", "this", "all", "everything"))
        amount = measure(text.words, at)
        times = int(amount.value) if amount and amount.kind == "times" else 1
        at = amount.end if amount and amount.kind == "times" else at
        after = at + (text.word(at) == COMMA)
        if not before and after < len(text) and verbs_at(text.words, after):
            goals, end = self.sequence(after, nested=True)
            return [Repeat(times=times, goals=tuple(goals))], end
        if text.words[verb - 2 : verb] in (["do", "it"], ["do", "that"]) and amount is None:
            return None
        again = list(before or self.history)
        if not again:
            raise Unclear("What shall I repeat?")
        if text.words[verb - 2] == "do" or text.words[verb - 1] in ("thing", "so"):
            before.clear()  # wave, and do that three times: three times in all
        if times > 1:
            return [Repeat(times=times, goals=tuple(again))], at
        return list(again), at

    def _times(self, at: int) -> Reading | None:
        """Three times, walk around the table."""
        amount = measure(self.text.words, at)
        if amount is None or amount.kind != "times" or self.begins_clause(amount.end):
            return None
        start = self.text.phrase_end(OVER, amount.end) or amount.end
        goals, end = self.sequence(start, nested=True)
        return ([Repeat(times=int(amount.value), goals=tuple(goals))], end) if goals else None

    def _for_each(self, at: int) -> Reading | None:
        """For each cup on the table, bring it to me."""
        start = self.text.phrase_end(_EACH, at)
        phrase = noun_phrase(self.text, start) if start else None
        if phrase is None:
            return None
        query = to_object(phrase, self.scope)
        kept, self.scope.object = self.scope.object, None
        goals, end = self.sequence(phrase.end, nested=True)
        self.scope.object = kept
        if not goals:
            raise Unclear("What shall I do with each of them?")
        return [ForEach(object=query, goals=tuple(goals))], end

    def _conditional(self, at: int) -> Reading | None:
        """If the cup is not there, bring the mug, otherwise wait."""
        start = self.text.phrase_end(IF, at)
        if start is None and self.text.word(at) == "should" and self.text.word(at + 1) != "you":
            start = at + 1
        if start is None:
            return None
        holds, end = condition(self.text, start, self.scope)
        soon = self.as_soon_as(at, holds)
        if soon:
            return [soon], end + (self.text.word(end) == COMMA)
        if isinstance(holds, Present):
            self.scope.mention(holds.object or holds.person)
            self.scope.mention((holds.object or holds.person or Person()).at)
        elif isinstance(holds, Holding) and holds.object.name:
            self.scope.mention(holds.object)
        end += self.text.word(end) == COMMA
        end += self.text.word(end) == "then"
        then, end = self.sequence(end, nested=True)
        if not then:
            raise Unclear("What shall I do then?")
        skipped = end
        while self.text.word(skipped) in (COMMA, FULL_STOP) and skipped < len(self.text):
            skipped += 1
        otherwise = self.text.phrase_end(lexicon.ELSE, skipped)
        other: list[Goal] = []
        if otherwise:
            other, end = self.sequence(otherwise, nested=True)
        if self.text.word(at) == "unless":
            then, other = other, then
        return [If(condition=holds, then=tuple(then), else_=tuple(other))], end

    def _before(self, at: int) -> Reading | None:
        """Before you go to the shelf, pick up the cup: the other way round."""
        word = self.text.word(at)
        if word not in ("before", "after", "once", "when") or not self.begins_clause(at + 1):
            return None
        one, end = self.clause(self.skip(at + 1), [])
        for goal in one:
            self.scope.mention_goal(goal)
        other, end = self.clause(self.skip(end), [])
        return ([*other, *one] if word == "before" else [*one, *other]), end

    def _statement(self, at: int, before: list[Goal]) -> Reading | None:
        """She is in the kitchen: what was said of her is true of her there."""
        scope = self.scope
        old: tuple[ObjectQuery | None, Person | None] = (scope.object, scope.person)
        found = self.statement(at)
        if found is None:
            return None
        phrase, end = found
        for was, now in zip(old, (scope.object, scope.person), strict=True):
            if phrase.noun == "pronoun" and was is not None and now is not None:
                before[:] = [substitute(g, was, now) for g in before]
        return [], end


def _acts(goals: list[Goal]) -> bool:
    """Whether something is to be taken or put."""
    return any(isinstance(goal, Bring | Give | GoTo | Pick | Place) for goal in goals)


def _once(goals: list[Goal]) -> bool:
    """Whether goals say no more when they are said twice: never mind, forget it."""
    return all(isinstance(goal, Cancel | Stop | Pause | Resume | Place) for goal in goals)


def _names_hand(said: str, goals: tuple[Goal, ...]) -> bool:
    """Whether a thing is to be handled with one hand and not the other."""
    handles = any(isinstance(goal, (Pick, Place, Bring, Give)) for goal in each(goals))
    return handles and _NAMED_HAND.search(said.lower()) is not None
