"""Taking back what was just said: "the red cup, no wait, the blue one"."""

from msgspec.structs import replace

from intents.english.clauses.markers import OPENINGS, marker_end
from intents.english.clauses.told import told_end
from intents.english.faithfulness import strings
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.substitution import goes_to_somebody, redirected, substitute
from intents.english.trouble import Misfit
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import GOALWARDS, LOCATIVES, SOURCEWARDS, phrases, words
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Close, Goal, ObjectQuery, Open, Switch

_REASONS = words("needs wants has is was asked ordered wanted needed")
"""How it is told why somebody or something was meant."""
_BEHIND = phrases("i mean,i meant,rather,instead,i mean to say,sorry,that is")
"""What stands behind a correction rather than before it."""
_RETRACTS = phrases("leave it,leave that,leave them,leave it be,leave it alone,let it be")

_LEAVES = phrases(
    "forget,forget about,never mind,never mind about,leave,skip,drop,scratch,scrap,cancel,not,"
    "do not bring,do not take,do not get,do not fetch,i do not need,i do not want"
)


def retraction_end(text: Text, at: int) -> int | None:
    """Where a clause ends that leaves what was asked undone: "leave it"."""
    end = text.phrase_end(_RETRACTS, at)
    return end if end and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)) else None


def _denied_end(sentence: Sentence, at: int, last: list[Goal]) -> int | None:
    """No, *do not tell her that*; no, *leave Leo alone*: where what was asked ends to be denied.

    It speaks of nothing but what was asked, in the same verb or in one for all.
    """
    text = sentence.text
    told = told_end(text, at)
    if told is not None and text.word(told) in (COMMA, FULL_STOP):
        at = told + 1  # no, that is rude, do not tell her that
    alone = text.word(at) == "leave"
    if not alone and text.words[at : at + 2] != ["do", "not"]:
        return None
    first = at + 1 if alone else at + 2
    end = first
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        end += 1
    if alone:
        left = text.word(end - 1) in ("alone", "be", "out") and end > first + 1
        return end if left and _speaks_only_of(text, first, end, last) else None
    verb = sentence.notes.verb
    begun = {sense for sense, _ in verbs_at(text.words, first)}
    same = verb is not None and not begun.isdisjoint(verb.senses)
    at_all = end == first or text.word(first) in _DENIED
    return end if (same or at_all) and _speaks_only_of(text, first, end, last) else None


_DENIED = words("do disturb bother wake trouble interrupt worry")
"""Do not *do that*: verbs that deny whatever was asked for."""


def _speaks_only_of(text: Text, at: int, end: int, last: list[Goal]) -> bool:
    """Whether all names between two words are of what was asked for."""
    said = set(strings(last))
    names = [name for n in range(at, end) if (name := text.name_at(n))]
    return all(any(one.name.lower() in said for one in name.names) for name in names)


