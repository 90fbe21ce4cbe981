"""How often: "three times, wave", "do that again", "for each cup on the table, ..."."""

from intents.english.clauses.openings import begins_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import to_object
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.repeating import repeated
from intents.english.sequences import sequence
from intents.english.trouble import NotUnderstood, Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.measures import measure
from intents.english.words.verbs import verbs_at
from intents.goals import Find, ForEach, Goal, GoTo

_EACH = lexicon.phrases("for each,for every,for all,for each of,for all of,for each one of")


def for_each(sentence: Sentence, at: int) -> Found | None:
    """For each cup on the table, bring it to me."""
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(_EACH, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None:
        return None
    query = to_object(phrase, scope)
    kept, scope.object = scope.object, None  # in what follows, "it" is what is held
    goals, end = sequence(sentence.inner(), phrase.end)
    scope.object = kept
    if not goals:
        raise Unclear("What shall I do with each of them?")
    return [ForEach(object=query, goals=tuple(goals))], end


_OF_HOME = lexicon.phrases(
    "in the house,of the house,in the flat,of the flat,in the apartment,of the apartment,"
    "in the home,in the building,there are,that there is,here,in turn,one after another"
)
_INTO = lexicon.phrases("to,into,through,in,around,at")


def for_each_room(sentence: Sentence, at: int) -> Found | None:
    """Go to every room *and say hello*: what follows "and" is done in each of them."""
    text = sentence.text
    ends = [end for sense, end in verbs_at(text.words, at) if sense in ("go", "find")]
    starts = [end for verb in ends for end in (text.phrase_end(_INTO, verb) or verb,)]
    end = next(
        (end for start in starts if (end := text.phrase_end(lexicon.EVERY_ROOM, start))), None
    )
    if end is None:
        return None
    end = text.phrase_end(_OF_HOME, end) or end
    rooms = sentence.text.index.rooms
    if not rooms:
        raise NotUnderstood("I know of no rooms here")
    there: list[Goal] = []
    while text.word(end) == "and" and text.word(end + 1) not in _THEREAFTER:
        found, end = clause_by_itself(sentence, end + 1)
        there += found
    if there and all(isinstance(goal, Find) for goal in there):
        return there, end  # what is looked for is looked for in every room
    return [goal for room in rooms for goal in (GoTo(place=room), *there)], end


_THEREAFTER = lexicon.words("then finally lastly afterwards come return after go back")
"""After "and" these begin what is done once all rooms were gone to."""


def so_many_times(sentence: Sentence, at: int) -> Found | None:
    """Three times, walk around the table."""
    text = sentence.text
    amount = measure(text.words, at)
    if amount is None or amount.kind != "times" or begins_clause(text, amount.end):
        return None
    start = text.phrase_end(lexicon.IN_ALL, amount.end) or amount.end
    goals, end = sequence(sentence.inner(), start)
    return (repeated(goals, amount.value), end) if goals else None


def again(sentence: Sentence, at: int) -> Found | None:
    """Do it again; repeat that three times; repeat twice: ..."""
    text, before = sentence.text, sentence.before
    verb = next((end for sense, end in verbs_at(text.words, at) if sense == "repeat"), None)
    if verb is None:
        return None
    at = verb + (text.word(verb) in ("it", "that", "this", "all", "everything"))
    amount = measure(text.words, at)
    times = amount.value if amount and amount.kind == "times" else 1
    at = amount.end if amount and amount.kind == "times" else at
    after = at + (text.word(at) == COMMA)
    if not before and after < len(text) and verbs_at(text.words, after):
        goals, end = sequence(sentence.inner(), after)
        return repeated(goals, times), end
    if text.words[verb - 2 : verb] in (["do", "it"], ["do", "that"]) and amount is None:
        return None
    last = list(before or sentence.history)
    if not last:
        raise Unclear("What shall I repeat?")
    if text.words[verb - 2] == "do" or text.words[verb - 1] in ("thing", "so"):
        before.clear()  # wave, and do that three times: three times in all
    return repeated(last, times), at
