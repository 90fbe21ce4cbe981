"""Models that others publish: found where people keep them, never copied."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

import robot
from robot.errors import DescriptionError, Problem
from robot.files import quantities as q

CHECKOUT = Path(robot.__file__).resolve().parent.parent
"""The folder that this project is in, where it is run from its sources."""


class Published(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A model with meshes that is not ours to ship.

    Attributes:
        places: folders that may hold it, the first that does is taken; `~` is the home folder, what
            does not begin at a root is looked for beside the description and the checkout.
        without: meshes whose geoms are left out.
        cure: how to get it, for people.
        source: who publishes it, under what licence.
    """

    places: q.Several[str]
    without: tuple[str, ...] = ()
    cure: str
    source: str

    def find(self, file: str, *, description: Path) -> Path:
        """The folder in which `file` lies.

        Raises:
            DescriptionError: naming every place looked at, and the cure; or a place that holds
                more than such a model.
        """
        bases = (description.resolve().parent, CHECKOUT)
        looked: list[str] = []
        for place in self.places:
            for base in bases:
                folder = base / os.path.expanduser(place)  # noqa: PTH111 - never raises
                if _holds_too_much(folder, description):
                    text = f"places: {place} holds more than a published model"
                    cure = "name the folder of that model alone"
                    raise DescriptionError([Problem(text, str(description), suggestion=cure)])
                if (folder / file).is_file():
                    return folder
                if str(folder) not in looked:
                    looked.append(str(folder))
        text = f"the published model {file} is in none of {', '.join(looked)}"
        raise DescriptionError([Problem(text, str(description), suggestion=self.cure)])


def _holds_too_much(folder: Path, description: Path) -> bool:
    """Whether a folder is the root, the user's home or above it, or above the description's own.

    Every mesh and picture of the folder may be read for the model.
    """
    folder = folder.resolve()
    home, own = Path.home().resolve(), description.resolve().parent
    return folder == Path(folder.anchor) or home.is_relative_to(folder) or folder in own.parents
