"""How it is told where something came to be: "it's gone under the sofa", "Leo waits in the hall".

What it did to get there, or does there, changes nothing for who is to fetch it; where it is does.
So both are said as "it is under the sofa", which the readings know.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, LOCATIVES, words
from intents.english.words.names import NameIndex

_IT = words("it they he she")
_MOVED = words(
    "gone rolled fallen fell slid slipped dropped landed went disappeared vanished bounced ended "
    "blown blew got"
)
_STAYS = words(
    "gone stuck wandering roaming waiting walking pacing loitering hovering dozing sleeping asleep "
    "resting hiding lost playing working reading chatting trapped wedged stranded"
)
"""What somebody does, or how something is, where it is; postures tell people apart, and stay."""
_HAS: tuple[list[str], ...] = (
    ["have"],
    ["has"],
    ["is"],
    ["'s"],
    ["must", "have"],
    ["has", "just"],
    ["is", "just"],
    [],
)
_IS = (["is"], ["are"], ["'s"])
_ABOUT = words("about around off away down up over right out all back just again")
_INTO = {"into": "in", "onto": "on"}
_LINKS = words("and but so because cause as think") | {COMMA, FULL_STOP}
_SAYS = words("say tell announce shout whisper repeat sing ask answer write")
_MOST_ABOUT = 2


def whereabouts(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with "is" for how something came to be where it is."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 2, -1, -1):
        begins = at == 0 or said[at - 1] in _LINKS
        end = _subject_end(said, at, index) if begins or said[at] in _IT else None
        where = None if end is None else _where(said, end)
        if end is None or where is None or not _SAYS.isdisjoint(said[:at]):
            continue
        how, raw = said[where], " ".join(t.raw for t in tokens[end:where] if t.raw)
        placed = [Token("is", raw), Token(_INTO.get(how, how), tokens[where].raw)]
        apart = [] if begins else [Token(COMMA, "")]
        tokens = [*tokens[:at], *apart, *tokens[at:end], *placed, *tokens[where + 1 :]]
        said = [token.text for token in tokens]
    return tokens


def _subject_end(said: list[str], at: int, index: NameIndex) -> int | None:
    """Where what something is told of ends."""
    if said[at] in _IT:
        return at + 1
    name = at + (said[at] in DETERMINERS)
    match = index.match(said, name) if name < len(said) else None
    return match.end if match is not None and match.of("object", "person") else None


def _where(said: list[str], at: int) -> int | None:
    """Where it begins to be told where something is, behind what it did to be there."""
    begun = [(at + len(has), _MOVED) for has in _HAS if said[at : at + len(has)] == has]
    begun += [(at + 1, _STAYS) for has in _IS if said[at : at + 1] == has]
    for verb, known in begun:
        if said[verb : verb + 1] == [] or said[verb] not in known:
            continue
        for n in range(verb + 1, min(verb + 2 + _MOST_ABOUT, len(said) - 1)):
            if said[n] in _INTO or any((*said[n:end],) in LOCATIVES for end in (n + 1, n + 2)):
                return n
            if said[n] not in _ABOUT:
                break
    return None
