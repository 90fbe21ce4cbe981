"""Marginals of a chain are those of counting every way to label it."""

from itertools import pairwise, product

import numpy as np
import pytest

from intents.english.learnt.field import Field, packed, unpacked


def made(seed: int) -> Field:
    random = np.random.default_rng(seed)
    names = [f"f{n}" for n in range(5)]
    return Field(
        labels=("a", "b", "c"),
        rows={name: row for row, name in enumerate(names)},
        weights=random.normal(size=(len(names), 3)),
        steps=random.normal(size=(3, 3)),
    )


def counted(field: Field, chain: list[list[str]]) -> np.ndarray:
    total = np.zeros((len(chain), 3))
    for labels in product(range(3), repeat=len(chain)):
        score = sum(field.weights[field.rows[f], at]
                    for place, at in zip(chain, labels, strict=True)
                    for f in place if f in field.rows)  # fmt: skip
        score += sum(field.steps[one, two] for one, two in pairwise(labels))
        for place, at in enumerate(labels):
            total[place, at] += np.exp(score)
    return total / total.sum(axis=1, keepdims=True)


@pytest.mark.parametrize("seed", range(5))
def test_marginals_are_those_of_every_way_to_label(seed: int) -> None:
    field = made(seed)
    chain = [["f0", "f1"], ["f2"], [], ["f3", "f4", "unheard of"]]
    assert field.marginals(chain) == pytest.approx(counted(field, chain))


def test_long_chains_stay_finite() -> None:
    field = made(1)
    field.steps[:] *= 50
    likely = field.marginals([["f0"], ["f1"]] * 400)
    assert np.isfinite(likely).all()
    assert likely.sum(axis=1) == pytest.approx(1.0)


def test_a_field_comes_back_from_its_file_and_is_written_the_same_again() -> None:
    field = unpacked(packed(made(2)))
    assert packed(field) == packed(unpacked(packed(field)))
    assert field.marginals([["f1"], ["f2"]]) == pytest.approx(
        made(2).marginals([["f1"], ["f2"]]), abs=1e-2
    )
