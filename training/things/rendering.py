"""Renders scenes into a folder, a file a scene; what is there already is not rendered again."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from training.things.frames import Frame, load, save
from training.things.scenes import Scene
from training.things.splits import Split

PICTURES = 4
"""Of a scene; to compile one takes as long as to render one."""
WALKS, STEPS = "walks", 8
"""Folders of pictures on the way to a thing begin so; pictures of a walk."""


def bar() -> Progress:
    """How far long work has come, on the terminal."""
    return Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    )


def render(
    folder: Path, split: Split, first: int, count: int, *, jobs: int = 1, walks: bool = False
) -> list[Path]:
    """Render scenes that are not there yet, or walks through them; all of their files."""
    name = f"{WALKS}-{split}" if walks else split
    every = [folder / name / f"{seed:06d}.npz" for seed in range(first, first + count)]
    missing = [path for path in every if not path.exists()]
    with bar() as progress:
        task = progress.add_task(f"render: {name}", total=len(every))
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
    scene = Scene(split, int(path.stem))
    if path.parent.name.startswith(WALKS):
        save(scene.walk(STEPS), path)
        return
    save([one for number in range(PICTURES) if (one := scene.frame(number)) is not None], path)
