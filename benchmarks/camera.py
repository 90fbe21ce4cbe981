"""What a picture of the simulated camera costs: rays and EGL, with and without flaws.

python -m benchmarks.camera --world kitchen --pictures 20
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from robot.errors import ConfigError
from robot.model import description
from robot.reality.studio import Renderer
from sim.simulation import Simulation

SIZES = ((160, 120), (320, 240))
RENDERERS: tuple[Renderer, ...] = ("rays", "egl")
app = typer.Typer(add_completion=False)


def milliseconds(work: Callable[[], object], count: int) -> tuple[float, float]:
    """Least and median processor time of a call [ms], after one that is not counted.

    All threads of this process count: a renderer without a graphics card has its own.
    """
    work()
    spent: list[float] = []
    for _ in range(count):
        begin = time.process_time()
        work()
        spent.append(1e3 * (time.process_time() - begin))
    return min(spent), float(np.median(spent))


@app.command()
def main(
    world: Annotated[str, typer.Option(help="Name or file.")] = "kitchen",
    pictures: Annotated[int, typer.Option(help="How many of each kind.")] = 20,
) -> None:
    robot = description.load("juno")
    table = Table("renderer", "size", "reality", "least ms", "median ms")
    for renderer in RENDERERS:
        for size in SIZES:
            for reality in ("ideal", "real"):
                plant = Simulation(reality).world(world).plant(robot, seed=0)
                try:
                    with plant.camera(renderer=renderer, size=size) as camera:
                        stamps_s = iter(np.arange(1e6) / 10)
                        least, median = milliseconds(lambda: camera.take(next(stamps_s)), pictures)  # noqa: B023
                except ConfigError as error:
                    print(error)
                    continue
                table.add_row(
                    renderer, f"{size[0]} x {size[1]}", reality, f"{least:.1f}", f"{median:.1f}"
                )
    Console().print(table)


if __name__ == "__main__":
    app()
