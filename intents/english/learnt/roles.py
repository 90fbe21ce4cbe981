"""What a sentence asks for, and what each name in it has to do with that.

Two fields say it: one of a single place, whose labels are what can be asked for, and one over the
words, whose labels are what a name is to that. Both look at names by their kind only, so that what
was learnt in one world holds in another.
"""

from itertools import groupby, pairwise
from typing import Any, Literal, NamedTuple, cast

from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.looks import Said, looks, said
from intents.english.words import lexicon
from intents.english.words.names import NameIndex

Role = Literal["what", "who", "from", "to"]
"""What a name is: the thing, the person, where one of them is, where or to whom it is to come."""
ASK, IDLE, SEVERAL = "ask", "idle", "several"
"""What a sentence may be that is no order: something to ask about, nothing to do, several orders.
An order goes by the type of its goal, and by its kind where that says more: "gesture nod"."""
NOTHING = "-"
"""What a name is that has nothing to do with it."""
_LISTED = ("bring", "place", "pick", "find")
"""What is done with several things at once."""
_SPEAKS = 0.1
"""A word of at least so much weight speaks for an act [log odds]."""
_SELF = lexicon.words("me us here")


def act_of(goal: dict[str, Any]) -> str:
    """What a goal, as JSON, is called."""
    kind: str = goal["goal"]
    if kind == "switch":
        return "switch_on" if goal["on"] else "switch_off"
    if kind == "go_to" and "by" in goal:
        way, amount = next(iter(goal["by"].items()), ("forward_m", 0.0))
        return _WAYS[way][amount < 0]
    told = goal.get(
        {"gesture": "kind", "report": "topic", "balance": "mode", "tell": "property"}.get(kind, "")
    )
    return f"{kind} {told}" if told else "bring" if kind == "give" else kind


_WAYS = {
    "forward_m": ("forward", "back"), "left_m": ("left", "right"),
    "turn_rad": ("turn_left", "turn_right"),
}  # fmt: skip


class Mention(NamedTuple):
    """A name, a part of one or a word for who speaks, in words ``start`` to ``end``.

    ``names`` is what it can stand for; empty for who speaks.
    """

    start: int
    end: int
    names: frozenset[str]


class Meant(NamedTuple):
    """What a sentence asks for.

    Attributes:
        act: What is to be done.
        words: The sentence.
        roles: The mention of each role.
        also: Further things that the same is to be done with.
        idle: Mentions that have nothing to do with it.
        speaking: Words that were learnt to speak for this act.
        sure: How likely the least likely of all that is [0..1].
    """

    act: str
    words: list[Said]
    roles: dict[Role, Mention]
    also: list[Mention]
    idle: list[Mention]
    speaking: frozenset[str]
    sure: float


def mentions(words: list[Said], index: NameIndex) -> list[Mention]:
    """The names in a sentence, in order."""
    plain = [word.raw.lower().replace("’", "'") for word in words]
    found: list[Mention] = []
    at = 0
    while at < len(plain):
        match = index.match(plain, at) if plain[at][0].isalnum() else None
        little = plain[at] in lexicon.FUNCTION_WORDS
        if match and not (match.end == at + 1 and little):
            found.append(Mention(at, match.end, frozenset(n.name for n in match.names)))
            at = match.end
            continue
        parts = () if little else index.partial(plain[at])
        if parts or plain[at] in _SELF:
            found.append(Mention(at, at + 1, frozenset(n.name for n in parts)))
        at += 1
    return found


def act_looks(words: list[Said], chain: list[list[str]]) -> list[str]:
    """The features of a sentence as a whole, out of those of its words."""
    classes = [next(one[2:] for one in place if one.startswith("c=")) for place in chain]
    plain = [
        kind if kind.startswith("name:") else word.raw.lower().replace("’", "'")
        for word, kind in zip(words, classes, strict=True)
    ]
    names = [kind for kind in classes if kind.startswith("name:")]
    order = [kind for kind, _ in groupby(names)]
    verbs = [plain[n] for n, kind in enumerate(classes) if kind == "verb"]
    found = {f"w={word}" for word in plain}
    found |= {f"w,w={one}|{two}" for one, two in pairwise(plain)}
    for (one, two), (_, three) in pairwise(pairwise(plain)):
        found |= {f"w,w,w={one}|{two}|{three}", f"w,.,w={one}|{three}"}
    kinds = ",".join(sorted(set(names)))
    found |= {
        f"order={','.join(order)}", f"kinds={kinds}", f"names={len(order)}", f"first={plain[0]}",
        f"length={min(len(plain) // 3, 6)}", f"verbs={min(len(verbs), 4)}",
    }  # fmt: skip
    if verbs:
        found |= {f"verb={verbs[0]}", f"verb+kinds={verbs[0]}|{kinds}"}
    return sorted(found)


def meant(text: str, index: NameIndex, fields: Fields = LEARNT) -> Meant | None:
    """What a sentence most likely asks for; None if that is nothing of what can be said again.

    Args:
        text: A sentence, without what is known to be background.
        index: The names of its world.
        fields: What was learnt; by default what comes with the package.
    """
    words = said(text)
    if not words:
        return None
    acts, parts = fields["acts"], fields["roles"]
    chain = looks(words, index)
    likely = acts.marginals([act_looks(words, chain)])[0]
    act, sure = acts.labels[int(likely.argmax())], float(likely.max())
    if act == SEVERAL:  # perhaps one with several things
        told = dict(zip(acts.labels, likely.tolist(), strict=True))
        act = max(_LISTED, key=lambda one: told.get(one, 0.0))
    if act in (ASK, IDLE):
        return None
    by_word = parts.marginals(chain)
    roles: dict[Role, Mention] = {}
    idle: list[Mention] = []
    also: list[Mention] = []
    for mention in mentions(words, index):
        whole = by_word[mention.start : mention.end].min(axis=0)
        label = parts.labels[int(whole.argmax())]
        sure = min(sure, float(whole.max()))
        if label == NOTHING:
            idle.append(mention)
            continue
        role = cast("Role", label)
        if role not in roles:
            roles[role] = mention
        elif role == "what" and act in _LISTED and not mention.names & roles[role].names:
            also.append(mention)
        else:
            idle.append(mention)
            sure = min(sure, 1.0 - float(whole.max()))
    at = acts.labels.index(act)
    plain = {word.raw.lower().replace("’", "'") for word in words}
    rows = {word: acts.rows[f"w={word}"] for word in plain if f"w={word}" in acts.rows}
    speaking = frozenset(
        word for word, row in rows.items() if float(acts.weights[row, at]) > _SPEAKS
    )
    return Meant(act, words, roles, also, idle, speaking, sure)
