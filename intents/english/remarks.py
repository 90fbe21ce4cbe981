"""Remarks: statements that tell something rather than ask for it, and the wish behind some of them.

"There is a cup on the table, ..."; "I left my comb on the bench, ..."; "I cannot find my keys";
"Ada needs the stapler"; "I am thirsty, ...".
"""

from msgspec.structs import replace

from intents.english import lexicon
from intents.english.complements import read_complements
from intents.english.lexer import COMMA, FULL_STOP, singular
from intents.english.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrase import NounPhrase
from intents.english.questions import Reading, question
from intents.english.referents import is_person, to_object, to_person, to_place
from intents.english.sentences import Clauses
from intents.english.text import Text
from intents.english.verbs import base_form, verbs_at
from intents.goals import Answer, Bring, Find, Goal, GoTo, Guide, ObjectQuery, Pick, Place

_ASKING = lexicon.words(
    "who that whose wants want would like likes to ask asks asking is has have got a an any some "
    "one question questions for you me with which needs need answer answered answering be "
    "something your will should can must"
)


def asks_end(text: Text, at: int) -> int | None:
    """Where words end that say that somebody has a question to be answered."""
    end, asks = at, False
    while text.word(end) in _ASKING and (end == at or text.word(end) not in ("who", "whose")):
        asks = asks or text.word(end) in ("ask", "asks", "asking", "question", "questions")
        end += 1
    return end if asks else None


_SHORT = 4
"""What is said of somebody in so many words is a remark."""
_IS = lexicon.phrases(
    "is,are,was,were,should be,might be,must be,may be,could be,ought to be,has to be,will be,"
    "would be,used to be,should still be,is supposed to be"
)
_KNOWN = lexicon.phrases(
    "i left,i put,i placed,i forgot,i saw,i dropped,i have left,i have put,i have forgotten,"
    "i have seen,i just saw,i just put,we left,we put,we have left,you left,you put,i keep,we keep,"
    "we have,i have"
)
_LOST = lexicon.phrases(
    "i lost,i have lost,i misplaced,i have misplaced,i can not find,i could not find,"
    "i do not know where,i have no idea where,i do not find,i am missing,we can not find"
)
_NEEDS = lexicon.phrases(
    "needs,wants,would like,would like to have,wants to have,would love,asked for,has asked for,"
    "is asking for,asks for,ordered,has ordered,is waiting for,requested,has requested,requires,"
    "is in need of,could use,fancies"
)
_NEEDS_TO_GO = lexicon.phrases(
    "needs to get,needs to go,wants to go,wants to get,would like to go,would like to get,"
    "has to go,has to get,must go,must get,needs to be brought,needs to be taken,"
    "would like to be brought,would like to be taken,wishes to go,is looking for the way,"
    "wants to be taken,wants to be brought,needs to come,wants to come"
)


def _one_of(goal: Goal, among: ObjectQuery) -> Goal:
    """A goal whose thing is one of those."""
    if not isinstance(goal, Bring | Find | Pick | Place):
        return goal
    one = goal.object or among
    name = one.name or (None if one.category else among.name)
    category = one.category or (None if one.name else among.category)
    return replace(goal, object=replace(one, name=name, category=category, at=one.at or among.at))


