"""How plainly a sentence is put: what it begins with, and how many of its words say nothing known.

A command like those that the grammar was made with begins with its verb and holds known words and
names only; what strangers say around a wish does not.
"""

import re
from collections.abc import Iterable, Iterator, Sequence

from intents.english.words import lexicon
from intents.english.words.spelling import GRAMMAR_WORDS, KNOWN_WORDS
from intents.english.words.verbs import FIRST_WORDS

_MODALS = lexicon.words("can could would will may might shall should do did")
_ASKING = lexicon.words("what which who whose whom where when why how is are was were does has")
_SPEAKERS = lexicon.words("i i'm i'd i've i'll we we're we'd my our me us")
_OTHERS = lexicon.words(
    "he she they it he's she's they're it's there there's this that these those"
)
_BEFORE = lexicon.words("please and then , . ; robot now you to also")
"""Behind one of these, or at the start, a verb is an order."""
_TOLD = {
    "I took": "spelling", "I pass over": "passed", "I pay no": "unheeded", "I move at": "pace",
    "I take that as": "reworded", "I take “": "others", "I do only": "forbidden",
}  # fmt: skip
"""What the grammar remarks, by how the remark begins."""
_MANY = 4
_WORD = re.compile(r"[\w']+|[,.;!?]")


def is_plainly_put(text: str, named: Iterable[str], *, strange: int = 0) -> bool:
    """Whether a sentence begins with an order, and holds only words of the grammar and names.

    Args:
        text: The sentence.
        named: The names in it, as they are said.
        strange: So many other words it may hold.
    """
    words, names = _split(text, named)
    other = sum(w not in GRAMMAR_WORDS and w not in names and w[0].isalpha() for w in words)
    return other <= strange and _begins(words, names) in ("verb", "modal", "asking", "if")


def _split(text: str, named: Iterable[str]) -> tuple[list[str], set[str]]:
    """The words and signs of a sentence, and those of its names."""
    words = _WORD.findall(text.lower().replace("’", "'"))
    return words, {word for name in named for word in _WORD.findall(name.lower())}


def plainness(text: str, named: Iterable[str], goals: int, told: str) -> Iterator[str]:
    """What a sentence looks like, as features.

    Args:
        text: The sentence.
        named: The names in it, as they are said.
        goals: How many goals were read in it.
        told: What the grammar remarked on it.
    """
    words, names = _split(text, named)
    plain = [word for word in words if word[0].isalpha()]
    other = [word for word in plain if word not in names]
    strange = sum(word not in GRAMMAR_WORDS for word in other)
    unknown = sum(word not in KNOWN_WORDS for word in other)
    begins = _begins(words, names)
    orders = sum(
        word in FIRST_WORDS and word not in names and (not at or words[at - 1] in _BEFORE)
        for at, word in enumerate(words)
    )
    share = strange / max(1, len(other))
    remarks = [kind for start, kind in _TOLD.items() if start in told]
    yield f"begins={begins}"
    yield f"strange={min(strange, _MANY)}"
    yield f"unknown={min(unknown, _MANY)}"
    yield f"share={sum(share > one for one in (0.0, 0.1, 0.2, 0.35, 0.5))}"
    yield f"orders={min(orders, _MANY) - min(goals, _MANY)}"
    yield f"speaks={min(sum(word in _SPEAKERS for word in plain), 3)}"
    yield f"about={min(sum(word in _OTHERS for word in plain), 3)}"
    yield f"begins={begins}|unknown={min(unknown, 2)}|strange={min(strange, 2)}"
    yield from (f"remark={kind}" for kind in remarks)
    if not remarks and not unknown and begins == "verb":
        yield f"clean|{min(strange, 2)}"


def _begins(words: Sequence[str], names: set[str]) -> str:
    """What a sentence begins with, past "please" and who is called."""
    rest = [word for word in words if word not in ("please", ",", "robot", "now", "and", "then")]
    first = rest[0] if rest else ""
    if first in FIRST_WORDS and first not in names:
        return "verb"
    kinds = {
        "modal": _MODALS, "asking": _ASKING, "speaker": _SPEAKERS, "about": _OTHERS, "name": names,
        "if": ("if", "when", "once"), "article": lexicon.DETERMINERS,
    }  # fmt: skip
    return next((kind for kind, known in kinds.items() if first in known), "else")
