"""Noun phrases: "the three largest red cups on the table in the kitchen".

A noun phrase is read in three parts: what stands before the noun (how many, which, what colour;
`premodifiers.py`), the noun (`nouns.py`), and what follows it, in this file, since it holds noun
phrases in turn: where the thing is, relative clauses; boards of furniture hold none (`boards.py`).
Nothing is decided here about what the phrase
is for; `referents.py` turns it into an object, a person or a place.
"""

from intents.english.phrases.appearance import read_appearance
from intents.english.phrases.bare_phrases import bare_phrase
from intents.english.phrases.boards import board_after, board_of
from intents.english.phrases.phrase import SOMETHING, Locative, NounPhrase, is_at_it, is_content
from intents.english.phrases.pronouns import part_of
from intents.english.phrases.times import tells_when
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.lexicon import DETERMINERS, LOCATIVES
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Superlative

_SOMEBODY = lexicon.words("i we he she they you somebody someone")
_EXCEPT = lexicon.phrases(
    "except,except for,apart from,other than,excluding,save for,aside from,"
    "with the exception of,not counting,leaving out,different from,different to,different than"
)
_IS = lexicon.words("is are was were")
_OF_A_PART = ("on", "at")
"""*On* the left of the shelf is on it; *left of* the oven, or *to* its left, is beside it."""
_LEFT_RIGHT = {"left": "leftmost", "right": "rightmost"}
_RELATIVE = lexicon.words("that which who whose")


_REDUCED = lexicon.phrases(
    "you find,you see,you can see,you can find,you will find,i left,i put,you will see,we have,"
    "i have,you have,there is,there are,there"
)


_RELATIVE_FILLERS = lexicon.words(
    "is are was were has have currently now being there should be will can you i see find we "
    "stands sits lies"
) - {"stands", "sits", "lies"}  # fmt: skip


_WHOSE = lexicon.words("my your our his her their the")
_LYING_AROUND = lexicon.words(
    "located placed situated found kept stored resting positioned left sitting standing lying "
    "laying hanging remain remains remaining stays stands sits lies rests lie waiting staying "
    "working relaxing present hiding hidden tucked sat stood lurking perched parked dumped lain "
    "stuck propped stashed stowed sprawled scattered strewn"
)


_BELONGS = lexicon.words("goes go belongs belong lives live")
_WHERE_IT_BELONGS = lexicon.phrases(
    "where it belongs,where they belong,where it lives,where they live,where it goes,where they go,"
    "where it should be,where they should be,where it ought to be,where it usually is,"
    "where it usually stands,where it always is,where it is supposed to be,where it normally lives"
)
"""What of a place that is named says only that it is the right one."""


def noun_phrase(text: Text, start: int) -> NounPhrase | None:
    """The noun phrase that begins at a word, as long as it goes."""
    partly = part_of(text, start)
    if partly:
        whole = noun_phrase(text, partly[1])
        if whole is not None:
            whole.part = partly[0]
        return whole
    phrase = bare_phrase(text, start)
    if phrase is None:
        return None
    read_postmodifiers(text, phrase)
    return phrase


def read_postmodifiers(text: Text, phrase: NounPhrase) -> None:
    """Read on from the noun; moves ``phrase.end``."""
    while True:
        end = _measured_out(text, phrase, phrase.end) or board_after(text, phrase, phrase.end)
        end = end or _modifier(text, phrase, phrase.end) or _relative(text, phrase, phrase.end)
        if end is None:
            return
        phrase.end = end


