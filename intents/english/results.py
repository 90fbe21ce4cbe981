"""Clauses that say what is to be so in the end, rather than what is to be done.

"Pull the drawer open"; "make sure the bottle is on the table"; "the cup goes in the box"; "the cup
should be brought to me"; "the lamp should be on"; "see that Ada gets the pencil".
"""

from intents.english import lexicon
from intents.english.complements import Clause, Complement, ends_clause, read_complements
from intents.english.frames import FRAMES
from intents.english.frames.devices import device_names, is_device
from intents.english.noun_phrases import noun_phrase
from intents.english.phrase import NounPhrase
from intents.english.questions import Reading
from intents.english.referents import is_person, to_object, to_person, to_place
from intents.english.remarks import Remarks
from intents.english.trouble import ReadingError
from intents.english.verbs import SENSES, participle_base, verbs_at
from intents.goals import Bring, Close, Goal, Guide, Open, Switch

_RESULT_VERBS = lexicon.words("pull push slide swing put set get turn make have leave keep want "
                              "need switch shut")  # fmt: skip
_RESULTS: dict[str, tuple[type[Open | Close | Switch], bool]] = {
    "open": (Open, True), "closed": (Close, True), "shut": (Close, True), "on": (Switch, True),
    "going": (Switch, True), "running": (Switch, True), "started": (Switch, True),
    "off": (Switch, False), "out": (Switch, False), "stopped": (Switch, False),
}  # fmt: skip
_ENSURES = lexicon.phrases(
    "make sure,make sure that,ensure,ensure that,see to it that,see that,take care that,check that,"
    "see to it,be sure that,arrange that,arrange for"
)
_ENDS = lexicon.phrases(
    "is,are,gets,get,stays,stay,ends,end,ends up,end up,lands,winds up,finds its way,is put,"
    "are put,goes,go,is placed"
)
_WISHED = lexicon.phrases(
    "to be,to go,to be put,to be moved,to be placed,to stand,to end up,put,moved,placed,back"
)
_GETS = lexicon.phrases("gets,get,has,have,receives,receive,is given,is brought,gets given")
_GETS_TO = lexicon.phrases(
    "gets to,get to,arrives at,arrives in,reaches,finds the way to,makes it to,comes to,"
    "gets safely to,gets into"
)
WISHES = lexicon.phrases("i want,i need,i would like,we want,we need,we would like")
"""How a wish begins."""
_PASSIVE = lexicon.phrases(
    "needs to be,need to be,has to be,have to be,should be,must be,ought to be,is to be,are to be,"
    "can be,could be,needs,wants to be,shall be,will be,may be,would need to be"
)
_BELONGS = lexicon.phrases(
    "goes,go,belongs,belong,should go,has to go,have to go,needs to go,need to go,must go,"
    "should be,has to be,must be,needs to be,ought to go,is supposed to go"
)


