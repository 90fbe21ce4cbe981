"""The names that mean something in one world: objects, places, rooms, people, categories."""

from collections.abc import Iterable, Mapping

import msgspec

MOST_NAMES = 3000
"""Of a vocabulary from a file: ten times those of the largest home; a second to read a sentence."""


class _Entry(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True,
             forbid_unknown_fields=True):  # fmt: skip
    """A name and other words for it."""

    name: str
    synonyms: tuple[str, ...] = ()


class Thing(_Entry, frozen=True, kw_only=True):
    """An object that can be handled, with what tells it from others of the same name.

    Attributes:
        category: Singular name of its category, or empty.
        color: Colour word, or empty.
        size: Size word ("big", "small"), or empty.
    """

    category: str = ""
    color: str = ""
    size: str = ""


class Spot(_Entry, frozen=True, kw_only=True):
    """A place or a room.

    Attributes:
        furniture: It is walked up to; nobody can be in it or on it.
    """

    furniture: bool = False


class Someone(_Entry, frozen=True, kw_only=True):
    """A person known by name."""


class Category(msgspec.Struct, frozen=True):
    """A kind of object, as one and as many."""

    singular: str
    plural: str


class Vocabulary(msgspec.Struct, frozen=True, kw_only=True):
    """All names of a world. Hashable, so that what is built from it can be kept."""

    objects: tuple[Thing, ...] = ()
    places: tuple[Spot, ...] = ()
    rooms: tuple[Spot, ...] = ()
    people: tuple[Someone, ...] = ()
    categories: tuple[Category, ...] = ()

    @classmethod
    def of(
        cls,
        *,
        objects: Iterable[str | Thing] = (),
        places: Iterable[str | Spot] = (),
        rooms: Iterable[str | Spot] = (),
        people: Iterable[str | Someone] = (),
        categories: Mapping[str, str] | None = None,
    ) -> "Vocabulary":
        """A vocabulary from names, or from entries where there is more to say."""
        return cls(
            objects=tuple(Thing(name=o) if isinstance(o, str) else o for o in objects),
            places=tuple(Spot(name=p) if isinstance(p, str) else p for p in places),
            rooms=tuple(Spot(name=r) if isinstance(r, str) else r for r in rooms),
            people=tuple(Someone(name=p) if isinstance(p, str) else p for p in people),
            categories=tuple(Category(s, p) for s, p in (categories or {}).items()),
        )


class Names(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A vocabulary as it stands in a file, where an entry may be a plain name.

    ``{"objects": [{"name", "category"?, "color"?, "size"?, "synonyms"?}], "places": [...],
    "rooms": [...], "people": [...], "categories": {singular: plural}}``
    """

    objects: tuple[str | Thing, ...] = ()
    places: tuple[str | Spot, ...] = ()
    rooms: tuple[str | Spot, ...] = ()
    people: tuple[str | Someone, ...] = ()
    categories: dict[str, str] = {}

    def __post_init__(self) -> None:
        """Count the names.

        Raises:
            ValueError: There are more of them than any sentence is compared with in time.
        """
        entries = (*self.objects, *self.places, *self.rooms, *self.people)
        others = sum(len(entry.synonyms) for entry in entries if not isinstance(entry, str))
        count = len(entries) + others + len(self.categories)
        if count > MOST_NAMES:
            raise ValueError(f"{count} names, with synonyms; at most {MOST_NAMES} are taken")

    def vocabulary(self) -> Vocabulary:
        """The same, with an entry for every name."""
        return Vocabulary.of(
            objects=self.objects,
            places=self.places,
            rooms=self.rooms,
            people=self.people,
            categories=self.categories,
        )
