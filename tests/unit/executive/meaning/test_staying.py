"""A wait without how long is one where nothing comes after it."""

import pytest

from executive.meaning.staying import with_an_end
from intents import goals

DOOR = goals.GoTo(place="door")
WAIT, STAY = goals.Wait(), goals.Stop()
SEEN = goals.Present(object=goals.ObjectQuery(name="mug"))


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        ((DOOR, WAIT), (DOOR, STAY)),
        (
            (goals.If(condition=SEEN, then=(DOOR,), else_=(DOOR, WAIT)),),
            (goals.If(condition=SEEN, then=(DOOR,), else_=(DOOR, STAY)),),
        ),
    ],
)
def test_who_has_nothing_left_to_do_waits_where_they_are(asked, meant):
    assert with_an_end(asked) == meant


@pytest.mark.parametrize(
    "asked",
    [
        (),
        (DOOR,),
        (WAIT, DOOR),
        (DOOR, goals.Wait(duration_s=5.0)),
        (goals.If(condition=SEEN, then=(WAIT,)), DOOR),
        (goals.Repeat(times=2, goals=(DOOR, WAIT)),),
    ],
)
def test_every_other_wait_stays_as_it_is(asked):
    assert with_an_end(asked) == asked
