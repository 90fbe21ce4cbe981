"""An evaluation is gone on with as it was asked for."""

from dataclasses import replace
from pathlib import Path

import pytest

from executive.frontends.evaluation_asked import FILE, as_before, keep
from executive.frontends.options import Eval
from robot.errors import ConfigError

WAVES = Eval(missions=["wave"], seeds=6, no_recovery=True, robot="juno")


@pytest.mark.parametrize(
    "asked",
    [
        WAVES,
        Eval(faults="shoved hard"),
        Eval(tasks=[Path("a.yaml")], seeds=2),
        Eval(homes="flat:7"),
    ],
)
def test_to_go_on_asks_for_what_was_asked_for(tmp_path: Path, asked: Eval):
    keep(tmp_path, asked)
    again = as_before(Eval(resume=tmp_path, seeds=1))
    assert again == replace(asked, resume=tmp_path)


def test_more_seeds_are_more_runs(tmp_path: Path):
    keep(tmp_path, WAVES)
    assert as_before(Eval(resume=tmp_path, seeds=20)).seeds == 20
    again = Eval(resume=tmp_path, missions=["wave"], seeds=3)
    assert as_before(again) == again
    assert as_before(Eval(seeds=1)) == Eval(seeds=1)


@pytest.mark.parametrize(
    ("asked", "now", "words"),
    [
        (WAVES, Eval(missions=["nod"]), "are of wave, not of nod"),
        (WAVES, Eval(tasks=[Path("b.yaml")]), "are of none, not of b.yaml"),
        (WAVES, Eval(missions=["wave"], faults="shoved hard"), "not of shoved hard"),
        (
            Eval(tasks=[Path("a.yaml")]),
            Eval(tasks=[Path("b.yaml")]),
            "are of a.yaml, not of b.yaml",
        ),
        (Eval(homes="flat:7"), Eval(homes="flat:8"), "are of flat:7, not of flat:8"),
        (Eval(), Eval(missions=["nod"]), "are of none, not of nod"),
    ],
)
def test_results_of_something_else_are_not_gone_on_with(tmp_path, asked, now, words):
    keep(tmp_path, asked)
    with pytest.raises(ConfigError, match=words) as refused:
        as_before(replace(now, resume=tmp_path))
    assert f"humanoid eval --resume {tmp_path}" in str(refused.value)


@pytest.mark.parametrize("text", ["[", "{}}", '{"seeds": 0}', '{"seeds": 1e99}', '{"missions": 3}'])
def test_what_cannot_be_read_is_said(tmp_path: Path, text: str):
    (tmp_path / FILE).write_text(text)
    with pytest.raises(ConfigError):
        as_before(Eval(resume=tmp_path))


def test_an_evaluation_of_before_own_places_goes_on_with_the_oracle(tmp_path):
    """Its runs were made so; others under the same names would be refused."""
    told = Eval(missions=["nod"], world="kitchen", localisation="oracle", seeds=1)
    keep(tmp_path, told)
    again = replace(told, localisation="auto", resume=tmp_path)
    assert as_before(again).localisation == "oracle"
    assert as_before(Eval(resume=tmp_path, seeds=1)).localisation == "oracle"
    assert as_before(replace(again, localisation="lidar")).localisation == "lidar"
