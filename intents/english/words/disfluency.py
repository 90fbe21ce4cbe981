"""Disfluencies: false starts, lost words, echoes and stutters, undone before anything is read.

"The - no, forget that"; "put it in the, in the box"; "the, how is it called, the bowl"; "the lamp,
yes, the lamp"; "the lamp I say"; "give me give me". See [Shriberg1994]: what is repaired stands
before the interruption, what it is repaired with behind it. What is taken back by what it means
("no, the blue one") is in :mod:`intents.english.corrections`.

[Shriberg1994] E. Shriberg, Preliminaries to a Theory of Speech Disfluencies, UC Berkeley, 1994.
"""

import re
from collections.abc import Sequence
from itertools import pairwise

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS, base_form

_ARTICLES = lexicon.words("the a an my your our")
_INTERRUPTS = lexicon.words("no sorry wait pardon forget scratch scrap oops i hang hold actually")
"""What a false start breaks off before."""
_HESITATION = re.compile(r"e+h+m+|u+h+m*|u+mm+|e+r+m+|h+m+|m+h+m+|a+h+m+|m{2,}|e+h+r+")
_SOUNDS = lexicon.words("och oh ah er uh um eh ach well uhm hmm hm")
_LOST = lexicon.phrases(
    "what is it called,what was it called,what is it,what was it,what is that called,"
    "what do you call it,what do you call them,what do you call that,what are they called,"
    "how is it called,how do you call it,how do you say,how do you say it,how do they call it,"
    "how is the word,what is the word,what is its name,what is the name,what is the thing,"
    "where was it,where is it,where was that,where is that,which was it,what was it again,"
    "whatsit,whatchamacallit,thingy,thingummy,you know,you know the one"
)
"""What is said while a word is sought."""
_EMPHASIS = lexicon.phrases(
    "yes,yeah,aye,right,i say,i said,i repeat,mind you,i tell you,i mean,that is,exactly"
)
_PREPOSITIONS = frozenset(
    phrase[0] for table in (lexicon.LOCATIVES, lexicon.GOALWARDS, lexicon.SOURCEWARDS)
    for phrase in table
)  # fmt: skip
_LOCATING = frozenset(phrase[0] for phrase in lexicon.LOCATIVES)
_DENIES = lexicon.words("not no except but nor without")
_SAYS = lexicon.words("say tell announce shout whisper repeat sing")
_BEGINS = lexicon.words("so and just then well okay ok um like .")
_STRESSES = lexicon.words("really very absolutely truly absolute")
_RANKED = (
    frozenset(phrase[0] for phrase in lexicon.SUPERLATIVES) | frozenset(lexicon.SIZES) | _STRESSES
)
"""The *really* biggest one."""
_STATES = lexicon.words("is are was were left put forgot")
_BEFORE_SIDES = lexicon.words("the to on at your my of far all a")
"""Before "right" these make it a side."""
_BETWEEN_SIDES = lexicon.words(", and then to the")
_DIRECTIONS = lexicon.words("left right up down ahead straight back forward forwards backwards")
_ASSENTS = lexicon.words("yeah yep")
_SIGNS = (COMMA, FULL_STOP)
_TAKEN_UP = lexicon.words("it them him her there one")
_RESTARTS = lexicon.phrases(
    "i mean,i meant,no i mean,sorry i mean,no,no no,no wait,wait no,no sorry,sorry,or rather"
)
"""What is said before a clause is begun again."""
_BROKEN_OFF = lexicon.words("that to on onto in into from at with for the a an")
"""What nothing can end with."""
_PRONOUNS = lexicon.words("him her them it")
_CLAUSES = lexicon.words("and then but so or if not")
_ASKING = lexicon.words("how where what which who when why")
_MOST_LOST = 3
_FAR = 8
_LONGEST_ECHO = 4
_STUTTERS = (3, 2)