class Remarks(Clauses):
    """Reads clauses that state something."""

    def remark(self, at: int) -> Reading | None:
        """The wish behind a statement; no goals where it only tells something."""
        return self._lost(at) or self._told(at) or self._of_somebody(at) or self._feeling(at)

    def _told(self, at: int) -> Reading | None:
        """I left my comb on the bench: it is noted."""
        start = self.text.phrase_end(_KNOWN, at)
        phrase = noun_phrase(self.text, start) if start else None
        if phrase is None or not phrase.name("object", "category"):
            return None
        self._mention_phrase(phrase)
        return [], phrase.end

    def _lost(self, at: int) -> Reading | None:
        """I cannot find my keys: to look for them."""
        text = self.text
        start = text.phrase_end(_LOST, at)
        phrase = noun_phrase(text, start) if start else None
        if phrase is None:
            return None
        end = phrase.end
        end += text.word(end) in ("is", "are") and text.word(phrase.start - 1) == "where"
        end += text.word(end) in ("anywhere", "anymore")
        self.wanted = True
        if is_person(phrase, self.scope):
            return [Find(person=to_person(phrase, self.scope))], end
        return [Find(object=to_object(phrase, self.scope))], end

    def _of_somebody(self, at: int) -> Reading | None:
        """Ada in the lab needs the stapler: to bring it to her; Emil wants to go to the hall."""
        text = self.text
        if verbs_at(text.words, at) and not text.name_at(at):
            return None
        phrase = noun_phrase(text, at)
        if phrase is None or not phrase.is_person or phrase.noun == "operator":
            return None
        going, needing = text.phrase_end(_NEEDS_TO_GO, phrase.end), None
        if going is None:
            needing = text.phrase_end(_NEEDS, phrase.end)
        complements, end = read_complements(text, going or needing or phrase.end)
        if going:
            goal = next((c for c in complements if c.phrases and c.role in ("to", "into")), None)
            if goal is None or len(complements) > 1:
                return None
            self.wanted = True
            there = to_place(goal.phrase, self.scope)
            return [Guide(person=to_person(phrase, self.scope), to=there)], end
        thing = complements[0] if needing and len(complements) == 1 else None
        if thing is None or thing.role or not thing.phrases or thing.phrase.is_person:
            return None
        self.wanted = True
        person = to_person(phrase, self.scope)
        things = [to_object(one, self.scope) for one in thing.phrases]
        return [Bring(object=query, to=person) for query in things], end

    def told_of(self, at: int) -> Reading | None:
        """Ada is thirsty, ...; the door is open, ...: passed over, but they are spoken of now."""
        text = self.text
        phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
        stated = text.phrase_end(_IS, phrase.end) if phrase else None
        if phrase is None or stated is None or phrase.noun in ("operator", "here", "there"):
            return None
        end = stated
        while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
            end += 1
        if end >= len(text) or end - stated > _SHORT:
            return None
        if phrase.noun == "unknown":
            self.scope.device = singular(phrase.said)
        elif phrase.noun == "name":
            self._mention_phrase(phrase)
        return [], end

    def _feeling(self, at: int) -> Reading | None:
        """I am thirsty after all that work, ...: it is passed over, if a command follows."""
        text = self.text
        if text.words[at : at + 2] not in (["i", "am"], ["we", "are"], ["i", "feel"]):
            return None
        end = at + 2
        while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
            phrase = noun_phrase(text, end)
            if phrase and phrase.name("object", "category") and not phrase.is_person:
                self._mention_phrase(phrase)
            end = max(end + 1, phrase.end if phrase else end)
        return ([], end) if at + 2 < end < len(text) else None

    def statement(self, at: int, where: str | None = None) -> tuple[NounPhrase, int] | None:
        """There is a cup on the table; she is in the kitchen: pronouns refer to it from now."""
        text = self.text
        there = text.phrase_end(_IS, at + 1) if text.word(at) == "there" else None
        if there:
            phrase = noun_phrase(text, there)
            if phrase is None:
                return None
            self._mention_phrase(phrase, where)
            return phrase, phrase.end
        phrase = noun_phrase(text, at)
        if phrase is not None and where and text.word(at - 1) in ("is", "are"):
            self._mention_phrase(phrase, where)
            return phrase, phrase.end
        stated = text.phrase_end(_IS, phrase.end) if phrase else None
        if phrase is None or stated is None:
            return None
        phrase.end = stated
        start = phrase.end
        read_postmodifiers(text, phrase)
        if phrase.end == start:
            return None
        self._mention_phrase(phrase, where)
        return phrase, phrase.end

    def asker(self, at: int) -> Reading | None:
        """Ada has a question."""
        phrase = None if verbs_at(self.text.words, at) else noun_phrase(self.text, at)
        if phrase is None or not is_person(phrase, self.scope):
            return None
        end = None if self.text.word(phrase.end) == "to" else asks_end(self.text, phrase.end)
        if end is None:
            return None
        phrase.end = end
        read_postmodifiers(self.text, phrase)
        return [Answer(what="question", person=to_person(phrase, self.scope))], phrase.end

    def fronted(self, at: int) -> Reading | None:
        """At the desk, find the cup; the red cup, bring it to me."""
        if self.text.word(at) in ("of", "among"):
            return self._out_of(at + 1)
        complements, end = read_complements(self.text, at)
        after = self.skip(end)
        usable = bool(complements) and all(
            c.phrases and c.role in ("", "at", "from", "into", "to") for c in complements
        )
        if not usable:
            return None
        if complements[0].role == "at" and self._is_where(after):
            where = to_place(complements[0].phrase, self.scope)
            found = self.statement(after + (self.text.word(after) in ("is", "are")), where)
            return ([], found[1]) if found else None
        asked = question(self.text, after, self.scope)
        if asked and complements[0].role == "at":
            at_place = to_place(complements[0].phrase, self.scope)
            return [GoTo(place=at_place), *asked[0]], asked[1]
        if not verbs_at(self.text.words, after):
            return None
        inflected = self.text.word(after) != base_form(self.text.word(after))
        if inflected and self.text.word(end) != COMMA:
            return None
        for complement in complements:
            if complement.role == "":
                for phrase in complement.phrases:
                    self._mention_phrase(phrase)
        return self.verb(after, [c for c in complements if c.role])

    def _out_of(self, at: int) -> Reading | None:
        """Of *all the cups on the table, bring me the largest one*."""
        phrase = noun_phrase(self.text, at)
        start = self.skip(phrase.end) if phrase else at
        if phrase is None or self.text.word(phrase.end) != COMMA:
            return None
        if phrase.is_person or not verbs_at(self.text.words, start):
            return None
        among = replace(to_object(phrase, self.scope), count=None)
        self.scope.mention(among)
        goals, end = self.verb(start)
        return [_one_of(goal, among) for goal in goals], end

    def _is_where(self, at: int) -> bool:
        """On the table *is a cup*; ... *there is a cup*; ... *a person is standing*."""
        text = self.text
        if text.word(at) in ("is", "are"):
            return True
        if text.word(at) == "there":
            return text.phrase_end(_IS, at + 1) is not None
        phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
        return phrase is not None and text.word(phrase.end) in ("is", "are")

    def _mention_phrase(self, phrase: NounPhrase, where: str | None = None) -> None:
        if phrase.is_spot:
            self.scope.mention(to_place(phrase, self.scope))
            return
        what = (to_person if is_person(phrase, self.scope) else to_object)(phrase, self.scope)
        what = replace(what, at=what.at or where)
        self.scope.mention(what.at)
        self.scope.mention(what)
