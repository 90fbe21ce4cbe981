"""Goals as a model nearly wrote them, in the form of the contract.

A thing may be called "red cup" or "the cups", a place "Kitchen_Table" or by a synonym, a person by
a bare name. They are read as if a person had said them: by the names of the vocabulary and the noun
phrases of the grammar. What nobody would understand stays as it is, and is refused by the checks.
"""

import re
from typing import Any, cast

import msgspec

from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import Scope, to_object
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.english.words.names import Kind, index_of
from intents.english.words.text import Text
from intents.goals import OPERATOR, Goal, from_builtins
from intents.language_model.slang import in_our_words
from intents.vocabulary import Vocabulary

Slots = dict[str, Any]
_NOTHING = ("", "null", "none", "n/a")
_WHO_ASKS = lexicon.words("operator user me human speaker myself")
_OBJECTS, _SPOTS = ("object", "of", "other", "except"), ("on", "in", "place", "at", "to")
_NESTED = ("goals", "then", "else")
_SPEECH = {"say": "what"}
_HOW = {"in_front_of": "in_front", "left_of": "left", "right_of": "right", "next_to": "near",
        "beside": "near", "inside": "in", "on_top_of": "on", "below": "under"}  # fmt: skip
_IN_BRACKETS = re.compile(r"([^()]+) \(([^()]+)\)")
_AT = re.compile(r"^(?:(?:on|in|at|into|onto|from) )?(?:the )?")
_MAX_NESTING = 20
"""Of what a model wrote; the goals themselves may be nested less deep."""


def goals_from(data: list[object], vocabulary: Vocabulary) -> tuple[Goal, ...]:
    """Goals from what a model wrote.

    Raises:
        msgspec.ValidationError: They are no goals; the message says where and why.
    """
    mend = _Mending(vocabulary)
    return from_builtins([mend.goal(_said(one, 0)) for one in data], strict=False)


def _said(value: object, depth: int) -> object:
    """Without slots that say nothing: null, "", {}."""
    if depth > _MAX_NESTING:
        raise msgspec.ValidationError("that is nested too deep")
    if isinstance(value, list):
        return [_said(one, depth + 1) for one in cast("list[object]", value)]
    if not isinstance(value, dict):
        return value
    slots = {k: _said(v, depth + 1) for k, v in cast("Slots", value).items()}
    return {
        key: one for key, one in slots.items()
        if one is not None and one != {} and not (isinstance(one, str) and one.lower() in _NOTHING)
    }  # fmt: skip


def _slots(value: object) -> Slots | None:
    """A description, which may be a bare name; None if it is neither."""
    if isinstance(value, str):
        return {"name": value}
    return cast("Slots", value) if isinstance(value, dict) else None


