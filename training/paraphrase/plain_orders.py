"""Plain orders to a robot, as competitions and corpora have them, each with its plain words.

What strangers say teaches the choice where the grammar is not to be trusted; from these it learns
where it is: imperatives that name what there is, one to three of them after one another. They are
made up here, over the names of many worlds, by templates of this project's own; the plain words
stand beside each template, so that what the grammar reads is compared, not assumed.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from intents.english.paraphrase.paraphrasing import NOTHING
from intents.vocabulary import Names, Vocabulary
from robot.files import plain_data
from training.marked import Marked
from training.paraphrase.pairs import PAIRS

_TAKE = ("take", "grab", "get", "pick up", "grasp", "retrieve", "collect")
_GO = ("go to", "walk to", "navigate to", "head to", "move to", "drive to", "enter", "head over to")
_FIND = ("find", "locate", "look for", "search for", "spot")
_PUT = ("put", "place", "set", "leave", "position")
_BRING = ("bring", "deliver", "carry", "take", "hand")
_LEAD = ("guide", "lead", "escort", "accompany", "take")
_FRONT = ("", "", "", "", "please ", "could you ", "can you ", "robot, ", "would you please ",
          "robot please ", "now ", "could you please ", "I want you to ")  # fmt: skip
_ALONE = ("", "", "robot, ", "please ")
"""What may stand before a question or a condition."""
_NO_REQUEST = re.compile(r"if |how |what |which ")
_BEHIND = ("", "", "", "", "", " please", ", please", " thanks", " now")
_LINKS = (" and ", ", then ", " and then ", ", ", " , and ", " then ", ". ")


class Template(NamedTuple):
    """Some wordings of one order, and its plain words; ``{o}`` and the like are names.

    Attributes:
        wordings: How it is said; ``{take}`` and the like are verbs.
        plain: The plain words.
        opens: Whether another order may follow that goes on with "it" or "them".
        ends: Whether nothing may follow.
    """

    wordings: tuple[str, ...]
    plain: str
    opens: str = ""
    ends: bool = False


def _templates() -> dict[str, tuple[Template, ...]]:
    """Those that may begin, under an empty string, and those that may follow on something."""
    found: dict[str, list[Template]] = {}
    for line in _HERE.joinpath("plain_orders.tsv").read_text(encoding="utf-8").splitlines()[1:]:
        behind, opens, plain, wordings = line.split("\t")
        one = Template(
            tuple(wordings.split(" / ")),
            plain,
            opens.strip("-").removesuffix("end"),
            opens == "end",
        )
        found.setdefault(behind.strip("-"), []).append(one)
    return {behind: tuple(ones) for behind, ones in found.items()}


_HERE = Path(__file__).parent
_BEHIND_WHAT = _templates()
_NOT_FOR_A_ROBOT = tuple(
    _HERE.joinpath("not_for_a_robot.txt").read_text(encoding="utf-8").splitlines()
)
"""What is asked of a voice assistant: the robot does nothing of it."""
_TOLD = {
    "h": ("waving", "sitting", "standing"), "s": ("biggest", "smallest", "heaviest", "lightest"),
    "c": ("red", "blue", "yellow", "white"), "w": ("shirt", "jacket", "sweater", "coat"),
    "n": ("two", "three", "four"),
    "m": ("dinner is ready", "the meeting starts at ten", "the door is open", "the taxi is here",
          "we are leaving soon", "lunch is at noon"),
    "take": _TAKE, "go": _GO, "find": _FIND, "put": _PUT, "bring": _BRING, "lead": _LEAD,

}  # fmt: skip
_ORDERS_TO_ONE = 8
"""So many orders there are to one that is not for a robot."""
_SLOT = re.compile(r"\{(\w+)\}")


def plain_orders(vocabulary: Vocabulary, world: str, count: int) -> Iterator[tuple[Marked, str]]:
    """Plain orders in a world, each with its plain words; the same for the same world.

    Args:
        vocabulary: The names of the world; it has objects, places, rooms, people and categories.
        world: What it is called.
        count: How many.
    """
    luck = random.Random(world)
    for n in range(count):
        said, plain = _order(luck, _names(luck, vocabulary))
        yield _as_marked(said, vocabulary, world, n), plain
    for said in luck.sample(_NOT_FOR_A_ROBOT, count // _ORDERS_TO_ONE):
        yield _as_marked(said, vocabulary, world, count), NOTHING


def _as_marked(said: str, vocabulary: Vocabulary, world: str, n: int) -> Marked:
    return Marked(said, (False,) * len(said), vocabulary, f"{world} plain{n % 5}", "plain", "", ())


def _names(luck: random.Random, vocabulary: Vocabulary) -> dict[str, tuple[str, ...]]:
    """The names of a sentence: two of a kind are different ones."""

    def some(names: list[str]) -> tuple[str, ...]:
        return tuple(luck.sample(names, min(2, len(names))) or ["thing"])

    places = [one.name for one in vocabulary.places]
    lit = [one for one in places if re.search(r"lamp|light|radio|tv|fan|heater|kettle", one)]
    told = {
        "o": some([one.name for one in vocabulary.objects]),
        "l": some([one for one in places if "door" not in one]),
        "r": some([one.name for one in vocabulary.rooms]),
        "p": some([one.name for one in vocabulary.people]),
        "k": some([one.plural for one in vocabulary.categories]), "d": some(lit or places),
    }  # fmt: skip
    return {key: names * 2 for key, names in told.items()}


def _order(luck: random.Random, names: dict[str, tuple[str, ...]]) -> tuple[str, str]:
    """One to three orders after one another."""
    parts: list[Template] = [luck.choice(_BEHIND_WHAT[""])]
    while len(parts) < luck.choice((1, 2, 2, 3)) and not parts[-1].ends:
        follows = _BEHIND_WHAT.get(parts[-1].opens) if parts[-1].opens else None
        parts.append(luck.choice(follows) if follows else luck.choice(_BEHIND_WHAT[""]))
    link = luck.choice(_LINKS)
    chosen: dict[str, str] = {}

    def filled(text: str) -> str:
        def slot(found: re.Match[str]) -> str:
            key = found[1]
            if key not in chosen:
                known = names.get(key.rstrip("2"))
                chosen[key] = known[key.endswith("2")] if known else luck.choice(_TOLD[key])
            return chosen[key]

        return _SLOT.sub(slot, text)

    said: list[str] = []
    plain: list[str] = []
    for part in parts:
        for key in _VERBS | {"n", "m", "h", "s", "c", "w"}:
            chosen.pop(key, None)
        said.append(filled(luck.choice(part.wordings)))
        plain.append(filled(part.plain))
    asked = _NO_REQUEST.match(said[0])
    text = luck.choice(_ALONE if asked else _FRONT) + link.join(said)
    told = parts[-1].ends or len(parts) > 1
    return text + ("" if told else luck.choice(_BEHIND)), " ; ".join(plain)


_VERBS = frozenset({"take", "go", "find", "put", "bring", "lead"})


def worlds(pattern: str = "*") -> Iterator[tuple[str, Vocabulary]]:
    """The worlds of the pairs that are called so, each with its name."""
    for file in sorted(PAIRS.glob(f"{pattern}.vocab.json")):
        named = plain_data.from_json(file.read_text(encoding="utf-8"))
        yield (
            file.name.removesuffix(".vocab.json"),
            plain_data.fitted(named, Names, file).vocabulary(),
        )
