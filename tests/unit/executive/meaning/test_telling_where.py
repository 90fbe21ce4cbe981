"""Who asks where a thing is hears it, unless something is to be done with it."""

import pytest

from executive.meaning.telling_where import told_where
from intents import goals

GLASSES = goals.ObjectQuery(name="glasses")
FIND, TELL = goals.Find(object=GLASSES), goals.Tell(object=GLASSES, property="location")
SEEN = goals.Present(object=GLASSES)


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        ((goals.GoTo(place="hall"), FIND), (goals.GoTo(place="hall"), TELL)),
        ((goals.If(condition=SEEN, else_=(FIND,)),), (goals.If(condition=SEEN, else_=(TELL,)),)),
    ],
)
def test_where_it_was_found_is_told_at_the_end(asked, meant):
    assert told_where(asked) == meant


@pytest.mark.parametrize(
    "asked",
    [
        (),
        (FIND, goals.Pick(object=GLASSES)),
        (goals.Find(person=goals.Person(name="Ann")),),
        (goals.Find(object=goals.ObjectQuery(name="glasses", count="all")),),
    ],
)
def test_every_other_search_stays_as_it_is(asked):
    assert told_where(asked) == asked