def taken_back(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """The red cup, *no the blue one*: looked for before "no" is passed over as an opening."""
    text = sentence.text
    while text.word(at) in (COMMA, FULL_STOP) and at < len(text):
        at += 1
    end = marker_end(text, at)
    if end is None or not last or text.word(end) in ("i", "we"):
        return None  # no, I do not know why: nobody is meant by "I" in another's place
    begins = at == 0  # it takes back what was said before, if it is no command of its own
    plain = text.word(end - 1) != COMMA and end < at + 2  # no cup there?
    if begins and (verbs_at(text.words, end) or (plain and text.word(end) != "the")):
        return None
    new_sentence = text.word(at - 1) == FULL_STOP and text.word(at) in OPENINGS
    if new_sentence and verbs_at(text.words, end):
        return None
    return correction(sentence, at, last)


def correction(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """No wait, the blue one; I mean go to the kitchen."""
    text, scope = sentence.text, sentence.scope
    end = marker_end(text, at) or _told_apart(text, at, scope.object) or _meant(text, at)
    denied = _past_denied(text, at if end is None else end, last, scope)
    if denied is not None:
        end = denied
    if end is None:
        return None
    sentence.notes.passed.append((at, end))
    undone = retraction_end(text, end) or named_retraction_end(text, end, last)
    undone = undone or _denied_end(sentence, end, last)
    if undone:
        sentence.notes.passed.append((end, undone))
        return [], undone
    if verbs_at(text.words, end):
        scope.person_is_last = False  # "them" is what was to be fetched, not for whom
        return clause_by_itself(sentence, end)
    whither = _redirected(sentence, end, last)
    if whither:
        return whither
    phrase = noun_phrase(text, end) or _spot_after_preposition(text, end)
    if phrase is None:
        return None
    device = last[-1] if last else None
    what = phrase.name("object", "place", "room")
    if isinstance(device, Open | Close | Switch) and what:
        return [*last[:-1], replace(device, what=what)], _past_marker(text, phrase.end)
    return _substituted(sentence, phrase, last)


def _substituted(sentence: Sentence, phrase: NounPhrase, last: list[Goal]) -> Found:
    """What was asked for, of what the phrase says instead.

    Raises:
        Misfit: Nothing that it could take the place of was spoken of.
    """
    text, scope = sentence.text, sentence.scope
    _take_source(text, phrase)
    old = scope.person if is_person(phrase, scope) else scope.object
    if phrase.is_spot:
        old, new = scope.place, to_place(phrase, scope)
    elif is_person(phrase, scope):
        new = to_person(phrase, scope)
    else:
        new = to_object(phrase, scope)
    if old is None and isinstance(new, ObjectQuery):
        old = next((query for goal in last if (query := getattr(goal, "object", None))), None)
    if old is None:
        raise Misfit("I do not know what to correct")
    scope.mention(new)
    end = _past_marker(text, phrase.end)
    reason = _reason_end(text, phrase)
    if reason is not None:
        sentence.notes.passed.append((end, reason))
    return [substitute(g, old, new) for g in last], reason or end


def switched_over(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """The lamp on, no, *off*: the other way round; the lamp on, wait a bit, then *off*: again."""
    text = sentence.text
    end = marker_end(text, at) or at
    on = {"on": True, "off": False}.get(text.word(end))
    after = end + 1 + (text.word(end + 1) == COMMA)
    after = after + 1 if text.word(after) in ("then", "instead", "again") else end + 1
    closed = after >= len(text) or text.word(after) in (COMMA, FULL_STOP)
    device = next((goal for goal in reversed(sentence.before) if isinstance(goal, Switch)), None)
    if on is None or not closed or device is None or device.on == on:
        return None
    if end == at and text.word(at - 1) in ("then", "and"):
        return [*last, replace(device, on=on)], after
    if not isinstance(last[-1], Switch):
        return None
    sentence.notes.passed.append((at, end))
    return [replace(goal, on=on) if isinstance(goal, Switch) else goal for goal in last], after


def _redirected(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """No, *to Leo*: what was to go to somebody or somewhere else."""
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(GOALWARDS, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None:
        return None
    somebody = is_person(phrase, scope) or phrase.noun == "operator"
    if not somebody and not (phrase.is_spot and any(map(goes_to_somebody, last))):
        return None
    to = to_person(phrase, scope) if somebody else to_place(phrase, scope)
    goals = [redirected(goal, to) for goal in last]
    if goals == last:
        return None
    scope.mention(to)
    return goals, _past_marker(text, phrase.end)


def _take_source(text: Text, phrase: NounPhrase) -> None:
    """Two gloves, *from the cabinet*: that is where they are."""
    source = text.phrase_end(SOURCEWARDS, phrase.end + 1)
    spot = noun_phrase(text, source) if source and text.word(phrase.end) == COMMA else None
    source = source if spot else text.phrase_end(SOURCEWARDS, phrase.end)
    spot = spot or (noun_phrase(text, source) if source else None)
    if spot is not None and spot.is_spot and not phrase.is_spot:
        phrase.places.append(Locative(None, spot))
        phrase.end = spot.end


def _reason_end(text: Text, phrase: NounPhrase) -> int | None:
    """Joan *needs it*; Bob *was the one who asked for it*: where such a reason ends."""
    end = phrase.end
    if text.word(end) not in _REASONS and told_end(text, phrase.start) is None:
        return None
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        if text.name_at(end):
            return None
        end += 1
    return end


def _past_denied(text: Text, at: int, last: list[Goal], scope: Scope) -> int | None:
    """*Not Tom*, Bob asked for it: what was asked for is denied, and what is meant follows."""
    phrase = noun_phrase(text, at + 1) if text.word(at) == "not" else None
    if phrase is None or text.word(phrase.end) not in (COMMA, "but"):
        return None
    after = phrase.end + 1 + (text.word(phrase.end + 1) == "but")
    meant = noun_phrase(text, after) or _spot_after_preposition(text, after)
    if meant is None:
        return None
    if phrase.noun == meant.noun == "one":  # not a small one, the largest one
        return after
    said = set(strings(last))
    known = any(name.name.lower() in said for name in phrase.names)
    if not (known and {n.kind for n in meant.names} & {n.kind for n in phrase.names}):
        return None
    if phrase.is_person:
        scope.mention(to_person(phrase, scope))
    return after


def named_retraction_end(text: Text, at: int, last: list[Goal]) -> int | None:
    """*Forget the blanket*: where a clause ends that leaves undone what was asked, by its name."""
    start = text.phrase_end(_LEAVES, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None or not phrase.name("object", "category", "person") or phrase.places:
        return None
    closed = phrase.end >= len(text) or text.word(phrase.end) in (COMMA, FULL_STOP)
    said = set(strings(last))
    return phrase.end if closed and any(n.name.lower() in said for n in phrase.names) else None


def _spot_after_preposition(text: Text, at: int) -> NounPhrase | None:
    """No, *on the table*: the place, if it is one."""
    located = text.lookup(LOCATIVES, at)
    start = located[1] if located else text.phrase_end(GOALWARDS, at)
    phrase = noun_phrase(text, start) if start else None
    return phrase if phrase and phrase.is_spot else None


def _meant(text: Text, at: int) -> int | None:
    """Put it on the table, *on the counter I mean*: the marker stands behind."""
    if verbs_at(text.words, at) or text.word(at - 1) not in (COMMA, FULL_STOP):
        return None
    phrase = noun_phrase(text, at) or _spot_after_preposition(text, at)
    return at if phrase and _past_marker(text, phrase.end) > phrase.end else None


def _past_marker(text: Text, at: int) -> int:
    """Past "I mean" at the end of a correction."""
    start = at + (text.word(at) == COMMA)
    end = text.phrase_end(_BEHIND, start)
    return end if end and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)) else at


def _told_apart(text: Text, at: int, old: ObjectQuery | None) -> int | None:
    """Where *the blue one* begins that tells which cup was meant a sentence before."""
    if old is None or text.word(at - 1) not in (COMMA, FULL_STOP) or old.count not in (None, 1):
        return None
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    if phrase is None or phrase.noun != "one":
        return None
    if text.index.sibling(old.name or "", color=phrase.color, size=phrase.size) != (old.name or ""):
        return None  # the red mug. Now the blue one
    closed = phrase.end >= len(text) or text.word(phrase.end) == FULL_STOP
    told = (phrase.color and not old.color) or (phrase.size and not old.size)
    most = phrase.superlative and (
        not old.superlative or (phrase.superlative == old.superlative and phrase.places)
    )
    return at if closed and (told or most) else None