def _measured_out(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """A bottle *of water*, one *of the cups*, the couch *of the bedroom*."""
    if text.word(at) != "of":
        return None
    whose = bare_phrase(text, at + 1) if phrase.name("object", "category") else None
    if whose is not None and whose.name("person"):
        phrase.owner = whose.name("person")
        return whose.end  # the cap of Hans: as with "Hans's cap", it is the cap
    inner = noun_phrase(text, at + 1)
    if inner is None or inner.is_person:
        return None
    board = board_of(text, phrase, inner)
    if board:
        return board
    counted = phrase.noun in ("one", "object") or not phrase.said
    said = singular(phrase.said.split()[-1]) if phrase.said else ""
    if phrase.noun == "one" and not phrase.determiner:
        phrase.determiner = "any"
    if counted or (said in lexicon.CONTAINERS and (inner.names or not phrase.names)):
        phrase.noun, phrase.names, phrase.said = inner.noun, inner.names, inner.said
        phrase.color, phrase.size = phrase.color or inner.color, phrase.size or inner.size
        phrase.places += inner.places
        phrase.superlative = phrase.superlative or inner.superlative
        return inner.end
    if said in lexicon.CONTAINERS:
        return inner.end
    if inner.name("room"):
        phrase.places.append(Locative("in", inner))
        return inner.end
    accessory = phrase.name("object") and inner.name("object") and inner.determiner in _WHOSE
    phrase.places += inner.places if accessory else []
    return inner.end if accessory else None  # the charger of my laptop


def _relative(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Who is waving; that weighs the least; which you see on the table."""
    if phrase.noun == "operator":
        return None
    if text.word(at) == COMMA and text.word(at + 1) in ("who", "which"):
        end = _relative(text, phrase, at + 1)
        follows = text.word(end + 1) in DETERMINERS | {"to", "into"} if end else False
        return end and end + (text.word(end) == COMMA and follows)
    spot = phrase.is_spot
    home = text.phrase_end(_WHERE_IT_BELONGS, at) if spot and phrase.names else None
    if home:
        return home
    reduced = None if spot or phrase.noun == "pronoun" else text.phrase_end(_REDUCED, at)
    reduced = reduced or (None if spot or phrase.is_person else _left_there(text, at))
    if reduced:
        who = text.name_at(at + (text.word(at) in _RELATIVE))
        phrase.owner = phrase.owner or (who and who.of("person")) or ""
        there = text.word(reduced) == "there" and text.word(reduced - 1) != "there"
        seen = _locative(text, phrase, reduced) or _modifier(text, phrase, reduced)
        ends = text.word(reduced) in (COMMA, FULL_STOP) and text.word(reduced - 1) in (
            "find",
            "see",
        )
        return seen or (reduced + there if there or ends else None)
    lies = text.word(at + 2) in _LYING_AROUND or text.lookup(LOCATIVES, at + 2)
    learnt = text.words[at : at + 2] == ["what", "is"] and bool(lies)  # the cup what is there
    if text.word(at) not in _RELATIVE and not learnt:
        return None
    at += 1
    at += text.word(at) == "it" and text.word(at + 1) == "is"  # the book which it is on the sofa
    first = at
    while text.word(at) in _RELATIVE_FILLERS:
        at += 1
    if spot:
        return _locative(text, phrase, at)
    weight = weight_at(text, at)
    if weight:
        phrase.superlative, end = weight
        return end
    end = _modifier(text, phrase, at) or (_predicate(text, phrase, at) if at > first else None)
    if end:
        return end
    return at if text.words[first:at] and text.word(at - 1) in ("see", "find", "there") else None


def _left_there(text: Text, at: int) -> int | None:
    """The plate [that] *Ada left* on the sofa: what follows says where it is."""
    at += text.word(at) in ("that", "which")
    who = text.name_at(at)
    subject = who.end if who and who.of("person") else at + 1
    if subject == at + 1 and not who and text.word(at) not in _SOMEBODY:
        return None
    subject += text.word(subject) in ("has", "have", "had", "just", "'s")
    left = text.word(subject) in lexicon.LEAVING and text.lookup(LOCATIVES, subject + 1)
    return subject + 1 if left else None


def weight_at(text: Text, at: int) -> tuple[Superlative, int] | None:
    """Weighs the least."""
    if text.word(at) not in ("weighs", "weigh", "weight", "weights"):
        return None
    end = at + 1 + (text.word(at + 1) == "the")
    if text.word(end) not in ("least", "most"):
        return None
    return ("lightest" if text.word(end) == "least" else "heaviest"), end + 1


def _predicate(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """What can be said after "that is": red, the largest."""
    at += text.word(at) in DETERMINERS
    most = text.lookup(lexicon.SUPERLATIVES, at)
    if most:
        phrase.superlative = most[0]
        return most[1] + (text.word(most[1]) in lexicon.ONES)
    color = text.index.colors.get(text.word(at))
    if color:
        phrase.color = color
        return at + 1
    return None


def _modifier(text: Text, phrase: NounPhrase, at: int) -> int | None:
    word = text.word(at)
    if phrase.noun == "operator" and word != "in":
        return None
    if not word[0].isalpha() and word != COMMA:
        return None
    if phrase.noun in ("person", "pronoun") or phrase.is_person:
        end = read_appearance(text, phrase, at)
        if end:
            return end
    if (word in _LYING_AROUND or is_at_it(text, at)) and (end := _lying(text, phrase, at)):
        return end
    if word in ("named", "called"):
        inner = noun_phrase(text, at + 1)
        if inner and inner.names:
            phrase.noun, phrase.names, phrase.said = "name", inner.names, inner.said
            return inner.end
    if word == "with" and phrase.name("object", "category") and not phrase.is_person:
        with_somebody = text.name_at(at + 1)
        somebody = with_somebody is not None and with_somebody.of("person")
        return None if somebody else _equipped(text, phrase, at + 1)
    most = _most(text, phrase, at)
    if most:
        phrase.superlative, end = most
        return end
    behind = (_color_behind, _most_behind, _except, denied, _aside, _at_its_side)
    aside = next((end for read in behind if (end := read(text, phrase, at))), None)
    if aside:
        return aside
    return _extreme_side(text, phrase, at) or _locative(text, phrase, at)


def _lying(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Lying *on the table*; lying *around on the table*; standing *there*."""
    loosely = at + 1 + (text.word(at + 1) in ("around", "about", "over"))
    for start in (loosely, at + 1):
        if text.lookup(LOCATIVES, start):
            return _locative(text, phrase, start)
    return None if text.word(at) in ("left", "put") else _lying_there(text, phrase, at + 1)


def _color_behind(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The cup *red*: as those say it who speak another language."""
    told = phrase.color or not phrase.name("object", "category")
    last = not is_content(text, at + 1) or bool(verbs_at(text.words, at + 1))
    if text.word(at) not in text.index.colors or told or not last:
        return None
    phrase.color = text.index.colors[text.word(at)]
    return at + 1


def _most_behind(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The tool *the most heavy*, as those say it who speak another language."""
    most = text.lookup(lexicon.SUPERLATIVES, at + 1) if text.word(at) == "the" else None
    thing = phrase.name("object", "category") and not phrase.superlative
    if most is None or not thing or is_content(text, most[1]):
        return None
    phrase.superlative, end = most
    return end


def _except(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """All pens *except the red ones*; every dish *but the bowl*."""
    start = text.phrase_end(_EXCEPT, at)
    whatever = phrase.count == "all" or phrase.said in SOMETHING or phrase.determiner == "any"
    if start is None and text.word(at) == "but" and whatever:
        start = at + 1
    thing = phrase.noun == "object" or phrase.name("object", "category")
    inner = bare_phrase(text, start) if start and thing else None
    if inner and start and inner.noun == "one" and not (inner.color or inner.size):
        inner = noun_phrase(text, start)  # apart from the one on the desk
    if inner is None or inner.is_person or inner.is_spot:
        return None
    phrase.without = inner
    return inner.end


def denied(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The cup that is *not red*; a mug *not on the table*; something that is *not a cup*."""
    thing = phrase.noun in ("object", "one") or phrase.name("object", "category")
    if text.word(at) != "not" or not thing or phrase.without or phrase.is_person:
        return None
    stated = text.word(at - 1) in _IS
    first = at + 1
    inner: NounPhrase | None = NounPhrase(first, first, noun="one", said="one", determiner="the")
    end = _locative(text, inner, first)
    if end is None and stated and text.word(first) in DETERMINERS:
        inner = bare_phrase(text, first)
        end = inner.end if inner and not (inner.is_person or inner.is_spot) else None
    elif end is None and stated:
        inner.color = text.index.colors.get(text.word(first))
        inner.size = lexicon.SIZES.get(text.word(first))
        end = first + 1 if inner.color or inner.size else None
    goes_on = end is not None and text.word(end) in ("but", "or", "nor", "and")
    if end is None or inner is None or (goes_on and not verbs_at(text.words, end + 1)):
        return None
    phrase.without = inner
    return end


def _equipped(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The book with *the blue cover* is a blue one."""
    inner = noun_phrase(text, at)
    if inner is None:
        return None
    phrase.color = phrase.color or inner.color
    return inner.end


def _lying_there(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Standing *there*; lying *to the kettle's left*."""
    if text.word(at) == "there":
        there = NounPhrase(at, at + 1, noun="there", said="there")
        phrase.places.append(Locative(None, there))
        return at + 1
    return _at_its_side(text, phrase, at)


def _most(text: Text, phrase: NounPhrase, at: int) -> tuple[Superlative, int] | None:
    """Whatever *weighs the least*; the cup *closest to you*."""
    bare = phrase.said in ("what", "whatever")
    weight = weight_at(text, at) if bare else None
    most = text.lookup(lexicon.SUPERLATIVES, at)
    if weight or most is None:
        return weight
    to_somebody = text.word(most[1]) == "to" and text.word(most[1] + 1) in ("you", "me", "us")
    if to_somebody:
        return most[0], most[1] + 2
    return most if bare else None


def _extreme_side(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """On the left, furthest to the right - and not "on the left of the cup"."""
    most = text.lookup(lexicon.SUPERLATIVES, at)
    begun = at
    if most is None and text.word(at) in ("on", "at", "from", "to"):
        most = text.lookup(lexicon.SUPERLATIVES, at + 1 + (text.word(at + 1) == "the"))
        most = most if most and most[0] in ("leftmost", "rightmost") else None
    if most and most[0] in ("leftmost", "rightmost"):
        phrase.superlative = most[0]
        end = most[1] + (text.word(most[1]) in ("side", "end"))
        inner = noun_phrase(text, end + 1) if text.word(end) == "of" else None
        if inner and inner.name("place", "room"):
            phrase.places.append(Locative(None, inner))
            return inner.end
        return end
    if most or text.word(at) == "most":
        at = most[1] if most else at + 1
        if text.word(at) == "to":
            at += 1
    elif text.word(at) in ("on", "at", "to"):
        at += 1
    else:
        return None
    at += text.word(at) == "the"
    far = text.word(at) == "far"
    at += far
    side = _LEFT_RIGHT.get(text.word(at))
    follows = text.word(at + 1)
    if follows in ("side", "hand"):
        at += 1
        follows = text.word(at + 1)
    if side is None or follows in ("of", "to", "leg", "foot", "arm", "hand"):
        return None
    named = text.name_at(at)
    if named and named.end > at + 1:
        return None  # on the left desk
    beside = text.word(begun) == "to" and not far and phrase.noun != "person"
    if beside or phrase.noun in ("pronoun", "place", "body"):
        return None
    phrase.superlative = "leftmost" if side == "leftmost" else "rightmost"
    return at + 1


def _at_its_side(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """To the kettle's left."""
    if text.word(at) not in ("to", "on", "at"):
        return None
    inner = noun_phrase(text, at + 1)
    if inner is None or inner.is_person or text.word(inner.end) != "'s":
        return None
    side = text.word(inner.end + 1)
    if side not in ("left", "right"):
        return None
    phrase.places.append(Locative("left" if side == "left" else "right", inner))
    return inner.end + 2 + (text.word(inner.end + 2) == "side")


def _aside(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Michael, over at the stove, ...; the girl there."""
    if text.word(at) == COMMA and phrase.name("person"):
        end = _locative(text, phrase, at + 1) if text.lookup(LOCATIVES, at + 1) else None
        if end and text.word(end) == COMMA and phrase.places[-1].of.name("room", "place"):
            return end + 1
        if end:
            phrase.places.pop()
        return None
    there = text.word(at) == "there" or text.words[at : at + 2] == ["over", "there"]
    end = at + 1 + (text.word(at) == "over")
    told = phrase.is_person and text.word(end) not in ("is", "are")
    belongs = phrase.name("object", "category") and text.word(end) in _BELONGS
    if there and (told or belongs):
        phrase.places.append(Locative(None, NounPhrase(at, end, noun="there", said="there")))
        return end
    return None


def _locative(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """In the kitchen, left of the cup."""
    found = text.lookup(LOCATIVES, at)
    if found is None or phrase.noun in ("body", "here", "there") or tells_when(text, at):
        return None
    how, end = found
    inner = noun_phrase(text, end)
    if inner is None or inner.noun == "body" or inner.end == end:
        return None
    if inner.noun in ("here", "there") and text.word(at) in ("over", "right"):
        return inner.end
    if phrase.is_spot:
        in_room = bool(inner.name("room")) and how in ("on", "in", None, "near")
        by_another = how in ("in", "near", "in_front", "behind", "left", "right")
        if not in_room and not (by_another and inner.name("place")):
            return None
    part = how in ("left", "right") and text.word(at) in _OF_A_PART
    phrase.places.append(Locative(how, inner, part=part))
    if how == "on" and text.word(inner.end - 1) == "floor" and phrase.is_person:
        phrase.posture = phrase.posture or "lying"
    if how == "between" and text.word(inner.end) == "and":
        other = noun_phrase(text, inner.end + 1)
        if other and other.noun != "body":
            phrase.places[-1].other = other
            return other.end
    return inner.end