def fluent(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens without false starts and without what is said while a word is sought."""
    kept = _denied_first(_as_one(_without_particles(tokens)))
    kept = _renamed(_named_anew(_restarted(_set_apart(kept, index), index), index), index)
    for at in range(len(kept) - 2, -1, -1):
        if at >= len(kept) - 2 or kept[at].text not in _ARTICLES:
            continue
        after = kept[at + 1].text
        if after == COMMA:
            kept = _resumed(kept, at)
        elif at and after in _PREPOSITIONS and after == kept[at - 1].text:
            del kept[at - 1 : at + 1]  # in the in the box
    return kept


def is_side(words: Sequence[str], at: int) -> bool:
    """Whether "right" goes on from another direction: "look left, then *right*, then up"."""
    before = at - 1
    while before >= 0 and words[before] in _BETWEEN_SIDES:
        before -= 1
    return 0 <= before < at - 1 and words[before] in _DIRECTIONS


def _without_particles(tokens: list[Token]) -> list[Token]:
    """So *like* the cup is on the table, *right*, take it: words that only keep talk going."""
    words = [token.text for token in tokens]
    kept: list[Token] = []
    for at, token in enumerate(tokens):
        before = words[at - 1] if at else FULL_STOP
        after = words[at + 1] if at + 1 < len(words) else FULL_STOP
        goes_on = after in lexicon.DETERMINERS or base_form(after) in FIRST_WORDS
        begun = words[max(0, at - _FAR) : at]
        told = not _STATES.isdisjoint(begun) and before not in _BEFORE_SIDES | FIRST_WORDS
        if _HESITATION.fullmatch(token.text) or _is_nowhere(words, at):
            continue
        if token.text in _ASSENTS and kept and before not in _SIGNS and not _tells(words[:at]):
            if after not in _CLAUSES | {COMMA, FULL_STOP} and before not in _CLAUSES:
                kept.append(Token(COMMA, ""))  # the cup yeah put it there
            continue
        again = token.text in _TAKEN_UP and words[at + 2 : at + 3] == [token.text]
        if again and kept and kept[-1].text == COMMA and after in FIRST_WORDS:
            continue  # the cups, them put them there
        if token.text == "like" and before in _BEGINS and goes_on:
            continue
        if token.text == "right" and after == COMMA and told and not is_side(words, at):
            continue
        if token.text in _STRESSES and before in _ARTICLES | _STRESSES and after in _RANKED:
            continue
        if words[at : at + 2] == ["at", "all"] and before in ("nothing", "anything", "there"):
            continue
        if words[at - 1 : at + 1] == ["at", "all"] and words[at - 2] in ("nothing", "anything"):
            continue
        kept.append(token)
    return kept


def _as_one(tokens: list[Token]) -> list[Token]:
    """The cup, *the one* on the shelf, ...: the cup on the shelf."""
    words = [token.text for token in tokens]
    kept = list(tokens)
    for at in range(len(words) - 4, 0, -1):
        one = words[at : at + 2] == [COMMA, "the"] and words[at + 2] in lexicon.ONES
        begun = max((n + 1 for n in range(at) if words[n] in (COMMA, FULL_STOP)), default=0)
        denied = _DENIES.intersection(words[begun:at]) or words[at - 1] in lexicon.ONES
        if one and words[at + 3] in _LOCATING and not denied:
            kept[at : at + 3] = []
    return kept


def _denied_first(tokens: list[Token]) -> list[Token]:
    """But the markers *no*, as learners say it: but not the markers."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 1, 2, -1):
        closes = at + 1 == len(words) or words[at + 1] in (COMMA, FULL_STOP)
        links = ("only", "just") if words[at] == "not" else ("but",)
        link = next((n for n in range(at - 2, max(-1, at - 6), -1) if words[n] in links), None)
        stated = words[at - 1] in _STATES  # only the blue one is not
        if (
            words[at] in ("no", "not")
            and not stated
            and closes
            and link is not None
            and words[at - 1].isalpha()
        ):
            tokens.insert(link + 1, Token("not", tokens.pop(at).raw))
            words.insert(link + 1, words.pop(at))
    return tokens


def unrepeated(tokens: list[Token]) -> list[Token]:
    """The tokens without what is only said again: "the lamp, yes, the lamp"."""
    kept = list(tokens)
    for at in range(len(kept) - 1, 0, -1):
        if kept[at : at + 1] and kept[at].text in (COMMA, FULL_STOP):
            end = _echo_end(kept, at)
            if end is not None:
                kept[at:end] = []
    return _unstuttered(kept)


def _is_nowhere(words: list[str], at: int) -> bool:
    """I cannot find my keys *anywhere*."""
    if words[at] not in ("anywhere", "anymore"):
        return False
    return not {("not", "find"), ("not", "see")}.isdisjoint(pairwise(words[:at]))


def _tells(begun: list[str]) -> bool:
    """Whether words that are to be said stand behind these."""
    return not _SAYS.isdisjoint(begun)


def _restarted(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Put the pin *I mean put the bin*: begun again with the same verb, or behind a lost word."""
    tokens = _taken_up(tokens, index)
    at, words = 1, [token.text for token in tokens]
    while at < len(tokens):
        start = at + (words[at] == COMMA)
        end = _phrase_end(words, start, _RESTARTS)
        if end is None or _tells(words[:at]):
            at += 1
            continue
        end += words[end : end + 1] == [COMMA]
        begin = _begun_alike(words, at, end)
        if begin is None and words[at] == "i":
            begin = _lost_word(words, at, end, index)
        if begin is None:
            at += 1
            continue
        tokens = tokens[:begin] + tokens[end:]
        at, words = begin + 1, [token.text for token in tokens]
    return tokens


def _set_apart(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Take it to Ada *I mean* to Leo: with the comma that is heard before it."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3, 1, -1):
        if words[at] != "i" or words[at + 1] not in ("mean", "meant") or _tells(words[:at]):
            continue
        named = any(
            (old := index.match(words, n)) and old.end == at for n in range(max(0, at - 3), at)
        )
        anew = at + 2
        anew += words[anew] in _PREPOSITIONS
        anew += words[anew : anew + 1] != [] and words[anew] in lexicon.DETERMINERS
        if named and anew < len(words) and index.match(words, anew) is not None:
            tokens = [*tokens[:at], Token(COMMA, ""), *tokens[at:]]
    return tokens


def _taken_up(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Tell Ada that, *tell her* that lunch is ready: broken off, and taken up with a pronoun."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3, 2, -1):
        end = at
        while end > 1 and words[end - 1] in _SOUNDS | {COMMA}:
            end -= 1
        again = words[at] in FIRST_WORDS | _SAYS and words[at + 1] in _PRONOUNS
        if not again or words[end - 1] not in _BROKEN_OFF or words[at + 2] in _SIGNS:
            continue
        for begin in range(end - 2, max(-1, end - _FAR), -1):
            if words[begin] in _SIGNS:
                break
            same = words[begin] == words[at] and any(
                (match := index.match(words, n)) and match.end == end - 1
                for n in range(begin + 1, end - 1)
            )
            if same:
                return [*tokens[: end - 1], *tokens[at + 2 :]]
    return tokens


def _named_anew(tokens: list[Token], index: NameIndex) -> list[Token]:
    """*The cup... no*, the bowl, bring it: what was named first, and nothing said of it."""
    words = [token.text for token in tokens]
    begin = int(words[:1] != [] and words[0] in lexicon.DETERMINERS)
    named = index.match(words, begin) if begin < len(words) else None
    if named is None or words[named.end : named.end + 1] not in ([COMMA], [FULL_STOP]):
        return tokens
    end = _phrase_end(words, named.end + 1, _RESTARTS) if named.of("object") else None
    if end is None:
        return tokens
    end += words[end : end + 1] == [COMMA]
    anew = end + (words[end : end + 1] != [] and words[end] in lexicon.DETERMINERS)
    known = index.match(words, anew) if anew < len(words) else None
    return tokens[end:] if known is not None and known.of("object") else tokens


def _renamed(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Put two caps, *no sorry, scarves,* in the bin: a name taken back where the clause goes on."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 4, 1, -1):
        start = _phrase_end(words, at + 1, _RESTARTS) if words[at] == COMMA else None
        if start is None or _tells(words[:at]):
            continue
        start += words[start : start + 1] == [COMMA]
        first = start + (words[start : start + 1] != [] and words[start] in lexicon.DETERMINERS)
        new = index.match(words, first) if first < len(words) else None
        olds = ((n, index.match(words, n)) for n in range(max(0, at - _MOST_LOST), at))
        begin, old = next(((n, one) for n, one in olds if one and one.end == at), (at, None))
        if new is None or old is None or words[new.end : new.end + 1] != [COMMA]:
            continue
        alike = {one.kind for one in new.names} & {one.kind for one in old.names}
        if alike and not _PREPOSITIONS.isdisjoint(words[new.end + 1 : new.end + 2]):
            return [*tokens[:begin], *tokens[first : new.end], *tokens[new.end + 1 :]]
    return tokens


def _begun_alike(words: list[str], at: int, end: int) -> int | None:
    """Where the clause begins that is begun again behind a marker with its verb."""
    closes = next((n for n in range(end, len(words)) if words[n] in _SIGNS), len(words))
    begins = words[end : end + 1]
    if not begins or begins[0] not in FIRST_WORDS | _ASKING:
        return None
    if not _TAKEN_UP.isdisjoint(words[end:closes]):
        return None  # the cup, no, take *it* there
    for n in range(at - 1, max(-1, at - _FAR), -1):
        if words[n] == words[end]:
            return n
        if words[n] in _SIGNS or words[n] in _CLAUSES:
            return None
    return None


def _lost_word(words: list[str], at: int, end: int, index: NameIndex) -> int | None:
    """To *eh sha I mean* Aisha: where words begin that nobody knows, said in place of a name."""
    named = end + (words[end : end + 1] != [] and words[end] in lexicon.DETERMINERS)
    if named >= len(words) or index.match(words, named) is None:
        return None
    begin = at
    while begin > 1 and at - begin < _MOST_LOST and _is_lost(words, begin - 1, index):
        begin -= 1
    before = words[begin - 1]
    stays = before in _PREPOSITIONS or before in lexicon.DETERMINERS
    return begin if begin < at and stays else None


def _is_lost(words: list[str], at: int, index: NameIndex) -> bool:
    word = words[at]
    return (
        word.isalpha()
        and word not in lexicon.FUNCTION_WORDS
        and not (word in index.words or word in FIRST_WORDS)
    )


def _resumed(tokens: list[Token], at: int) -> list[Token]:
    """The tokens without the article at ``at`` that a comma breaks off, if something goes on."""
    words = [token.text for token in tokens]
    start, end = at, at + 2
    while end < len(words) and words[end] in _SOUNDS | {COMMA}:
        end += 1
    lost = _phrase_end(words, end, _LOST)
    if lost is not None and words[lost : lost + 1] == [COMMA]:
        end = lost + 1
    word = words[end] if end < len(words) else FULL_STOP
    if word in _PREPOSITIONS and words[at - 1] in _PREPOSITIONS:
        start -= 1  # in the, in the box
    elif word not in _ARTICLES | _INTERRUPTS:
        start = at + 1  # the, um, bowl
        end = end if lost is not None or end > at + 2 else start
    rest = tokens[end:]
    if lost is not None and words[-2:] == ["i", "mean"]:
        del rest[-2:]
    return tokens[:start] + rest


def _echo_end(tokens: list[Token], at: int) -> int | None:
    """Where the echo of what stands before the sign at ``at`` ends."""
    words = [token.text for token in tokens]
    start = at + 1
    marked = _phrase_end(words, start, _EMPHASIS)
    if marked is not None and words[marked : marked + 1] == [COMMA]:
        start = marked + 1
    for size in range(_LONGEST_ECHO, 1, -1):
        same = at >= size and words[at - size : at] == words[start : start + size]
        end = start + size
        if same and words[start] in lexicon.DETERMINERS and not _goes_on(words, end):
            return _past_emphasis(words, end)
    before = words[max(0, at - _LONGEST_ECHO) : at]
    pronoun = words[start + 1 : start + 2] in (["it"], ["them"], ["there"])
    if words[start] in _PREPOSITIONS and words[start] in before and pronoun:
        end = start + 2
        return _past_emphasis(words, end) if _closes(words, end) else None
    return None


def _goes_on(words: list[str], end: int) -> bool:
    """Whether the noun goes on: "the bottle, the bottle *opener*"."""
    word = words[end] if end < len(words) else FULL_STOP
    ends = word in (COMMA, FULL_STOP) or word in lexicon.FUNCTION_WORDS
    return not ends and _phrase_end(words, end, _EMPHASIS) is None


def _closes(words: list[str], end: int) -> bool:
    return end >= len(words) or words[end] in (COMMA, FULL_STOP)


def _past_emphasis(words: list[str], end: int) -> int:
    """Past "I say", and past the comma before what belongs to the clause: ", *on the table*"."""
    begin = end + (words[end : end + 1] == [COMMA])
    marked = _phrase_end(words, begin, _EMPHASIS)
    if marked is not None and _closes(words, marked):
        end = marked
    goes_on = words[end + 1 : end + 2]
    comma = words[end : end + 1] == [COMMA]
    return end + 1 if comma and goes_on and goes_on[0] in _PREPOSITIONS else end


def _unstuttered(tokens: list[Token]) -> list[Token]:
    """Bring me bring me: once; ... *give me give me*, after it was said: not at all."""
    words = [token.text for token in tokens]
    for size in _STUTTERS:
        at = 0
        while at + 2 * size <= len(words):
            said = words[at : at + size]
            plain = all(word.isalpha() for word in said) and not _SAYS.intersection(words[:at])
            end = at + size
            while plain and words[end : end + size] == said:
                end += size
            if end > at + size:
                again = any(words[n : n + size] == said for n in range(at))
                start = at if again else at + size
                del tokens[start:end], words[start:end]
            at += 1
    return tokens


def _phrase_end(words: list[str], at: int, table: frozenset[lexicon.Phrase]) -> int | None:
    """Where the longest phrase of a table at a word ends."""
    longest = min(len(words), at + 5)
    return next((end for end in range(longest, at, -1) if tuple(words[at:end]) in table), None)
