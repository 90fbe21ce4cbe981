"""`python -m training.things`: teach the two networks that find and name things, and judge them.

Scenes are rendered into a folder (again only those that are missing), the finder learns from them,
then the namer from what the finder finds; thresholds are chosen on other scenes, figures told of
others again, with rooms and kinds that were never learnt. With `--ship` the networks take the place
of those in the package. JAX learns on an accelerator where it finds one, and on one core elsewhere.
"""

from __future__ import annotations

import argparse
import itertools
import math
import os
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")  # one core, no more

import numpy as np

from robot.perception.things import networks as shipped
from robot.perception.things.crops import CHANNELS, NUMBERS, SIDE_PX
from robot.perception.things.eyes import Eyes
from robot.perception.things.inputs import CHANNELS as SEEN
from robot.perception.things.naming import Sure
from robot.perception.things.networks import Finder, Namer
from training.things import export, finding, graphs, judging, naming, walking
from training.things.frames import load
from training.things.networks import Learnt
from training.things.rendering import frames, render, render_homes
from training.things.splits import family, sizes_of_kinds
from training.things.working import bar

STAGES = ("render", "finder", "namer", "choose", "judge")
WALKS_FROM = 50_000
"""The seed of the first walk: none of these scenes is in the other pictures."""
MOST_WRONG, MOST_NAMED = 0.005, 0.05
"""Of the things that thresholds are chosen on, so many may get a wrong name; and of those that
should get none in scenes with many of them."""
SURE_VOTED = 0.999
"""Probability from which a kind is believed that several looks agree on, where no walks are there
to choose it on: single ones may be wrong in the same way, about a kind that was never learnt."""


class Sets(NamedTuple):
    """Files of pictures: to learn from, to choose thresholds on, and five to judge by.

    Those that are called odd are of scenes with many things of invented kinds.
    """

    learn: list[Path]
    choose: list[Path]
    choose_odd: list[Path]
    choose_walks: list[Path]
    judge: list[Path]
    odd: list[Path]
    walks: list[Path]
    odd_walks: list[Path]
    homes: list[Path]


def main() -> int:
    """Render, learn, choose, judge."""
    asked = argparse.ArgumentParser(prog="python -m training.things", description=__doc__)
    asked.add_argument("--folder", type=Path, default=Path("build/things"))
    asked.add_argument("--scenes", type=int, default=150, help="to learn from, 4 pictures each")
    asked.add_argument("--odd", type=int, default=0, help="besides, with things of invented kinds; "
                       "with any, thresholds are chosen on such scenes, too, and it is judged by "
                       "some")  # fmt: skip
    asked.add_argument("--smooth", type=float, default=naming.USUAL.smooth)
    asked.add_argument("--misfits", type=float, default=naming.USUAL.misfits,
                       help="share of known things at sizes that they never have")  # fmt: skip
    asked.add_argument("--first", type=int, default=0, help="seed of the first of them")
    asked.add_argument("--namer-from", type=Path, help="a namer (ONNX) to go on from")
    asked.add_argument("--others", type=int, default=40, help="to choose on, and to judge by")
    asked.add_argument("--walks", type=int, default=20, help="to things, to judge by")
    asked.add_argument("--homes", type=int, default=4, help="made by another generator, likewise")
    asked.add_argument("--finder-steps", type=int, default=300)
    asked.add_argument("--finder-batch", type=int, default=8, help="pictures of a step")
    asked.add_argument("--namer-steps", type=int, default=600)
    asked.add_argument("--namer-batch", type=int, default=96, help="crops of a step")
    asked.add_argument("--jobs", type=int, default=1, help="processes that render and cut out")
    asked.add_argument("--minutes", type=float, default=math.inf, help="a network, at most")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--only", choices=STAGES, action="append")
    asked.add_argument("--ship", action="store_true", help="into the package")
    options = asked.parse_args()
    only = options.only or STAGES
    home: Path = shipped.HERE if options.ship else options.folder
    finder, namer = home / shipped.FINDER.name, home / shipped.NAMER.name
    sets = _rendered(options)
    if "finder" in only:
        shape: tuple[Any, ...] = ("rows", "columns", SEEN)
        made = finding.learn(
            finding.gathered(sets.learn, jobs=options.jobs), steps=options.finder_steps,
            batch=options.finder_batch, seed=options.seed, minutes=options.minutes,
        )  # fmt: skip
        learnt = _learn("learn the finder", made, options.finder_steps)
        export.write(finder, finding.GRAPH, learnt, {graphs.IMAGE: shape}, {})
    if "namer" in only:
        _write_namer(namer, _named(sets, finder, options))
    if "choose" in only:
        export.note(namer, _chosen(Eyes(Finder(finder), Namer(namer)), sets))
    if "judge" in only:
        _judge(Eyes(Finder(finder), Namer(namer)), sets)
        sizes = [round(path.stat().st_size / 1e6, 2) for path in (finder, namer)]
        print(f"files {sizes} MB")
    return 0


