"""Single clauses: a verb in one of its senses, a question, a statement, a fronted phrase."""

from intents.english import lexicon
from intents.english.complements import (
    Clause,
    Complement,
    connector_end,
    ends_clause,
    read_complements,
)
from intents.english.frames import FRAMES
from intents.english.lexer import COMMA, FULL_STOP
from intents.english.measures import number
from intents.english.noun_phrases import noun_phrase
from intents.english.questions import Reading, question
from intents.english.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.saying import answer, describe, inform, say, tell
from intents.english.self_talk import about_robot
from intents.english.text import Text
from intents.english.trouble import Misfit, NotUnderstood, ReadingError, Unclear
from intents.english.verbs import verbs_at
from intents.goals import Count, GoTo, Pose2, Repeat

_SPEECH = {"say": say, "tell": tell, "inform": inform, "describe": describe, "answer": answer}
_POSE = lexicon.words("x y position point coordinates coordinate pose location the at and to , yaw")


_SEEN = lexicon.words(
    "a an any the my some anyone anybody someone somebody anything it them him her"
)
_OPENING = lexicon.OPENERS | lexicon.LIGHT_VERBS


def _is_seen(text: Text, at: int) -> bool:
    """Whether "can you see ..." asks after something, and not for it to be seen to the door."""
    named = text.name_at(at)
    return text.word(at) in _SEEN or (
        named is not None and text.word(named.end) not in ("to", "into")
    )


def _numbering_end(text: Text, at: int) -> int | None:
    """*Step 1:* go to the table. *2.* Take the cup."""
    numeral = at + (text.word(at) in ("step", "number", "task"))
    end = numeral + 1
    numbered = text.word(numeral).isdecimal() and text.word(end) in (COMMA, FULL_STOP)
    return end + 1 if numbered and end < len(text) else None


_HANDED = ("bring", "take", "give", "pick", "collect", "want")


def without_favours(sense: str, complements: list[Complement]) -> list[Complement]:
    """Put the cup on the table *for me*: it goes there, and not to whom it is done a favour."""
    if sense in _HANDED and not any(c.role in ("to", "into") for c in complements):
        return complements
    kept: list[Complement] = []
    for one in complements:
        favour = one.role == "for" and one.phrase.noun == "operator"
        places = one.phrase.places if favour else []
        kept += [Complement(role="at", how=p.how, phrases=[p.of]) for p in places] or (
            [] if favour else [one]
        )
    return kept


