"""Renders scenes into a folder, a file a scene; what is there already is not rendered again."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

from training.things import homes
from training.things.frames import Frame, load, save
from training.things.scenes import ODD, USUAL, Scene
from training.things.splits import Split
from training.things.working import each

PICTURES = 4
"""Of a scene; to compile one takes as long as to render one."""
WALKS, STEPS = "walks", 8
"""Folders of pictures on the way to a thing begin so; pictures of a walk, and of a home."""
HOMES = "homes"
OF_NO_KIND = "odd"
"""Folders of scenes with many invented kinds end so."""


def render(
    folder: Path,
    split: Split,
    first: int,
    count: int,
    *,
    jobs: int = 1,
    walks: bool = False,
    odd: bool = False,
) -> list[Path]:
    """Render scenes that are not there yet, or walks through them; all of their files.

    Args:
        folder: of all pictures.
        split: what is in the scenes.
        first: seed of the first.
        count: how many.
        jobs: processes that render.
        walks: pictures on the way to a thing instead of any.
        odd: of scenes in which many things are of invented kinds.
    """
    name = f"{WALKS}-{split}" if walks else split
    into = folder / (f"{name}-{OF_NO_KIND}" if odd else name)
    return _rendered(into, split, first, count, jobs)


def render_homes(folder: Path, first: int, count: int, *, jobs: int = 1) -> list[Path]:
    """Render homes (`homes.looked_at`) that are not there yet; all of their files."""
    return _rendered(folder / HOMES, "judge", first, count, jobs)


def _rendered(into: Path, split: Split, first: int, count: int, jobs: int) -> list[Path]:
    every = [into / f"{seed:06d}.npz" for seed in range(first, first + count)]
    missing = [path for path in every if not path.exists()]
    if missing:
        for _ in each(partial(_scene, split), missing, name=f"render: {into.name}", jobs=jobs):
            pass
    return every


def frames(files: list[Path]) -> Iterator[Frame]:
    """The pictures of scenes, one after the other."""
    for path in files:
        yield from load(path)


def _scene(split: Split, path: Path) -> None:
    if path.parent.name == HOMES:
        save(list(homes.looked_at(int(path.stem), pictures=STEPS)), path)
        return
    scene = Scene(split, int(path.stem), ODD if path.parent.name.endswith(OF_NO_KIND) else USUAL)
    if path.parent.name.startswith(WALKS):
        save(scene.walk(STEPS), path)
        return
    save([one for number in range(PICTURES) if (one := scene.frame(number)) is not None], path)
