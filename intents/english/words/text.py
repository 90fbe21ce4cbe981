"""A sentence ready for the grammar: tokens, corrected, without fillers."""

import re
from collections.abc import Collection, Mapping
from copy import copy
from itertools import pairwise
from typing import TypeVar

from intents.english.words.all_over import all_over
from intents.english.words.amounts_behind import counted_first
from intents.english.words.appositions import without_appositions
from intents.english.words.asked_conditions import checked_states, conditional_questions
from intents.english.words.asking import plainly_asked
from intents.english.words.causing import caused
from intents.english.words.colloquial import colloquial
from intents.english.words.contrasts import but_this
from intents.english.words.courtesy import ADDRESSES, courtesy_end
from intents.english.words.dialects import in_standard_words
from intents.english.words.disfluency import fluent, unrepeated
from intents.english.words.existentials import left_behind, uninverted
from intents.english.words.handing_round import handed_round
from intents.english.words.homophones import as_meant
from intents.english.words.learners import in_english_order
from intents.english.words.lexer import COMMA, DASHES, FULL_STOP, QUOTE, Token, tokenize
from intents.english.words.lexicon import (
    ADVERBS,
    ALL,
    DETERMINERS,
    FILLERS,
    FUNCTION_WORDS,
    Phrase,
    phrases,
    words,
)
from intents.english.words.manners import Manner, manners
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.message_frames import with_plain_frames
from intents.english.words.names import Match, NameIndex, index_of
from intents.english.words.nearing import nearest_first
from intents.english.words.notes import in_sentences
from intents.english.words.particles import without_particles
from intents.english.words.passing_through import by_way_of
from intents.english.words.pauses import pauses_as_waits
from intents.english.words.precise import plain_quantities
from intents.english.words.presence import being_there
from intents.english.words.purposes import without_purposes
from intents.english.words.question_frames import plainly_put
from intents.english.words.repairs import as_one_marker, repaired
from intents.english.words.second_thoughts import second_thoughts
from intents.english.words.singling_out import singled_out
from intents.english.words.spelling import KNOWN_WORDS, speller_of
from intents.english.words.superlatives import listed_superlatives
from intents.english.words.taking_back import interruptions
from intents.english.words.texting import spelled_out
from intents.english.words.titles import without_titles
from intents.english.words.verbs import FIRST_WORDS, participle_base, verbs_at
from intents.english.words.ways import hauled, in_order, laid, led, tells_first
from intents.english.words.whatever import all_but, all_there_is
from intents.english.words.whereabouts import whereabouts
from intents.vocabulary import Vocabulary

T = TypeVar("T")
_LONGEST_PHRASE = 7
"""The longest phrase of any table that is looked up: "go on with what you were doing"."""
_LONGEST_FILLER = max(map(len, FILLERS))
_REPEATED = words("that no stop bye her had wait")
_BEFORE_VERBS = words(", . and then to please you")
_CALLS = words("hey hi hello ok okay dear yo")
_CHECKED = [[word] for word in ("not", "find", "see", "spot", "locate")]
"""After "if you can" these make a condition of it."""
_ASKED_OF = words("you i me us we not")
_MODALS = words("might may can could would")
_PASTS = {"came": "come", "went": "go", "took": "take", "gave": "give", "saw": "see"}
"""Pasts that are no participles."""
_WISHING = words("would it i we")
_ACCOMPANY = words("go come walk stay be is am was wrong matter up do deal along")
"""What "with you" belongs to; else it is only taken along."""
_PREDICATES = words(
    "about around ringing shut closed there here still not gone empty full open closed in on at "
    "under behind near next missing away wanted needed required needing wanting "
    "standing sitting lying hanging switched turned gonna going blocked locked"
)
"""What follows "the bottle's" where that is no owner."""
_WISHES = phrases(
    "need,want,going to need,going to want,have to have,have got to have,could do with,could use,"
    "could murder,would kill for,wanting,needing,will need,gonna need,any chance of,"
    "any chance of getting,is there any chance of,would murder,would there be any chance of,"
    "me wants,me needs,me want,me need,fancy"
)
"""How a wish begins whose subject goes without saying: "need a screwdriver here"."""
_CASES = words("on onto in into to from off under behind at")
_POLITE = words("please thanks")
_ONCE = words("once when after until before as")
_FILLER_STARTS = frozenset(phrase[0] for phrase in FILLERS)
_TELLING = words("say tell inform know announce remind shout whisper")
_MESSAGE_BEGINS = words("that is are am was were has have will can 's 're")
"""After a word for telling one of these, or "to" and a verb, is part of what is to be told."""
_ASKS_BACK = words("me us what where who how which whether if why when")
"""Who wants to know something tells nothing."""
_OF_MESSAGE = phrases(
    "now,right now,right away,at once,straight away,immediately,as soon as possible,asap,for now,"
    "at the moment,at this moment,at present,for the moment,carefully,gently,quickly,slowly,safely,"
    "fast,properly,neatly,nicely,tidily,possibly,perhaps,maybe,i think,i guess,basically,actually,"
    "urgently,one by one,one at a time,in turn,as fast as possible,as quickly as possible,"
    "if possible,when you can,if you can,if you like,if you want,this instant,without delay"
)
"""Fillers that say something where they stand in words that are passed on."""


