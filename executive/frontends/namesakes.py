"""Other distributions that own the name of one of our packages: Robot Framework is called `robot`.

Imports then lead elsewhere, or files of both lie in one folder. It is looked for before anything
else of ours is imported, so this file imports none of it.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
from pathlib import Path

import executive

NAMES = ("executive", "intents", "robot", "sim")
OURS = "humanoid-executive"
ROOT = Path(executive.__file__).resolve().parent.parent
CURE = (
    "install humanoid-executive into an environment of its own: "
    "python -m venv .venv && .venv/bin/pip install humanoid-executive"
)


def elsewhere() -> list[str]:
    """Our names that lead to other folders than ours, a sentence each; takes no millisecond."""
    found: list[str] = []
    for name in NAMES:
        spec = importlib.util.find_spec(name)
        origin = spec.origin if spec is not None else None
        if origin is None:
            found.append(f"the package {name!r} is not there, or is not ours")
        elif Path(origin).resolve().parent != ROOT / name:
            found.append(f"the package {name!r} is that of {Path(origin).parent}, not ours")
    return found


def owners() -> list[str]:
    """Other distributions that have a name of ours, a sentence each; reads all metadata (1 s)."""
    by_name = importlib.metadata.packages_distributions()
    return [
        f"{owner} owns the package {name!r} as well"
        for name in NAMES
        for owner in sorted({*by_name.get(name, ())} - {OURS})
    ]


def explained(error: BaseException) -> list[str]:
    """What a failed import of a part of ours comes from; nothing where it is another matter."""
    if not isinstance(error, ImportError) or (error.name or "").partition(".")[0] not in NAMES:
        return []
    why = [*elsewhere(), *owners()]
    return [str(error), *why] if why else []
