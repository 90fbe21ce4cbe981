"""Which of several kinds is meant by a word that ends them all: the colour may tell it.

Of tea cups and egg cups "the white cup" is a tea cup, where no egg cup is white.
"""

from __future__ import annotations

from collections.abc import Iterable

from intents.english.words.names import NameIndex


def of_color(names: Iterable[str], color: str | None, index: NameIndex) -> list[str]:
    """Those of several names by which something of a colour is called; all where none is said.

    What nobody has said the colour of may be of any.
    """
    if not color:
        return list(names)
    return [name for name in names if {color, ""} & index.looks.get(name, frozenset({""}))]
