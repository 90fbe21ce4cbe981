"""From probabilities to a name, or to none: a wrong name is worse than no name."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.perception.things.usual_sizes import UsualSizes
from robot.se3 import Array, Vector3

UNKNOWN, NOTHING = "", "nothing"


class Sure(NamedTuple):
    """From which probability on a kind, and a family of kinds, is believed."""

    kind: float
    family: float


class Name(NamedTuple):
    """What a thing is taken for; both empty: unknown.

    Attributes:
        kind: of the catalogue; empty where that is not certain.
        family: of kinds; empty where not even that is certain.
        score: the probability of the narrower of both, or of no name at all.
    """

    kind: str
    family: str
    score: float


class Classes(NamedTuple):
    """What the namer tells apart, which family each kind is of, and how large things of it are."""

    names: tuple[str, ...]
    families: tuple[str, ...]
    sizes: UsualSizes | None = None

    def nothing(self, chances: Array) -> float:
        """How likely it is that there is no thing."""
        return float(chances[self.names.index(NOTHING)])

    def name(self, chances: Array, sure: Sure, size_m: Vector3 | None = None) -> Name:
        """The name of a thing, as narrow as is certain.

        Args:
            chances: probabilities of the classes by looks, shape (n,).
            sure: what is certain.
            size_m: of the thing, longer side, shorter side, height; None: it may be of any size.
        """
        if self.sizes is not None and size_m is not None:
            chances = self.sizes.weighed(chances, size_m, self.names.index(UNKNOWN))
        kinds = [k for k, name in enumerate(self.names) if name not in (UNKNOWN, NOTHING)]
        best = max(kinds, key=lambda k: float(chances[k]))
        if chances[best] >= sure.kind:
            return Name(self.names[best], self.families[best], float(chances[best]))
        totals = dict.fromkeys(self.families, 0.0)
        for k in kinds:
            totals[self.families[k]] += float(chances[k])
        family = max(totals, key=lambda one: totals[one])
        if totals[family] >= sure.family:
            return Name("", family, totals[family])
        return Name("", "", 1.0 - float(chances[best]))


def chances(odds: NDArray[np.floating[Any]], heat: float) -> Array:
    """Probabilities from what the namer says; heat above 1 makes it less sure of itself."""
    scaled = odds.astype(np.float64) / heat
    raised = np.exp(scaled - scaled.max())
    return raised / raised.sum()