class _Mending:
    """What is meant in one world."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._index = index_of(vocabulary)

    def goal(self, data: object) -> object:
        """One goal."""
        if not isinstance(data, dict):
            return data
        goal = in_our_words(cast("Slots", data))
        kind = goal.get("goal")
        for slot, value in goal.items():
            if slot == _SPEECH.get(str(kind)):
                continue
            if slot in _NESTED:
                listed = cast("list[object]", value if isinstance(value, list) else [value])
                goal[slot] = [self.goal(one) for one in listed]
            elif slot == "what":
                goal[slot] = self._device(value)
            elif slot == "at":
                goal[slot] = self._pointed_at(value)
            elif slot == "to" and kind == "bring":
                goal[slot] = self._receiver(value)
            elif slot == "to" and kind not in ("follow", "guide"):
                goal[slot] = self._person(value)
            elif slot in _SPOTS:
                goal[slot] = value if isinstance(value, bool) else self._spot(value)
            else:
                goal[slot] = self._part(slot, value)
        return goal

    def _part(self, slot: str, value: object) -> object:
        """What stands in a slot anywhere: a thing, a person, or what is made of such."""
        if slot in _OBJECTS:
            return self._object(value)
        if slot == "person":
            return self._person(value)
        if slot in ("kind", "mode", "side", "topic", "property") and isinstance(value, str):
            return value.strip().lower()
        if slot in ("condition", "relation") and isinstance(value, dict):
            parts = {key: self._part(key, one) for key, one in cast("Slots", value).items()}
            said_how = parts.get("how")
            if isinstance(said_how, str):
                how = said_how.strip().lower().replace(" ", "_")
                parts["how"] = _HOW.get(how, how)
            return parts
        return value

    def _object(self, value: object) -> object:
        """A description; its name may be a whole one ("the red cup on the table")."""
        said = _slots(value)
        if said is None:
            return value
        said = {key: one.lower() if key in ("color", "size", "superlative") and isinstance(one, str)
                else one for key, one in said.items()}  # fmt: skip
        if "at" in said:
            said["at"] = self._spot(said["at"])
        for slot in ("except", "relation"):
            if slot in said:
                said[slot] = self._part(slot, said[slot])
        for slot in ("name", "category"):
            if isinstance(said.get(slot), str):
                said = self._described(said, slot)
        return said

    def _described(self, said: Slots, slot: str) -> Slots:
        """A description whose name or category is words that a person may have said."""
        words = said[slot]
        known = {t.name for t in self._vocabulary.objects} if slot == "name" else {
            c.singular for c in self._vocabulary.categories
        }  # fmt: skip
        meant = None if words in known else self._read(words)
        if meant is None:
            return said
        rest = {key: one for key, one in said.items() if key != slot}
        if any(key in meant and meant[key] != one for key, one in rest.items()):
            return said  # they contradict each other
        return {**meant, **rest}

    def _read(self, words: str) -> Slots | None:
        """What a noun phrase describes; None if it is none, or of nothing that is known."""
        behind = _IN_BRACKETS.fullmatch(words)  # "cup (red)"
        words = f"{behind[2]} {behind[1]}" if behind else words
        text = Text(words.replace("_", " "), self._vocabulary)
        try:
            phrase = noun_phrase(text, 0)
            if phrase is None or phrase.end != len(text):
                return None
            query = to_object(phrase, Scope(self._index), spots=True)
        except ReadingError:
            return None
        read = cast("Slots", msgspec.to_builtins(query))
        noun = phrase.said or words
        if "count" not in read and singular(noun) != noun and query.name != noun:
            read["count"] = "all"
        elif read.get("count") == 1:
            del read["count"]  # "a cup" of a model's is the one that was asked for
        return read

    def _person(self, value: object) -> object:
        """A person, who may be a bare name, or the one who asks."""
        said = _slots(value)
        if said is None:
            return value
        asks = {str(said.get(slot, "")).lower().removeprefix("the ") for slot in ("name", "who")}
        if asks & _WHO_ASKS:
            return {"who": OPERATOR}
        if "at" in said:
            said = {**said, "at": self._spot(said["at"])}
        if "name" in said:
            said = {**said, "name": self._name(said["name"], "person")}
        return said

    def _spot(self, value: object) -> object:
        """The name of where something is or goes; "operator" is where the one who asks is."""
        slots = _slots(value) or {}
        name = slots.get("name", slots.get("place"))
        if isinstance(name, str) and name.lower().removeprefix("the ") in _WHO_ASKS:
            return OPERATOR
        return self._name(name, "place", "room", "object") if isinstance(name, str) else value

    def _receiver(self, value: object) -> object:
        """Who or where something is brought to."""
        person = self._person(value)
        if person == {"who": OPERATOR}:
            return person
        spot = self._spot(value)
        names = self._index.exact(spot) if isinstance(spot, str) else ()
        return spot if {n.kind for n in names} & {"place", "room", "object"} else person

    def _pointed_at(self, value: object) -> object:
        spot = self._spot(value)
        return spot if spot == OPERATOR else self._name(spot, "place", "room", "object", "person")

    def _device(self, value: object) -> object:
        return self._name((_slots(value) or {}).get("name", value), "place", "room", "object")

    def _name(self, said: object, *kinds: Kind) -> object:
        """A name as the vocabulary spells it, for one in any spelling; else what was said."""
        if not isinstance(said, str):
            return said
        plain = _AT.sub("", " ".join(said.replace("_", " ").lower().split()))
        names = self._index.exact(plain)
        found = next((n.name for kind in kinds for n in names if n.kind == kind), None)
        return plain if found is None and plain != said.lower() else found or said
