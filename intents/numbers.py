"""One and many: "1 box", "2 boxes", "0 knives"."""

import msgspec

_IRREGULAR = {
    "knife": "knives", "shelf": "shelves", "loaf": "loaves", "leaf": "leaves", "half": "halves",
    "person": "people", "man": "men", "woman": "women", "child": "children", "mouse": "mice",
    "foot": "feet", "tooth": "teeth", "potato": "potatoes", "tomato": "tomatoes", "quiz": "quizzes",
    "scissors": "scissors", "pliers": "pliers", "glasses": "glasses", "fish": "fish",
    "scarf": "scarves", "wolf": "wolves", "life": "lives", "wife": "wives", "hero": "heroes",
}  # fmt: skip
_HISSING = ("s", "x", "z", "ch", "sh")


def plural(noun: str) -> str:
    """Several of what has a name; of several words the last one is inflected.

    >>> plural("red cup"), plural("box"), plural("toy lorry"), plural("knife")
    ('red cups', 'boxes', 'toy lorries', 'knives')
    """
    before, _, last = noun.rpartition(" ")
    known = _IRREGULAR.get(last.lower())
    if known is not None:
        many = known
    elif last.endswith(_HISSING):
        many = f"{last}es"
    elif last.endswith("y") and last[-2:-1] not in ("", *"aeiou"):
        many = f"{last[:-1]}ies"
    else:
        many = f"{last}s"
    return f"{before} {many}".lstrip()


class Noun(msgspec.Struct, frozen=True):
    """What is counted, as one and as many."""

    one: str
    many: str

    def of(self, number: int) -> str:
        """The form that stands after a number."""
        return self.one if number == 1 else self.many
