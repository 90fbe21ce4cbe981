"""Which of the things that are seen is which of those that were told.

Every told thing is one seen thing at most, and the other way round; what fits none stays what it
is, an unknown green thing. Where two seen things fit one told thing about as well, it is neither.
A name stays with the thing that has it, wherever that goes, until it is gone or fits no more. What
plainly has another colour than was told is not that thing, whatever else speaks for it.
"""

# pyright: basic
# scipy comes without types.

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment

from robot.messages import ObjectInfo, Place
from robot.perception.sight.belonging import belonging
from robot.perception.sight.likeness import Knowledge, likeness, other_colour, spread_malus
from robot.perception.sight.tracking import Seen

ENOUGH, ENOUGH_AT_ONCE = 0.9, 2.2
"""Likeness from which on a thing is believed to be that, after two looks and after one."""
CLEARER = 0.7
"""By so much it must be likelier than the next thing that nobody has named."""
STAYS = 0.8
"""What speaks for the thing that has the name."""
LEAST = -1.0
"""Below, the name is taken away again."""
NAMED = 0.2
"""What one more name takes: a thing that was told may well be somewhere else."""
HARDLY = 0.01
"""What a name is worth where it is, as long as nothing better comes and it is not taken away."""
SETTLED = 2.0
"""What has a name that is so much likelier than any other is no other thing, seen from afar, too. A
green box was "the green mug" from 2.5 m by 1.1."""
NO_WAY = -50.0


class Recogniser:
    """The names that were given, by track.

    Attributes:
        clear: of the names that were given last, by id, how much likelier it is so than any way of
            naming in which their thing is another told one or none, in logarithms.
        may_be: ids of what things without a name may well be, by track, the likeliest first.
        mistaken: names that have lost their thing when names were given last, as it has another
            name now, or another colour; with what it is, in a word or two.
    """

    def __init__(self, namer: Knowledge) -> None:
        """Know no thing; the namer says what it takes them for."""
        self._namer = namer
        self._told: tuple[ObjectInfo, ...] = ()
        self._plurals: Mapping[str, str] = {}
        self._places: tuple[Place, ...] = ()
        self._number: dict[str, int] = {}
        self.clear: dict[str, float] = {}
        self.may_be: dict[int, tuple[str, ...]] = {}
        self.mistaken: dict[str, str] = {}

    def tell(
        self,
        told: tuple[ObjectInfo, ...],
        plurals: Mapping[str, str],
        places: tuple[Place, ...] = (),
    ) -> None:
        """What things there are, by name, category and colour, and what they may stand on."""
        self._told, self._plurals, self._places = told, plurals, places

    def number(self, name: str) -> int | None:
        """The track that has a name."""
        return self._number.get(name)

    def named(self, tracks: Sequence[Seen]) -> dict[str, Seen]:
        """Give names to tracks, or leave them; every named one by its id."""
        there = {track.number for track in tracks}
        self._number = {id: number for id, number in self._number.items() if number in there}
        self.clear, self.may_be, self.mistaken = {}, {}, {}
        if not tracks or not self._told:
            return {}
        fits = np.array(
            [[self._fit(info, track) for track in tracks] for info in self._told], dtype=np.float64
        )
        stays = np.array(
            [[STAYS * (self._number.get(info.id) == track.number) for track in tracks]
             for info in self._told]
        )  # fmt: skip
        keeps = (stays > 0.0) & (fits > self._least()[:, None])
        chosen, _ = _best(np.where(keeps, np.maximum(fits + stays, NAMED + HARDLY), fits + stays))
        found: dict[str, Seen] = {}
        for row, info in enumerate(self._told):
            column = chosen.get(row)
            if column is not None and self._is_sure(fits, stays, chosen, row):
                found[info.id] = tracks[column]
                self.clear[info.id] = self._else(fits, row, column)
        before, self._number = self._number, {id: track.number for id, track in found.items()}
        self.may_be = self._open(fits, tracks)
        self.mistaken = self._mistaken(before, {track.number: track for track in tracks})
        return found

    def _open(self, fits: np.ndarray, tracks: Sequence[Seen]) -> dict[int, tuple[str, ...]]:
        """What things without a name may be: told things that are surely nowhere else."""
        least, named = self._least(), set(self._number.values())
        rows = [
            row for row, info in enumerate(self._told) if self.clear.get(info.id, 0.0) < SETTLED
        ]
        return {
            track.number: tuple(
                self._told[row].id
                for row in sorted(rows, key=lambda row: -fits[row, column])
                if fits[row, column] > least[row]
            )
            for column, track in enumerate(tracks)
            if track.number not in named
        }

    def _mistaken(self, before: Mapping[str, int], tracks: Mapping[int, Seen]) -> dict[str, str]:
        """What names had taken for their thing, and is another one, with what that is."""
        owners = {number: id for id, number in self._number.items()}
        told = {info.id: info for info in self._told}
        found: dict[str, str] = {}
        for id, number in before.items():
            other = owners.get(number, id)
            if other != id:
                found[id] = told[other].full_name
            elif id not in self._number:
                found[id] = other_colour(tracks[number], told[id].color)
        return {id: what for id, what in found.items() if what}

    def _is_sure(
        self, fits: np.ndarray, stays: np.ndarray, chosen: Mapping[int, int], row: int
    ) -> bool:
        column = chosen[row]
        if stays[row, column] > 0.0:
            return bool(fits[row, column] > self._least()[row])
        if fits[row, column] < ENOUGH:
            return False
        free = [k for k in range(fits.shape[1]) if k not in set(chosen.values())]
        if any(fits[row, column] - fits[row, k] <= CLEARER for k in free):
            return False
        return self._else(fits, row, column) > CLEARER

    def _least(self) -> np.ndarray:
        """What each told thing's name is taken away below, whatever its kind's sizes do."""
        return np.array([LEAST + spread_malus(info.category) for info in self._told])

    def _else(self, worth: np.ndarray, row: int, column: int) -> float:
        """How much worse the best names are with which a thing is not the told one.

        Those that were told alike may change places.
        """
        alike = [k for k, info in enumerate(self._told) if _are_alike(info, self._told[row])]
        without = worth.copy()
        without[alike, column] = NO_WAY
        return _best(worth)[1] - _best(without)[1]

    def _fit(self, info: ObjectInfo, track: Seen) -> float:
        plural = self._plurals.get(info.category, f"{info.category}s")
        if other_colour(track, info.color):
            return NO_WAY
        fit = likeness(track, info, plural, self._namer) + belonging(track, info, self._places)
        is_first = track.looks < 2 and self._number.get(info.id) != track.number
        return fit - (ENOUGH_AT_ONCE - ENOUGH) if is_first else fit


def _are_alike(one: ObjectInfo, other: ObjectInfo) -> bool:
    return (one.category, one.color) == (other.category, other.color)


def _best(worth: np.ndarray) -> tuple[dict[int, int], float]:
    """The best names, track by told thing, and what they are worth in all; none has to be given."""
    over = np.maximum(worth - NAMED, 0.0)
    rows, columns = linear_sum_assignment(-over)
    named = over[rows, columns] > 0.0
    chosen = dict(zip(rows[named].tolist(), columns[named].tolist(), strict=True))
    return chosen, float(over[rows, columns].sum())
