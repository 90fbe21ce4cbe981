"""Questions, asked outright ("how many cups are there?") or after tell ("... how many ...")."""

from msgspec.structs import replace

from intents.english.clauses.polar import BE, read_on, skip_being, yes_or_no
from intents.english.clauses.self_talk import about_robot
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers, weight_at
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import ME, Scope, is_person, sought, to_object, to_person
from intents.english.reading import Found
from intents.english.trouble import Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.measures import number
from intents.english.words.properties import OF_ADJECTIVES, property_of
from intents.english.words.text import Text
from intents.goals import Count, ObjectQuery, Person, Tell


def question(
    text: Text, at: int, scope: Scope, to: Person | None = None, *, told: bool = False
) -> Found | None:
    """The question that begins at a word, as goals; None if there is none to be read.

    After tell (``told``) a noun phrase alone can be a question: "the largest object".
    """
    return (
        about_robot(text, at)
        or _how_many(text, at, scope, to)
        or _where(text, at, scope, to)
        or _doing(text, at, scope, to)
        or _property(text, at, scope, to)
        or _how(text, at, scope, to)
        or _which(text, at, scope, to, told)
        or _who(text, at, scope, to)
        or _of_all(text, at, scope, to)
        or yes_or_no(text, at, scope, to)
    )


