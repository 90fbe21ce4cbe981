"""What is "in here", or beside whoever speaks, may be anywhere: nothing tells where that is."""

from executive.meaning.in_here import without_here
from intents import goals


def thing(**more) -> goals.ObjectQuery:
    return goals.ObjectQuery(name="umbrella", **more)


def test_what_is_where_the_operator_is_may_be_anywhere():
    asked = (
        goals.Find(object=thing(at="operator", count=1)),
        goals.Place(object=thing(at="operator"), on="desk"),
        goals.Count(object=thing(at="operator")),
    )
    meant = (
        goals.Find(object=thing(count=1)),
        goals.Place(object=thing(), on="desk"),
        goals.Count(object=thing()),
    )
    assert without_here(asked) == meant


def test_so_is_what_a_condition_asks_for():
    present = goals.Present(object=thing(at="operator"))
    found = without_here((goals.If(condition=present, then=(goals.Stop(),)),))
    assert found == (goals.If(condition=goals.Present(object=thing()), then=(goals.Stop(),)),)


def test_other_places_stay_as_they_are():
    asked = (
        goals.Find(object=thing(at="desk")),
        goals.GoTo(place="operator"),
        goals.Bring(object=thing(), to=goals.Person(who="operator")),
    )
    assert without_here(asked) is asked
