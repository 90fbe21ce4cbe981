"""Pairs of sentences and plain words can be learnt from; where PyTorch is, a few are."""

import pytest

from intents.context import Context
from intents.english.paraphrase.paraphrasing import ASK, NOTHING
from intents.outcomes import Refusal
from intents.parser import first_look
from training.marked import sentences
from training.paraphrase.examples import common_words, in_plain_words, pair
from training.paraphrase.pairs import PAIRS, pairs


def test_nearly_all_plain_words_beside_sentences_are_read() -> None:
    told = list(pairs("12d"))
    orders = [(one, plain) for one, plain in told if plain not in (ASK, NOTHING)]
    refused = [
        plain for one, plain in orders
        if isinstance(first_look(plain, one.vocabulary, Context()).outcome, Refusal)
    ]  # fmt: skip
    assert len(orders) > 100
    assert len(refused) < 0.06 * len(orders), refused


def test_every_line_beside_a_world_is_a_pair() -> None:
    for file in PAIRS.glob("*.tsv"):
        lines = file.read_text(encoding="utf-8").splitlines()
        assert {line.count("\t") for line in lines} == {2}, file
        assert file.with_name(file.name.replace(".tsv", ".vocab.json")).exists()


def test_marked_sentences_point_at_what_they_say() -> None:
    told = [(one, plain) for one in list(sentences())[::80] if (plain := in_plain_words(one))]
    known = frozenset(common_words([(plain, one.vocabulary) for one, plain in told], 2))
    found = [pair(one, plain, known) for one, plain in told]
    assert sum(one is not None for one in found) > 0.7 * len(found)
    for one in filter(None, found):
        assert all(isinstance(w, str) or w < len(one.units) for w in one.plain)


def test_a_few_pairs_are_learnt() -> None:
    torch = pytest.importorskip("torch")
    from training.paraphrase.batches import BEGIN, END, batch, told
    from training.paraphrase.network import Network, Size

    torch.manual_seed(1)
    some = [one for one in sentences() if one.kind == "plain order"][:8]
    plain = [(one, found) for one in some if (found := in_plain_words(one))]
    known = frozenset(common_words([(text, one.vocabulary) for one, text in plain], 1))
    lessons = [found for one, text in plain if (found := pair(one, text, known))]
    words = {word: n for n, word in enumerate([BEGIN, END, *sorted(known)])}
    letters = ["[UNK]", "[CLS]", "[SEP]", *"abcdefghijklmnopqrstuvwxyz0123456789,.'!?"]
    heard = {p: n for n, p in enumerate([*letters, *("##" + one for one in letters[3:])])}
    network = Network(Size(len(heard), len(words), layers=1, wide=48, heads=4, inner=64), drop=0.0)
    adam = torch.optim.Adam(network.parameters(), 3e-3)
    losses: list[float] = []
    for _ in range(30):
        now = batch([told(one) for one in lessons], heard, words, network.size.longest)
        read = network.encode(now.pieces, now.sorts, now.mask)
        scores = network.decode(read, now.mask, now.heads, now.has, now.plain)
        loss = torch.nn.functional.cross_entropy(
            scores.flatten(0, 1), now.goal.flatten(), ignore_index=-1
        )
        adam.zero_grad()
        loss.backward()
        adam.step()
        losses.append(loss.item())
    assert losses[-1] < 0.5 * losses[0]