def property_question(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """A question after "give me", where a thing could stand as well: the number of, the pose."""
    return _how_many(text, at, scope, to) or _property(text, at, scope, to)


def counted(text: Text, at: int, scope: Scope) -> Found:
    """Count *the cups on the table*.

    Raises:
        Unclear: Nothing is named that could be counted.
    """
    at += text.word(at) in lexicon.OPERATOR_WORDS  # count me the cups
    for skipped in ("how", "many", "the", "number", "amount", "of"):
        at += text.word(at) == skipped
    phrase = noun_phrase(text, at) or _those_who(text, at)
    if phrase is None:
        raise Unclear("What shall I count?")
    end = read_on(text, phrase) if text.word(phrase.end) in BE else phrase.end
    return [_count(phrase, scope, all_over=text.all_over)], end + 2 * (
        text.words[end : end + 2] in _FOR_ME
    )


def _those_who(text: Text, at: int) -> NounPhrase | None:
    """How many *are sitting there*: people, without the word."""
    posed = text.word(at) == "are" and text.lookup(lexicon.POSTURES, at + 1)
    return NounPhrase(at, at, noun="person", said="people") if posed else None


_FOR_ME = (["for", "me"], ["for", "us"])


def _count(
    phrase: NounPhrase, scope: Scope, to: Person | None = None, *, all_over: bool = False
) -> Count:
    """To count what a phrase describes; ``all_over`` the home, it is all of them."""
    if is_person(phrase, scope):
        return Count(person=to_person(phrase, scope), to=to)
    things = to_object(phrase, scope)
    loose = all_over and not (things.at or things.relation or things.count)
    return Count(object=replace(things, count="all") if loose else things, to=to)


def _how_many(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """How many guests wear hats?"""
    start = at + 2 if text.words[at : at + 2] in (["what", "is"], ["what", "are"]) else at
    start += text.word(start) in ("the", "a", "what")
    start += text.word(start) in ("total", "exact", "overall")
    if text.words[start : start + 2] in (["how", "many"], ["how", "much"]) or (
        text.word(start) in ("number", "amount", "quantity", "count")
        and text.word(start + 1) == "of"
    ):
        start += 2
    else:
        return None
    phrase = noun_phrase(text, start) or _counted_before(text, start, scope)
    if phrase is None or (text.word(start - 1) == "much" and phrase.noun != "name"):
        return None
    if is_person(phrase, scope):
        end = read_on(text, phrase)
        return [Count(person=to_person(phrase, scope), to=to)], end
    phrase.end += text.word(phrase.end) in _STAND
    end = read_on(text, phrase)
    return [_count(phrase, scope, to, all_over=text.all_over)], end


def _counted_before(text: Text, at: int, scope: Scope) -> NounPhrase | None:
    """How many cups are on the shelf, and how many *on the bar*? Of those asked after before."""
    if not isinstance(scope.last, Count) or scope.last.object is None:
        return None
    phrase = NounPhrase(at, skip_being(text, at), noun="one", said="one")
    read_postmodifiers(text, phrase)
    return phrase if phrase.places else None


_STAND = lexicon.words(
    "hang stand lie sit rest hangs stands lies sits rests remain remains live lives"
)
_LYING = lexicon.words(
    "lies stands sits rests remains lying standing sitting placed located kept stored"
)
_GONE = lexicon.words("is are gone go went got to hidden hiding")
_LEFT = lexicon.phrases(
    "did you put,did you leave,did you place,did i put,did i leave,have you put,have you left,"
    "did you see,did you last see,have i left,did we put,did we leave,you put,you left,i put,i left"
)


def _where(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Where is the cup? Tell me where the cup is; tell Ada where it is."""
    if text.word(at) != "where":
        return None
    left = text.phrase_end(_LEFT, at + 1)
    phrase = noun_phrase(text, left or skip_being(text, at + 1))
    if phrase is None:
        return None
    phrase.end = skip_being(text, phrase.end, _GONE)
    end = read_on(text, phrase)
    if to not in (None, ME) and not is_person(phrase, scope):
        return [_tell(phrase, "location", scope, to)], end
    return [sought(phrase, scope, spots=True)], end


def _property(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """What is Ada's pose? What colour is the cup?"""
    asked = text.word(at) in ("what", "which")
    start = skip_being(text, at + asked)
    start += text.word(start) in ("the", "its", "their", "his", "her")
    name = None if text.name_at(start) else property_of(text.word(start))
    if name:
        of = text.word(start + 1) in ("of", "for")
        inner = start + 2 if of else skip_being(text, start + 1)
        phrase = noun_phrase(text, inner)
        if phrase is None and text.word(start - 1) in ("its", "their", "his", "her"):
            return [_tell(None, name, scope, to)], start + 1
        if phrase is None or not (of or asked):
            return None
        end = read_on(text, phrase)
        end += text.word(end) in ("in", "doing", "making")
        return [_tell(phrase, name, scope, to)], end
    phrase = noun_phrase(text, start)
    name = property_of(text.word(phrase.end + 1)) if phrase else None
    if phrase and name and text.word(phrase.end) == "'s":
        end, phrase.end = phrase.end + 2, phrase.end + 2
        return [_tell(phrase, name, scope, to)], max(end, read_on(text, phrase))
    return None


def _tell(phrase: NounPhrase | None, name: str, scope: Scope, to: Person | None) -> Tell:
    if phrase is None:
        last = scope.person if scope.person_is_last or scope.object is None else None
        if last:
            return Tell(person=last, property=name, to=to)
        return Tell(object=scope.object or ObjectQuery(held=True), property=name, to=to)
    if is_person(phrase, scope):
        return Tell(person=to_person(phrase, scope), property=name, to=to)
    name = "location" if name == "posture" else name
    return Tell(object=to_object(phrase, scope, spots=True), property=name, to=to)


def _how(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """How heavy is the box?"""
    name = OF_ADJECTIVES.get(text.word(at + 1)) if text.word(at) == "how" else None
    if name is None or text.word(at + 2) not in ("is", "are"):
        return None
    phrase = noun_phrase(text, at + 3)
    known = phrase is not None and (phrase.name("object", "category") or phrase.is_person)
    if phrase is None or not known:
        return None
    return [_tell(phrase, name, scope, to)], read_on(text, phrase)


def _which(text: Text, at: int, scope: Scope, to: Person | None, told: bool) -> Found | None:
    """Which cup is lightest? What are the two tallest things here?"""
    asked = text.word(at) in ("what", "which")
    start = skip_being(text, at + 1) if asked else at
    start += text.words[start : start + 2] == ["one", "of"]
    start += asked and text.word(start) == "of"
    colors = text.index.colors
    color = colors.get(text.word(start)) if text.word(start - 1) in BE else None
    if color and start + 1 == len(text):
        phrase, end = NounPhrase(start, start, noun="object", said="object", color=color), start + 1
    elif asked and text.lookup(lexicon.LOCATIVES, start + (text.word(start) in _LYING)):
        start += text.word(start) in _LYING
        phrase = NounPhrase(start, start, noun="object", said="object")
        read_postmodifiers(text, phrase)
        end = phrase.end
    else:
        found = noun_phrase(text, start)
        if found is None or not (asked or (told and found.superlative)):
            return None
        phrase, end = found, read_on(text, found)
        end = _predicate_superlative(text, phrase, end)
        if phrase.color is None and text.word(end) in colors:
            phrase.color, end = colors[text.word(end)], end + 1
    if is_person(phrase, scope):
        return [Tell(person=to_person(phrase, scope), property="name", to=to)], end
    if text.word(end - 1) == "there" and scope.place and not phrase.places:
        there = NounPhrase(end - 1, end, noun="there", said="there")
        phrase.places.append(Locative(None, there))
    informative = phrase.superlative or phrase.places or phrase.color
    if not informative or phrase.noun in ("pronoun", "unknown"):
        return None
    return [Tell(object=to_object(phrase, scope), property="name", to=to)], end


def _predicate_superlative(text: Text, phrase: NounPhrase, end: int) -> int:
    """Which object is *the lightest one on the table*."""
    start = end + (text.word(end) == "the")
    weight = weight_at(text, start)
    if weight:
        phrase.superlative, phrase.end = weight
        read_postmodifiers(text, phrase)
        return phrase.end
    amount = number(text.words, start)
    if amount:
        that = amount.end + (text.word(amount.end) in ("that", "which"))
        weight = weight_at(text, that)
        if weight:
            phrase.count, (phrase.superlative, phrase.end) = int(amount.value), weight
            read_postmodifiers(text, phrase)
            return phrase.end
    if amount and text.lookup(lexicon.SUPERLATIVES, amount.end):
        phrase.count, start = int(amount.value), amount.end
    most = text.lookup(lexicon.SUPERLATIVES, start)
    better = lexicon.COMPARATIVES.get(text.word(start))
    if most is None and better is None:
        return end
    if most is None or better:
        most = (better or "largest", start + 1)
    phrase.superlative = most[0]
    amount = number(text.words, most[1])
    if amount:
        phrase.count, most = int(amount.value), (most[0], amount.end)
    phrase.end = most[1] + (text.word(most[1]) in lexicon.ONES | lexicon.OBJECT_NOUNS)
    read_postmodifiers(text, phrase)
    return phrase.end


def _who(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Who is in the kitchen?"""
    if text.word(at) not in ("who", "whom"):
        return None
    start = skip_being(text, at + 1)
    if text.word(start) in ("here", "around") and start + 1 >= len(text):
        return [Tell(person=Person(), property="name", to=to)], start + 1
    phrase = NounPhrase(start, start, noun="person", said="person")
    read_postmodifiers(text, phrase)
    if text.word(start - 1) == "there" and scope.place and phrase.end == start:
        there = NounPhrase(start - 1, start, noun="there", said="there")
        phrase.places.append(Locative(None, there))
        return [Tell(person=to_person(phrase, scope), property="name", to=to)], start
    if phrase.end == start:
        named = noun_phrase(text, start)
        if named is None or not is_person(named, scope):
            return None
        phrase = named
        phrase.end = read_on(text, phrase)
    return [Tell(person=to_person(phrase, scope), property="name", to=to)], phrase.end


def _doing(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """What is Ada doing? How is she standing?"""
    if text.word(at) not in ("what", "how"):
        return None
    asked = text.word(at + 1) in ("is", "are")
    phrase = noun_phrase(text, at + 1 + asked)
    if phrase is None or not phrase.is_person:
        return None
    if not asked and text.word(phrase.end) in ("is", "are"):
        phrase.end += 1
    if text.word(phrase.end) in ("called", "named") and text.word(at) == "what":
        return [Tell(person=to_person(phrase, scope), property="name", to=to)], phrase.end + 1
    posed = phrase.posture is not None and phrase.end >= len(text)
    if text.word(phrase.end) != "doing" and not posed:
        return None
    phrase.posture = None
    end = phrase.end + (text.word(phrase.end) == "doing")
    return [Tell(person=to_person(phrase, scope), property="posture", to=to)], end


def _of_all(text: Text, at: int, scope: Scope, to: Person | None) -> Found | None:
    """Of the people in the hall, how many are men? Of the cups, which is the largest?"""
    if text.word(at) not in ("of", "among"):
        return None
    phrase = noun_phrase(text, at + 1)
    if phrase is None:
        return None
    phrase.count = None
    after = phrase.end + (text.word(phrase.end) == COMMA)
    if text.words[after : after + 2] == ["how", "many"]:
        phrase.end = after + 2
        end = read_on(text, phrase)
        return [_count(phrase, scope, to)], end
    if phrase.superlative and phrase.end >= len(text):
        return [Tell(object=to_object(phrase, scope), property="name", to=to)], phrase.end
    if text.word(after) not in ("which", "what"):
        return None
    amount = number(text.words, after + 1)
    phrase.count = int(amount.value) if amount else None
    end = _predicate_superlative(
        text, phrase, skip_being(text, amount.end if amount else after + 1)
    )
    return [Tell(object=to_object(phrase, scope), property="name", to=to)], end
