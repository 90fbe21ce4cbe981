"""What "and", "or" and "nor" join, of whatever kind: "A and B", "A, B or C", "neither A nor B"."""

from collections.abc import Callable
from typing import Literal, NamedTuple, TypeVar

from intents.english.clauses.openings import otherwise_end
from intents.english.trouble import Unclear
from intents.english.words.lexer import COMMA
from intents.english.words.lexicon import phrases
from intents.english.words.text import Text
from intents.goals import AllOf, AnyOf, Condition

T = TypeVar("T")
Joint = Literal["and", "or", "nor", ","]

_JOINTS: dict[tuple[str, ...], Joint] = {
    words: joint
    for joint, said in (
        ("and", "and,and also,but,but also,and that,as well as,and if,and only if,but only if,"
                "and both"),
        ("or", "or,or else,or if,or that,or maybe,or either"),
        ("nor", "nor,and neither,nor if"),
    )
    for words in phrases(said)
}  # fmt: skip  # pyright: ignore[reportAssignmentType]


class Link(NamedTuple):
    """A word that joins what stands before it to what begins at ``start``."""

    joint: Joint
    start: int


def link_at(text: Text, at: int) -> Link | None:
    """The "and" or "or" at a word, with a comma before it or without; or just a comma."""
    start = at + (text.word(at) == COMMA)
    found = text.lookup(_JOINTS, start)
    if found and not otherwise_end(text, start):
        return Link(*found)
    return Link(",", start) if start > at else None


def coordinated(
    text: Text, first: T, end: int, read: Callable[[Link], tuple[T, int] | None]
) -> tuple[list[T], Joint, int]:
    """What is joined to the first of several things, what joins them, and where they end.

    Commas join where "and" or "or" stands before the last. Where there is but one, the joint is a
    comma.

    Args:
        text: The sentence.
        first: What was read.
        end: Where it ends.
        read: Reads one more behind a link; None if there is none.

    Raises:
        Unclear: Some are joined by "and", others by "or".
    """
    items, joint, ends, kept = [first], ",", end, 1
    joints: set[Joint] = set()
    while True:
        link = link_at(text, end)
        found = read(link) if link else None
        if link is None or found is None:
            break
        items.append(found[0])
        end = found[1]
        if link.joint != ",":
            joints.add(link.joint)
            joint, ends, kept = link.joint, end, len(items)
    if len(joints) > 1:
        raise Unclear("With both “and” and “or”: which belong together? Please say it one by one.")
    return items[:kept], joint, ends


def combined(conditions: list[Condition], joint: Joint) -> Condition:
    """One condition of several that are joined: all of them, or any."""
    if len(conditions) == 1:
        return conditions[0]
    return AnyOf(of=tuple(conditions)) if joint == "or" else AllOf(of=tuple(conditions))