_PACE = re.compile(
    r"\b((very|really|so|more|extremely|super|nice and|as) )*"
    r"(slowly|slower|slow|fast|faster|quickly|swiftly|leisurely)"
    r"( as (you can|possible|you like))?(?=[ ,.!?;]*(?:$|\b))",
    re.IGNORECASE,
)
"""How fast something is to be done; a goal has no slot for it."""


_TABLES: dict[int, tuple[Collection[Phrase], dict[str, int]]] = {}
_MOST_TABLES = 512
"""So many tables are kept by identity; the grammar has a third of that."""


def _longest_by_first(table: Collection[Phrase]) -> dict[str, int]:
    """How many words the longest phrase of a table has, by its first word; kept with the table."""
    kept = _TABLES.get(id(table))
    if kept is not None and kept[0] is table:
        return kept[1]
    longest: dict[str, int] = {}
    for phrase in filter(None, table):
        longest[phrase[0]] = max(longest.get(phrase[0], 0), min(len(phrase), _LONGEST_PHRASE))
    if len(_TABLES) >= _MOST_TABLES:
        _TABLES.clear()
    _TABLES[id(table)] = (table, longest)
    return longest


class Text:
    """The tokens of what was said, with the names that stand in it.

    Attributes:
        tokens: Without fillers, spelling corrected.
        words: Their lower-case texts.
        index: The names of the vocabulary.
        corrections: What was written, and what it was taken for.
        asks: It ends with a question mark.
        polite: "Please" was said, so something is asked for.
        pace: How fast things are to be done, as it was said; empty if nothing was.
        all_over: All the home was spoken of, as in "how many cups are in the house?".
        manners: Whether they are to be done at once, without an end or later, as it was said.
    """

    def __init__(self, text: str, vocabulary: Vocabulary) -> None:
        """Tokenize, correct and drop fillers."""
        index = index_of(vocabulary)
        self.index: NameIndex = index
        speller = speller_of(vocabulary)
        corrected: list[Token] = []
        tokens = interruptions(_without_name(tokenize(text), self.index), self.index)
        tokens = with_plain_frames(tokens, self.index)
        tokens = counted_first(plainly_put(tokens, self.index), self.index)
        tokens, self.corrections = spelled_out(listed_superlatives(tokens), self.index)
        tokens = without_particles(second_thoughts(tokens), self.index)
        tokens = in_sentences(tokens, self.index)
        tokens = without_purposes(in_english_order(tokens, self.index), self.index)
        begins = True
        pace = _PACE.search(text)
        self.pace = pace.group().strip() if pace else ""
        self.asks = text.rstrip(" \"'”)").endswith("?")
        self.polite = any(token.text in _POLITE for token in tokens)
        for token in tokens:
            meant = speller.correct(token.text, begins=begins)
            begins = token.text in _BEFORE_VERBS
            if meant == [token.text]:
                corrected.append(token)
            else:
                self.corrections.append((token.raw, " ".join(meant)))
                # What is only passed on, as in "say ...", is said as it was written.
                raws = [token.raw] if len(meant) == 1 else meant
                corrected += [Token(w, raw) for w, raw in zip(meant, raws, strict=True)]
        corrected = [
            t for t, b in zip(corrected, [Token("", ""), *corrected], strict=False)
            if t.text != b.text or not t.text.isalpha() or t.text in _REPEATED
        ]  # fmt: skip
        corrected, alike = as_meant(corrected, self.index)
        self.corrections += alike
        corrected = _wished(pauses_as_waits(plain_quantities(repaired(as_one_marker(corrected)))))
        corrected = but_this(all_but(all_there_is(corrected)))
        corrected = without_appositions(corrected, self.index)
        corrected = plainly_asked(without_titles(corrected, self.index), self.index)
        self.manners: list[Manner]
        corrected, self.manners = manners(corrected)
        flowing = led(laid(whereabouts(fluent(corrected, self.index), self.index)))
        ordered = in_order(by_way_of(hauled(flowing, self.index), self.index), self.index)
        plain = singled_out(_without_fillers(ordered, self.index), self.index)
        plain = _unfinished(
            unrepeated(being_there(conditional_questions(checked_states(plain), self.index)))
        )
        plain = colloquial(in_standard_words(plain, self.index))
        plain = nearest_first(handed_round(caused(plain, self.index), self.index), self.index)
        plain, self.all_over = all_over(plain, self.index, lambda said: _in_message(said, index))
        self.tokens: list[Token] = uninverted(left_behind(plain))
        self.words: list[str] = [t.text for t in self.tokens]
        self._matches: dict[int, Match | None] = {}
        self._before_nouns = DETERMINERS | ALL | NUMBER_WORDS | {"no"} | set(self.index.colors)

    def __len__(self) -> int:
        return len(self.words)

    def word(self, at: int) -> str:
        """The word at a position, or a full stop beyond the ends."""
        return self.words[at] if 0 <= at < len(self.words) else FULL_STOP

    def name_at(self, at: int) -> Match | None:
        """The longest name of the vocabulary that begins at a word."""
        if at not in self._matches:
            known = 0 <= at < len(self.words)
            match = self.index.match(self.words, at) if known else None
            small = match and match.end == at + 1 and self.words[at] in FUNCTION_WORDS
            small = small and self.word(at - 1) not in self._before_nouns
            self._matches[at] = None if small else match
        return self._matches[at]

    def lookup(self, table: Mapping[Phrase, T], at: int) -> tuple[T, int] | None:
        """What the longest phrase of a table at a word means, and where it ends."""
        for end in range(self._farthest(table, at), at, -1):
            phrase = tuple(self.words[at:end])
            if phrase in table:
                return table[phrase], end
        return None

    def phrase_end(self, table: Collection[Phrase], at: int) -> int | None:
        """Where the longest phrase of a set at a word ends."""
        for end in range(self._farthest(table, at), at, -1):
            if tuple(self.words[at:end]) in table:
                return end
        return None

    def _farthest(self, table: Collection[Phrase], at: int) -> int:
        """Where a phrase of a table that begins with a word may end at most."""
        if at >= len(self.words):
            return at
        begins = _longest_by_first(table) if at >= 0 else None
        longest = _LONGEST_PHRASE if begins is None else begins.get(self.words[at], 0)
        return min(len(self.words), at + longest)

    def without(self, spans: Collection[tuple[int, int]], *, joined: bool = False) -> "Text":
        """The text without the words of some segments, and without the signs left over.

        Args:
            spans: From where to where the segments stand.
            joined: What stands before and after a segment between commas is one clause.
        """
        gone = {at for start, end in spans for at in range(start, end)}
        for start, end in spans:
            goes_on = (
                joined or self.word(end + 1) in _CASES
            )  # put the cup, bless it, *on* the table
            if goes_on and self.word(start - 1) == self.word(end) == COMMA:
                gone |= {start - 1, end}
        kept: list[Token] = []
        for at, token in enumerate(self.tokens):
            sign = token.text in (COMMA, FULL_STOP)
            if at in gone or (sign and not kept):
                continue
            doubled = kept.pop() if sign and kept[-1].text in (COMMA, FULL_STOP) else token
            kept.append(doubled if doubled.text == FULL_STOP else token)
        left, kept = copy(self), fluent(kept, self.index)
        left.tokens, left.words, left._matches = kept, [t.text for t in kept], {}
        return left

    def set_apart(self, places: Collection[int]) -> "Text":
        """The text with a comma before each of some words."""
        apart = copy(self)
        apart.tokens = []
        for at, token in enumerate(self.tokens):
            apart.tokens += [Token(COMMA, "")] * (at in places) + [token]
        apart.words, apart._matches = [t.text for t in apart.tokens], {}
        return apart

    def raw(self, start: int, end: int) -> str:
        """What was written from one word to another."""
        said = ""
        for token in self.tokens[start:end]:
            glued = token.text in (COMMA, FULL_STOP) or token.raw.lower().startswith(("'", "n't"))
            said += token.raw if glued or not (said and token.raw) else " " + token.raw
        return said.rstrip(" ,;.")


