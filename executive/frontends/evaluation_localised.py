"""Who tells the robot where it is in each case of an evaluation."""

from __future__ import annotations

from executive.evaluation import campaign
from executive.evaluation.campaign import Case
from executive.frontends.composition_root import REALITY
from executive.frontends.options import Eval
from executive.frontends.output import say
from executive.runs import lidar_maps
from robot.messages import AskedLocalisation, LocalisedBy

MOST_NAMED = 3
"""Worlds that are named on one line."""


class Localised:
    """Of a case, what is meant by `--localisation`.

    With "auto" its own lidar finds the robot where a map comes with the package, and nowhere else:
    results are then the same on every machine, whatever maps its user keeps.
    """

    def __init__(self, options: Eval) -> None:
        """Look at no world yet."""
        self._asked: AskedLocalisation = options.localisation
        self._settings = campaign.Settings(REALITY, options.robot)
        self._untold: dict[str, None] = {}

    def __call__(self, case: Case) -> LocalisedBy:
        """Who tells it. Raises ConfigError if the case's world is wrong."""
        asked = self._asked
        if asked != "auto":
            return asked
        where = campaign.where(case, self._settings)

        def note(_text: str) -> None:
            self._untold[where.world.name] = None

        found = lidar_maps.localised(where, "auto", tell=note, shipped_only=True)
        return found.world.localisation

    def say(self) -> None:
        """Name the worlds where an oracle tells it, on one line."""
        worlds = list(self._untold)
        if not worlds:
            return
        more = len(worlds) - MOST_NAMED
        named = ", ".join(worlds[:MOST_NAMED]) + (f" and {more} more" if more > 0 else "")
        say(
            f"an oracle tells the robot where it is in {named}: no map of it comes with the "
            "package (--localisation lidar has it make one: minutes, once)",
            err=True,
        )