class Clauses:
    """Reads clauses of one text.

    Attributes:
        scope: What pronouns stand for.
        wanted: The last clause was a wish ("I want the cup"), which the next may spell out.
    """

    def __init__(self, text: Text, scope: Scope) -> None:
        self.text = text
        self.scope = scope
        self.wanted = False
        self._last_verb: tuple[int, int, tuple[str, ...]] | None = None
        self._last_particles: list[Complement] = []

    def skip(self, at: int) -> int:
        """Past connectors, signs and openings like "could you"."""
        text = self.text
        while at < len(text):
            if text.word(at) in (COMMA, FULL_STOP) or self._sets_out(at):
                at += 1
                continue
            numbered = _numbering_end(text, at)
            if numbered:
                at = numbered
                continue
            if text.word(at) == "be" and text.words[at + 3 : at + 4] == ["and"]:
                at += 4
                continue
            if text.words[at + 1 : at + 3] == ["you", "see"] and _is_seen(text, at + 3):
                return at
            verb = verbs_at(text.words, at)
            end = max(connector_end(text, at) or 0, text.phrase_end(lexicon.OPENERS, at) or 0)
            if not end or about_robot(text, at) or (verb and verb[0][1] > end):
                return at
            opens_verb = verbs_at(text.words, end) or text.phrase_end(_OPENING, end)
            opens_verb = opens_verb or text.word(end) in (COMMA, FULL_STOP, "be")
            open_ended = text.word(end - 1) in ("to", "there", "you", "next", "and", "me")
            if open_ended and not connector_end(text, at) and not opens_verb:
                return at
            named = text.name_at(at)
            if text.phrase_end(lexicon.ELSE, at) or (named and named.end >= end):
                return at
            at = end
        return at

    def _sets_out(self, at: int) -> bool:
        """Go *get the cup*: the walk goes without saying."""
        text = self.text
        if text.word(at) in ("start", "begin", "keep") and text.word(at + 1).endswith("ing"):
            longest = max((end for _, end in verbs_at(text.words, at)), default=at + 1)
            return bool(verbs_at(text.words, at + 1)) and longest == at + 1
        if text.word(at) not in ("go", "come", "run", "hurry"):
            return False
        after = connector_end(text, at + 1) or at + 1
        inner = max((end for _, end in verbs_at(text.words, after)), default=after)
        whole = verbs_at(text.words, at)[0][1]
        whole = at + 1 < whole >= inner
        goes_somewhere = text.lookup(lexicon.LOCATIVES, at + 1) or text.word(after) == "go"
        return not whole and not goes_somewhere and bool(verbs_at(text.words, after))

    def not_understood(self, at: int) -> NotUnderstood:
        """The error that quotes what begins at a word."""
        end = at + 1
        while end < len(self.text) and not ends_clause(self.text, end):
            end += 1
        return NotUnderstood(f"I do not understand “{self.text.raw(at, end)}”")

    def question(self, at: int) -> Reading | None:
        """How many cups are there?"""
        return question(self.text, at, self.scope)

    def verb(self, at: int, fronted: list[Complement] | None = None) -> Reading:
        """A verb and its complements, in the first sense that fits.

        Raises:
            ReadingError: None fits.
        """
        senses = [(s, first) for s, first in verbs_at(self.text.words, at) if s != "repeat"]
        reading = self._first_that_fits(senses, at, fronted or [], None)
        if reading is None:
            raise self.not_understood(at)
        self._last_verb = (at, senses[0][1], tuple(sense for sense, _ in senses))
        return reading

    def _first_that_fits(
        self,
        senses: list[tuple[str, int]],
        at: int,
        fronted: list[Complement],
        resumed: int | None,
    ) -> Reading | None:
        errors: list[ReadingError] = []
        loose: Reading | None = None
        for sense, first in senses:
            try:
                reading = self._in_sense(sense, at, first, fronted, resumed)
            except ReadingError as error:
                errors.append(error)
                continue
            if self._goes_on(reading[1]):
                return reading
            loose = loose or reading
        if errors and loose is None:
            raise max(errors, key=lambda e: e.weight)
        return loose

    def _in_sense(
        self, sense: str, at: int, first: int, fronted: list[Complement], resumed: int | None
    ) -> Reading:
        """The verb in one sense; its complements begin elsewhere where a clause is resumed."""
        text, scope = self.text, self.scope
        if sense in _SPEECH:
            goals, end = _SPEECH[sense](text, first if resumed is None else resumed, scope)
            places = [to_place(c.phrase, scope) for c in fronted if c.role == "at"]
            return [*(GoTo(place=p) for p in places), *goals], end
        if sense == "count":
            return self._count(first)
        complements, end = read_complements(text, first if resumed is None else resumed)
        complements = without_favours(sense, complements)
        given_up = sense == "cancel" and text.word(first).endswith("ing")
        if sense == "stop" or given_up:
            complements = []
            while end < len(text) and text.word(end) not in (FULL_STOP, COMMA):
                end += 1
        verb = " ".join(text.words[at:first])
        clause = Clause(text, sense, verb, first, end, complements + fronted)
        goals = FRAMES[sense](clause, scope)
        self.wanted = sense == "want"
        self._last_particles = [c for c in complements if c.particle in ("on", "off", "out")]
        times = clause.measure("times")
        if times and times > 1:
            return [Repeat(times=int(times), goals=tuple(goals))], end
        return goals, end

    def _goes_on(self, at: int) -> bool:
        """Whether a clause may well end here."""
        text = self.text
        if ends_clause(text, at) or verbs_at(text.words, at):
            return True
        starts = lexicon.PRONOUNS | {"to", "if", "unless", "you", "how", "what", "after", "before"}
        return text.word(at) in starts or bool(text.phrase_end(lexicon.OPENERS, at))

    def gapped(self, at: int) -> Reading | None:
        """Put the cup on the table and *the plate on the shelf*: the verb is the one before."""
        if self._last_verb is None:
            return None
        start, first, senses = self._last_verb
        complements, end = read_complements(self.text, at)
        if not any(c.phrases for c in complements) or not self._goes_on(end):
            return None
        kept = [(s, first) for s in senses if s not in _SPEECH and s != "count"]
        return self._first_that_fits(kept, start, list(self._last_particles), at)

    def telegram(self, at: int) -> Reading | None:
        """Red cup to the table."""
        if at > 0 or verbs_at(self.text.words, at):
            return None
        complements, end = read_complements(self.text, at)
        if [c.role for c in complements] not in (["", "to"], ["", "into"]) or end < len(self.text):
            return None
        thing, where = (c.phrases[0] if c.phrases else None for c in complements)
        if not (thing and where and thing.name("object") and where.name("place")):
            return None
        clause = Clause(self.text, "put", "put", at, end, complements)
        return FRAMES["put"](clause, self.scope), end

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

    def pose(self, at: int) -> Reading | None:
        """Go to x = 1, y = 2; go to position -1.5 0.2."""
        senses = verbs_at(self.text.words, at)
        if not any(sense == "go" for sense, _ in senses):
            return None
        end = max(end for sense, end in senses if sense == "go")
        values: list[float] = []
        while len(values) < 2 and end < len(self.text):
            found = number(self.text.words, end)
            if found is None and self.text.word(end) not in _POSE:
                return None
            values += [found.value] if found else []
            end = found.end if found else end + 1
        if len(values) < 2 or not ends_clause(self.text, end):
            return None
        return [GoTo(pose=Pose2(x_m=values[0], y_m=values[1]))], end

    def alone(self, at: int) -> None:
        """A thing is named and nothing is said of it.

        Raises:
            Unclear: That is so.
        """
        phrase = noun_phrase(self.text, at)
        if phrase is None or phrase.end < len(self.text) or phrase.noun != "name":
            return
        if phrase.name("object", "category") and at == 0:
            raise Unclear(f"What shall I do with “{self.text.raw(at, phrase.end)}”?")
        if phrase.is_person:
            raise Misfit("what about them?")