def _without_name(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Juno, ...; hey Juno, ...: without what the robot is called."""
    words = [t.text for t in tokens[:3]]
    at = 1 if words and words[0] in _CALLS else 0
    if len(tokens) < at + 3 or words[at + 1 : at + 2] != [COMMA]:
        return tokens
    known = (
        index.match([words[at]], 0)
        or index.partial(words[at])
        or words[at] in KNOWN_WORDS
        or not words[at].isalpha()
    )
    return tokens if known else tokens[at + 2 :]


def _without_fillers(tokens: list[Token], index: NameIndex) -> list[Token]:
    words = [t.text for t in tokens]
    kept: list[Token] = []
    said: list[str] = []
    at = 0
    while at < len(tokens):
        said += [token.text for token in kept[len(said) :]]
        end = _filler_end(words, at) if words[at] in _FILLER_STARTS else _adverb_end(words, at)
        end = max(end or 0, courtesy_end(words, at, kept=said) or 0) or None
        called = at and tokens[at - 1].raw in DASHES and words[at] in ADDRESSES  # in passing
        named = end is not None and any(index.match(words, n) for n in range(at, end))
        passed_on = end is not None and tuple(words[at:end]) in _OF_MESSAGE
        passed_on = passed_on and _in_message(said, index)
        passed_on = passed_on or tells_first(words, at)
        if end is None or named or called or passed_on or said[-1:] == ["say"]:
            kept.append(tokens[at])
            at += 1
            continue
        if words[at] == "robot" and kept and kept[-1].text in DETERMINERS:
            kept.append(tokens[at])
        elif end < len(words) and words[end] == COMMA and (not kept or kept[-1].text == COMMA):
            end += 1
            if kept and _is_verb_alone(said):
                kept.pop()  # go, *if you please,* to the hall
                said.pop()
        at = end
    while kept and kept[-1].text in (COMMA, FULL_STOP):
        kept.pop()
    return kept


def _is_verb_alone(said: list[str]) -> bool:
    """Whether a clause before a comma is nothing but its verb."""
    begin = max(
        (n + 1 for n, word in enumerate(said[:-1]) if word in (COMMA, FULL_STOP)), default=0
    )
    clause = said[begin:-1]
    return bool(clause) and any(end == len(clause) for _, end in verbs_at(clause, 0))


def _in_message(said: list[str], index: NameIndex) -> bool:
    """Whether what stands behind these words is still to be told: "tell Leo to eat *slowly*"."""
    begins = message = False
    for at, word in enumerate(said):
        last = said[at - 1] if at else FULL_STOP
        ordered = word in FIRST_WORDS and last in (COMMA, "and", "then")
        if word == FULL_STOP or ordered or word in _ASKS_BACK:
            begins = message = False
        to_do = last == "to" and word not in DETERMINERS | FUNCTION_WORDS
        message |= begins and (word in _MESSAGE_BEGINS or (to_do and not index.match(said, at)))
        begins |= word in _TELLING
    return message and said[-1] not in (COMMA, "and", "then")


def _done_before(tokens: list[Token]) -> list[Token]:
    """*Having closed* the door: after you close the door."""
    for at in range(len(tokens) - 2, 0, -1):
        if tokens[at].text != "having":
            continue
        first = at + 1 + (tokens[at + 1].text in ("first", "already"))
        base = participle_base(tokens[first].text) if first < len(tokens) else None
        if base:
            done = Token(base, tokens[first].raw)
            tokens[at : first + 1] = [Token("after", tokens[at].raw), Token("you", ""), done]
    return tokens


def _wished(tokens: list[Token]) -> list[Token]:
    """Would it be nice if you *waved*: if you wave."""
    words = [t.text for t in tokens]
    asked = words.index("ask") if "ask" in words else len(words)
    if words[asked + 2 : asked + 3] == ["to"] and words[asked + 1] not in _ASKED_OF:
        tokens[asked] = Token("tell", tokens[asked].raw)  # ask Ada to come here
    if words[1:2] == ["one"] and words[0] in _MODALS:
        tokens[1] = Token("i", tokens[1].raw)  # might one trouble you for a pear
    for at in range(2, len(words) if words[:1] and words[0] in _WISHING else 0):
        asked = words[at - 2 : at] == ["if", "you"]
        base = participle_base(words[at]) or _PASTS.get(words[at]) if asked else None
        if base:
            tokens[at] = Token(base, tokens[at].raw)
    return tokens


def _unfinished(tokens: list[Token]) -> list[Token]:
    """Once you *have picked* it up: you pick it up; *need* a screwdriver here: I need one."""
    tokens = _done_before(tokens)
    words = [t.text for t in tokens]
    wished = next((n for n in (6, 5, 4, 3, 2, 1) if tuple(words[:n]) in _WISHES), 0)
    if wished and words[wished : wished + 1] not in (["to"], ["you"], []):
        tokens[:wished] = [Token("i", ""), Token("need", _said(tokens[:wished]))]
    for at in range(len(words) - 2, 0, -1):
        if words[at : at + 2] == ["with", "you"] and words[at - 1] not in _ACCOMPANY:
            tokens[at : at + 2] = [Token("along", f"{tokens[at].raw} {tokens[at + 1].raw}")]
    words = [t.text for t in tokens]
    for at in range(1, len(words) - 1):
        if words[at] == "'s" and words[at + 1] in _PREDICATES:
            tokens[at] = Token("is", tokens[at].raw)
    words = [t.text for t in tokens]
    for at in range(len(words) - 2, 1, -1):
        done = words[at] == "have" and words[at - 1] == "you" and words[at - 2] in _ONCE
        base = participle_base(words[at + 1]) if done else None
        if base:
            tokens[at : at + 2] = [Token(base, tokens[at + 1].raw)]
    return tokens


def _said(tokens: list[Token]) -> str:
    return " ".join(token.raw for token in tokens if token.raw)


_CHECKS = frozenset((look, how) for look in ("check", "see", "look") for how in ("if", "whether"))


def _adverb_end(words: list[str], at: int) -> int | None:
    """Is the cup *still* on the table? Check if it is *still* there. But: stand still."""
    if words[at] not in ADVERBS or at + 1 >= len(words):
        return None
    asked = words[0] in ("is", "are", "do", "does", "what", "where", "how")
    seen = words[at - 1] in ("is", "are") and not _TELLING.intersection(words[:at])
    checked = seen and _CHECKS.intersection(pairwise(words[:at]))
    return at + 1 if asked or checked else None


def _filler_end(words: list[str], at: int) -> int | None:
    for end in range(min(len(words), at + _LONGEST_FILLER), at, -1):
        if tuple(words[at:end]) in FILLERS:
            checked = words[at] in ("if", "when") and words[end : end + 1] in _CHECKED
            return None if checked else end
    return None


__all__ = ["COMMA", "FULL_STOP", "QUOTE", "Text"]
