"""Renders scenes into a folder, a file a scene; what is there already is not rendered again."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from training.things import homes
from training.things.frames import Frame, load, save
from training.things.scenes import Scene
from training.things.splits import Split

PICTURES = 4
"""Of a scene; to compile one takes as long as to render one."""
WALKS, STEPS = "walks", 8
"""Folders of pictures on the way to a thing begin so; pictures of a walk, and of a home."""
HOMES = "homes"


def bar() -> Progress:
    """How far long work has come, on the terminal."""
    return Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    )


def render(
    folder: Path, split: Split, first: int, count: int, *, jobs: int = 1, walks: bool = False
) -> list[Path]:
    """Render scenes that are not there yet, or walks through them; all of their files."""
    return _rendered(folder / (f"{WALKS}-{split}" if walks else split), split, first, count, jobs)


def render_homes(folder: Path, first: int, count: int, *, jobs: int = 1) -> list[Path]:
    """Render homes (`homes.looked_at`) that are not there yet; all of their files."""
    return _rendered(folder / HOMES, "judge", first, count, jobs)


def _rendered(into: Path, split: Split, first: int, count: int, jobs: int) -> list[Path]:
    every = [into / f"{seed:06d}.npz" for seed in range(first, first + count)]
    missing = [path for path in every if not path.exists()]
    with bar() as progress:
        task = progress.add_task(f"render: {into.name}", total=len(every))
        progress.advance(task, len(every) - len(missing))
        if jobs == 1:
            for path in missing:
                _scene(split, path)
                progress.advance(task)
        else:
            with ProcessPoolExecutor(jobs) as pool:
                for _ in pool.map(_scene, [split] * len(missing), missing):
                    progress.advance(task)
    return every


def frames(files: list[Path]) -> Iterator[Frame]:
    """The pictures of scenes, one after the other."""
    for path in files:
        yield from load(path)


def _scene(split: Split, path: Path) -> None:
    if path.parent.name == HOMES:
        save(list(homes.looked_at(int(path.stem), pictures=STEPS)), path)
        return
    scene = Scene(split, int(path.stem))
    if path.parent.name.startswith(WALKS):
        save(scene.walk(STEPS), path)
        return
    save([one for number in range(PICTURES) if (one := scene.frame(number)) is not None], path)
