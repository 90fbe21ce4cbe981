"""Who tells the robot where it is, is settled once, and stays so in a run that goes on."""

from types import SimpleNamespace

import pytest

from executive.evaluation.campaign import Case
from executive.frontends import carrying_out
from executive.frontends.evaluation_localised import Localised
from executive.frontends.options import Do, Eval
from executive.meaning import request
from sim.simulation import Simulation

KITCHEN, BENCH = (
    request.setting(Simulation(), name, robot="juno") for name in ("kitchen", "bench")
)


def settled(where, handle=None, **said):
    options = Do(sentence=["nod"], **said)
    setup = carrying_out.setup(where, options, None, handle=handle)
    return setup.where.world.localisation


def test_by_default_its_own_lidar_where_it_has_a_map_and_an_oracle_elsewhere_in_one_line(capsys):
    assert settled(KITCHEN) == "lidar"
    assert capsys.readouterr() == ("", "")
    assert settled(BENCH) == "oracle"
    out, err = capsys.readouterr()
    assert not out and len(err.splitlines()) == 1
    assert "oracle" in err and "--localisation lidar" in err


def test_programs_read_it_in_the_summary_and_hear_nothing(capsys):
    assert settled(BENCH, as_json=True) == "oracle"
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("by", ["oracle", "lidar"])
def test_a_run_that_is_under_way_keeps_who_told_it_before(by, capsys):
    """A map that came meanwhile changes nothing: the plant is what it was."""
    handle = SimpleNamespace(deaths=1, under_way=SimpleNamespace(localisation=by))
    assert settled(KITCHEN, handle) == by
    assert settled(BENCH, handle) == by
    assert capsys.readouterr() == ("", "")


def test_cases_are_settled_each_for_itself_and_the_worlds_are_named_once(capsys):
    localised = Localised(Eval())
    cases = [
        Case(name=f"{number}", mission=mission, world=world)
        for number, (mission, world) in enumerate(
            [("nod", "kitchen"), ("nod", ""), ("not understood", "flat:3"), ("nod", "bench"),
             ("missions/hello.yaml", "")]
        )
    ]  # fmt: skip
    assert [localised(case) for case in cases] == ["lidar", "oracle", "oracle", "oracle", "lidar"]
    localised.say()
    _, err = capsys.readouterr()
    assert len(err.splitlines()) == 1
    assert err.count("bench") == err.count("flat:3") == 1 and "kitchen" not in err


def test_what_is_asked_of_an_evaluation_holds_for_every_case(capsys):
    for by in ("oracle", "lidar"):
        localised = Localised(Eval(localisation=by))
        assert localised(Case(name="a", mission="nod", world="flat:3")) == by
        localised.say()
    assert capsys.readouterr() == ("", "")