class Results(Remarks):
    """Reads clauses that name an end."""

    def about_thing(self, at: int) -> Reading | None:
        """A clause that begins with the thing that something is to be done with."""
        if verbs_at(self.text.words, at) and not self.text.name_at(at):
            return None
        phrase = noun_phrase(self.text, at)
        if phrase is None or phrase.noun in ("operator", "here", "there"):
            return None
        if phrase.noun == "unknown":
            return self._state(phrase)
        return self._belongs(at, phrase) or self._passive(phrase) or self._state(phrase)

    def framed(
        self, sense: str, at: int, first: int, complements: list[Complement], end: int
    ) -> Reading:
        """What a sense of a verb makes of complements that were read elsewhere."""
        verb = " ".join(self.text.words[at:first])
        clause = Clause(self.text, sense, verb, first, end, complements)
        return FRAMES[sense](clause, self.scope), end

    def resultative(self, at: int) -> Reading | None:
        """Pull the drawer open; get the washing machine going; I want the lamp on."""
        text = self.text
        ensured = text.phrase_end(_ENSURES, at)
        if ensured:
            return self.brought_about(ensured) or self._placed_so(at, ensured)
        wish = text.phrase_end(WISHES, at)
        placed = self._placed_so(at, wish, _WISHED) if wish else None
        if placed:
            return placed
        if wish is None and text.word(at) not in _RESULT_VERBS:
            return None
        found = self.brought_about(wish or at + 1)
        put = found and text.word(at) == "put" and isinstance(found[0][0], Switch)
        return None if found and put and not is_device(found[0][0]) else found

    def brought_about(self, at: int) -> Reading | None:
        """The drawer open; the lamp on."""
        phrase = noun_phrase(self.text, at)
        if phrase is not None:
            phrase.end += self.text.word(phrase.end) in ("is", "are", "being")
        result = _RESULTS.get(self.text.word(phrase.end)) if phrase else None
        if phrase is None or result is None or not ends_clause(self.text, phrase.end + 1):
            return None
        return self._made_so(phrase, result), phrase.end + 1

    def _placed_so(
        self, at: int, start: int, how: frozenset[lexicon.Phrase] = _ENDS
    ) -> Reading | None:
        """Make sure that the bottle is on the table."""
        phrase = noun_phrase(self.text, start)
        if phrase is not None and is_person(phrase, self.scope):
            return self._served(phrase)
        if phrase is None or not phrase.name("object", "category"):
            return None
        ends = self.text.phrase_end(how, phrase.end)
        if ends is None:
            return None
        complements, end = read_complements(self.text, ends)
        if len(complements) != 1 or complements[0].role not in ("at", "to", "into"):
            return None
        thing = Complement(phrases=[phrase])
        return self.framed("put", at, phrase.end, [thing, *complements], end)

    def _served(self, phrase: NounPhrase) -> Reading | None:
        """See that Ada gets the pencil; see that she gets to the lab."""
        way = self.text.phrase_end(_GETS_TO, phrase.end)
        place = noun_phrase(self.text, way) if way else None
        if place is not None and place.name("place", "room"):
            to = to_place(place, self.scope)
            return [Guide(person=to_person(phrase, self.scope), to=to)], place.end
        start = self.text.phrase_end(_GETS, phrase.end)
        complements, end = read_complements(self.text, start) if start else ([], 0)
        thing = complements[0] if len(complements) == 1 else None
        if thing is None or thing.role or not thing.phrases or thing.phrase.is_person:
            return None
        person = to_person(phrase, self.scope)
        return [Bring(object=to_object(one, self.scope), to=person) for one in thing.phrases], end

    def _made_so(
        self, phrase: NounPhrase, result: tuple[type[Open | Close | Switch], bool]
    ) -> list[Goal]:
        kind, on = result
        act = "switch" if kind is Switch else "open"
        names = device_names(Complement(phrases=[phrase]), self.scope, act)
        if kind is Switch:
            return [Switch(what=name, on=on) for name in names]
        return [Open(what=name) if kind is Open else Close(what=name) for name in names]

    def _belongs(self, at: int, phrase: NounPhrase) -> Reading | None:
        """The vase goes on the sill; all toys belong in the box."""
        start = self.text.phrase_end(_BELONGS, phrase.end)
        if start is None or not phrase.name("object", "category") or phrase.is_person:
            return None
        complements, end = read_complements(self.text, start)
        if len(complements) != 1 or complements[0].role not in ("at", "to", "into"):
            return None
        if is_person(complements[0].phrase, self.scope):
            goes = self.text.word(start - 1).startswith("go")
            person = to_person(complements[0].phrase, self.scope) if goes else None
            thing = to_object(phrase, self.scope)
            return ([Bring(object=thing, to=person)], end) if person else None
        thing = Complement(phrases=[phrase])
        self._last_verb = (at, at + 1, ("put",))
        return self.framed("put", at, phrase.end, [thing, *complements], end)

    def _passive(self, phrase: NounPhrase) -> Reading | None:
        """The cup should be brought to me; the plates need to be put on the shelf."""
        text = self.text
        first = text.phrase_end(_PASSIVE, phrase.end)
        base = participle_base(text.word(first)) if first else None
        if first is None or base is None:
            return None
        complements, end = read_complements(text, first + 1)
        thing = Complement(phrases=[phrase])
        for sense in SENSES.get((base,), ()):
            if sense not in FRAMES:
                continue
            clause = Clause(text, sense, base, first + 1, end, [thing, *complements])
            try:
                return FRAMES[sense](clause, self.scope), end
            except ReadingError:
                continue
        return None

    def _state(self, phrase: NounPhrase) -> Reading | None:
        """The lamp should be on."""
        start = self.text.phrase_end(_PASSIVE, phrase.end)
        result = _RESULTS.get(self.text.word(start)) if start else None
        if start is None or result is None or not ends_clause(self.text, start + 1):
            return None
        return self._made_so(phrase, result), start + 1
