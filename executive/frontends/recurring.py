"""What comes again and again (a late picture, pulls at a hand): told once, and when it is over.

The journal keeps every time; people would see nothing else for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from executive.journal.journal import Event

AGAIN_S = 5.0
"""What comes again sooner is the same; what lasted so long is worth a word when it is over."""

Key = tuple[str, str, str]


@dataclass
class _Spell:
    """One thing that came, maybe several times.

    Attributes:
        text: what people were told of it.
        began_s, last_s: when it came first, and when it was last there.
        is_on: whether it is there now.
        count: how often it came.
    """

    text: str
    began_s: float
    last_s: float
    is_on: bool
    count: int = 1


class Recurring:
    """Tells what is news of events as they happen."""

    def __init__(self) -> None:
        """Nothing has happened."""
        self._spells: dict[Key, _Spell] = {}

    def news(self, event: Event, text: str) -> Iterator[str]:
        """What people are told at an event: what is over by then, then itself if it is news.

        Args:
            event: of the journal, the next one.
            text: of the event in words; "" if people are not told of such.
        """
        yield from self._over(event.t_s)
        key = _key(event)
        if key is not None and self._is_again(key, event.t_s):
            return
        if key is not None:
            is_on = event.event == "health"
            self._spells.setdefault(key, _Spell(text, event.t_s, event.t_s, is_on))
        elif event.event == "health":
            self._is_well(str(event.data.get("name", "")), event.t_s)
        if text:
            yield text

    def rest(self) -> Iterator[str]:
        """What came more than once and has not been said to be over: nothing comes any more."""
        spells, self._spells = self._spells, {}
        for spell in spells.values():
            if spell.count > 1:
                yield _told(spell)

    def _over(self, now_s: float) -> Iterator[str]:
        over = [
            key
            for key, spell in self._spells.items()
            if not spell.is_on and now_s - spell.last_s >= AGAIN_S
        ]
        for key in over:
            spell = self._spells.pop(key)
            if spell.text and (spell.count > 1 or spell.last_s - spell.began_s >= AGAIN_S):
                yield _told(spell)

    def _is_again(self, key: Key, now_s: float) -> bool:
        """Whether it comes after it was gone for a moment; what changes while it is on is news."""
        spell = self._spells.get(key)
        if spell is None or spell.is_on:
            return False
        spell.count += 1
        spell.last_s, spell.is_on = now_s, key[0] == "health"
        return True

    def _is_well(self, name: str, now_s: float) -> None:
        for (kind, whose, _), spell in self._spells.items():
            if kind == "health" and whose == name and spell.is_on:
                spell.is_on, spell.last_s = False, now_s


def _key(event: Event) -> Key | None:
    """What comes again when an event of the same key does; None of what is told each time."""
    data = event.data
    if event.event == "slip":
        return "slip", str(data.get("side", "")), ""
    if event.event == "health" and data.get("level") != "OK":
        return "health", str(data.get("name", "")), f"{data.get('level')} {data.get('code')}"
    return None


def _told(spell: _Spell) -> str:
    span = f"{spell.last_s - spell.began_s:.1f} s"
    often = f"{spell.count} times in {span}" if spell.count > 1 else span
    return f"over, after {often}: {spell.text}"
