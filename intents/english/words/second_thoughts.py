"""Thought better of: "go to the hall. Actually go to the bar. Actually, the hall".

"Actually" alone says nothing. Ahead of the verb that was said before, of its opposite, or of a name
or place without a verb, it takes back what was said; what is done as well ("actually, also ...") is
no second thought.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.verbs import base_form, verbs_at

_ACTUALLY = lexicon.words("actually")
_AS_WELL = lexicon.words("also too well first then afterwards after before and both next")
_OPPOSITES = (("open", "close"), ("open", "shut"), ("lower", "raise"), ("start", "stop"))
_LEADS = lexicon.DETERMINERS | lexicon.words("to in on into onto at from by two three four")
_TELLING = lexicon.words("say tell announce shout whisper repeat ask spell is are was were")


def second_thoughts(tokens: list[Token]) -> list[Token]:
    """The tokens with ", no," for each "actually" that takes back what was said before it."""
    words = [token.text for token in tokens]
    if _ACTUALLY.isdisjoint(words):
        return tokens
    kept: list[Token] = []
    for at, token in enumerate(tokens):
        if at and token.text in _ACTUALLY and _takes_back(words, at):
            kept.pop()
            kept += [Token(COMMA, ","), Token("no", "no"), Token(COMMA, ",")]
        elif not (at and token.text == COMMA and kept and kept[-1].text == COMMA):
            kept.append(token)
    return kept


def _takes_back(words: list[str], at: int) -> bool:
    if words[at - 1] not in (COMMA, FULL_STOP) or not _TELLING.isdisjoint(words[:at]):
        return False
    begin = at + 1 + (words[at + 1 : at + 2] == [COMMA])
    ends = (n for n in range(begin, len(words)) if words[n] in (COMMA, FULL_STOP))
    clause = words[begin : next(ends, len(words))]
    if not clause or not _AS_WELL.isdisjoint(clause):
        return False
    begun = {base_form(word) for word in _firsts(words[:at])}
    if not begun:
        return False
    verb = base_form(clause[0])
    if verbs_at(clause, 0):
        return verb in begun or any(
            {verb, one} == set(pair) for pair in _OPPOSITES for one in begun
        )
    return clause[0] in _LEADS and not any(verbs_at(clause, n) for n in range(len(clause)))


def _firsts(words: list[str]) -> list[str]:
    """The verbs that stand where orders begin."""
    starts = [0, *(n + 1 for n, word in enumerate(words) if word in (COMMA, FULL_STOP, "please"))]
    return [words[n] for n in starts if n < len(words) and verbs_at(words, n)]
