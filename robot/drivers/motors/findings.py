"""What motors say of themselves before anything is enabled, where their map says otherwise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from robot.errors import DriverError


class Finding(NamedTuple):
    """Something about one joint's motor.

    Attributes:
        joint: its name.
        code: for programs.
        text: what is so, with what was expected and what was read.
        cure: what a person does about it.
        is_grave: whether nothing may be enabled.
    """

    joint: str
    code: str
    text: str
    cure: str
    is_grave: bool = True

    def __str__(self) -> str:
        """As a line for people."""
        return f"{self.joint}: {self.text} ({self.cure})"


Said: TypeAlias = tuple[str, str, str, bool]
"""Of a motor whose joint is known: code, text, cure, whether it is grave."""


def findings(by_joint: Mapping[str, Iterator[Said]]) -> list[Finding]:
    """All that disagrees, in the map's order."""
    return [
        Finding(name, code, text, cure, is_grave=grave)
        for name, said in by_joint.items()
        for code, text, cure, grave in said
    ]


def refuse_grave(found: Iterable[Finding], motors: str) -> None:
    """Refuse to go on. Raises DriverError with everything grave; `motors`: what they are called."""
    if grave := [str(one) for one in found if one.is_grave]:
        raise DriverError(f"the {motors} are not enabled:\n  " + "\n  ".join(grave))