def _rendered(options: argparse.Namespace) -> Sets:
    """Every picture there has to be; those that are there stay."""
    only = set(options.only or STAGES)
    learns, judges = only & {"render", "finder", "namer"}, only & {"render", "choose", "judge"}
    seen = partial(render, options.folder, jobs=options.jobs)
    odd = partial(seen, odd=True)
    others = options.others if judges else 0
    walks = options.walks if judges else 0
    others_odd, walks_odd = (others, walks) if options.odd else (0, 0)
    return Sets(
        learn=[*seen("train", options.first, options.scenes if learns else 0),
               *odd("train", options.first, options.odd if learns else 0)],
        choose=seen("choose", 0, others),
        choose_odd=odd("choose", 0, others_odd),
        choose_walks=[*seen("choose", WALKS_FROM, walks_odd // 2, walks=True),
                      *odd("choose", WALKS_FROM, walks_odd // 2, walks=True)],
        judge=seen("judge", 0, others),
        odd=odd("judge", 0, others_odd // 2),
        walks=seen("judge", WALKS_FROM, walks, walks=True),
        odd_walks=odd("judge", WALKS_FROM, walks_odd // 4, walks=True),
        homes=render_homes(options.folder, 0, options.homes if judges else 0, jobs=options.jobs),
    )  # fmt: skip


def _named(sets: Sets, finder: Path, options: argparse.Namespace) -> Learnt:
    """Cut out what the finder finds, and learn what it is."""
    lessons = naming.taught(sets.learn, finder, seed=options.seed, jobs=options.jobs)
    told = np.bincount(lessons.names, minlength=len(naming.CLASSES))
    print(f"{len(lessons.names)} crops, {told[-2]} of no kind, {told[-1]} of nothing")
    made = naming.learn(
        lessons, steps=options.namer_steps, batch=options.namer_batch, seed=options.seed,
        minutes=options.minutes, since=options.namer_from,
        manner=naming.Manner(options.smooth, options.misfits),
    )  # fmt: skip
    return _learn("learn the namer", made, options.namer_steps)


def _judge(eyes: Eyes, sets: Sets) -> None:
    """Figures on pictures that nothing was learnt or chosen from."""
    f1_at = judging.best_f1(judging.looked(eyes, frames(sets.choose)), eyes)
    print(judging.report(judging.looked(eyes, frames(sets.judge)), eyes, f1_at))
    classes, sures = eyes.namer.classes, (eyes.namer.sure, eyes.namer.voted)
    for files in (sets.walks, sets.odd_walks):
        walks = walking.walks(eyes, (list(load(path)) for path in files))
        print("\n".join(walking.told(walks, classes, sure) for sure in sures if walks))
    if sets.odd:
        print("with invented kinds:")
        print(judging.report(judging.looked(eyes, frames(sets.odd)), eyes, f1_at))
    print("homes:")
    print(judging.report(judging.looked(eyes, frames(sets.homes)), eyes, f1_at))


def _learn(name: str, made: Iterator[tuple[float, Learnt]], steps: int) -> Learnt:
    """The last of what is learnt; how it goes is told."""
    losses: list[float] = []
    learnt: Learnt | None = None
    with bar() as progress:
        task = progress.add_task(name, total=steps)
        for loss, now in made:
            learnt = now
            losses.append(loss)
            mean = float(np.mean(losses[-100:]))
            progress.update(task, advance=1, description=f"{name}: loss {mean:.3f}")
    print(f"{name}: {len(losses)} steps")
    for start in itertools.islice(range(0, len(losses), 200), 1, None):
        print(f"{name}: steps to {start}: {np.mean(losses[start - 200 : start]):.3f}")
    assert learnt is not None
    return learnt


def _chosen(eyes: Eyes, sets: Sets) -> dict[str, Any]:
    """How sure it is, made to fit scenes that nothing was learnt from; and what is sure enough."""
    plain = judging.looked(eyes, frames(sets.choose))
    seen = [one for one in plain if one.seen is not None and not one.is_double]
    right = np.array([naming.CLASSES.index(one.kind) for one in seen])
    logs = np.log(np.maximum(np.array([one.seen.chances for one in seen if one.seen]), 1e-9))
    heats = np.linspace(0.6, 2.5, 39).tolist()

    def unlikely(heat: float) -> float:
        raised = logs / heat
        raised -= np.log(np.exp(raised).sum(axis=1, keepdims=True))
        return -float(raised[np.arange(len(right)), right].mean())

    heat = min(heats, key=unlikely)
    sigmas = judging.mahalanobis(seen)
    spread = float(np.percentile(sigmas, 90.0)) / 2.5  # 90 % of a Gaussian in space are within
    eyes.namer.heat = heat
    sure = _sure(eyes, sets)
    print(f"heat {heat:.2f}, spread {spread:.2f}, sure {sure.kind:.3f}, {sure.family:.3f}")
    walks = walking.walks(eyes, (list(load(path)) for path in sets.choose_walks))
    voted = walking.sure_voted(walks, eyes.namer.classes, sure, most_wrong=MOST_WRONG)
    return {"sure_kind": sure.kind, "sure_family": sure.family, "heat": heat, "spread": spread,
            "sure_voted_kind": voted if walks else SURE_VOTED}  # fmt: skip


def _sure(eyes: Eyes, sets: Sets) -> Sure:
    """What is sure enough for few wrong names, and few names of things of no kind."""
    usual, odd = (judging.looked(eyes, frames(files)) for files in (sets.choose, sets.choose_odd))
    some = [one for one in usual if one.pixels >= naming.LEAST_PX or one.kind == "nothing"]
    sure = judging.calibrated(some, eyes.namer.classes, most_wrong=MOST_WRONG)
    strange = [one for one in odd if judging.sort(one.kind) in judging.UNKNOWN]
    strange = [one for one in judging.within(strange, judging.FAR_M) if one.kind != "nothing"]
    least = judging.calibrated(strange, eyes.namer.classes, most_wrong=MOST_NAMED)
    return Sure(max(sure.kind, least.kind), max(sure.family, least.family)) if strange else sure


def _write_namer(path: Path, learnt: Learnt) -> None:
    families = [family(one) if one not in (naming.UNKNOWN, naming.NOTHING) else one
                for one in naming.CLASSES]  # fmt: skip
    notes = {"classes": ",".join(naming.CLASSES), "families": ",".join(families),
             "sure_kind": "0.9", "sure_family": "0.9", "heat": "1", "spread": "1",
             "sure_voted_kind": str(SURE_VOTED), "sizes": sizes_of_kinds()}  # fmt: skip
    shapes = {graphs.IMAGE: (SIDE_PX, SIDE_PX, CHANNELS), graphs.NUMBERS: (NUMBERS,)}
    export.write(path, naming.GRAPH, learnt, shapes, notes)


if __name__ == "__main__":
    sys.exit(main())
