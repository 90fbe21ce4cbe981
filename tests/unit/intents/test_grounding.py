"""Descriptions to ids."""

from hypothesis import given
from hypothesis import strategies as st

from intents.goals import ObjectQuery, Relation
from intents.grounding import Ambiguous, Entity, Grounded, Unknown, ground

RED = Entity(id="c1", name="cup", category="dish", color="red", size_m=(0.08, 0.08, 0.1),
             mass_kg=0.2, at="table")  # fmt: skip
BLUE = Entity(id="c2", name="cup", category="dish", color="blue", size_m=(0.07, 0.07, 0.09),
              mass_kg=0.3, at="shelf")  # fmt: skip
BOTTLE = Entity(id="b1", name="bottle", category="drink", size_m=(0.06, 0.06, 0.25), mass_kg=0.5)
HOME = (RED, BLUE, BOTTLE)


def test_colour_place_and_category_tell_things_apart() -> None:
    assert ground(ObjectQuery(name="cup", color="blue"), HOME) == Grounded("c2", ("c2",))
    assert ground(ObjectQuery(name="cups", at="table"), HOME) == Grounded("c1", ("c1",))
    assert ground(ObjectQuery(category="drink"), HOME) == Grounded("b1", ("b1",))


def test_two_that_fit_are_a_question_that_names_both() -> None:
    found = ground(ObjectQuery(name="cup"), HOME)
    assert isinstance(found, Ambiguous)
    assert found.candidates == ("c1", "c2")
    assert found.question == "Which cup, the red one or the blue one?"


GOBLETS = (
    Entity(id="g1", name="gold goblet", category="goblet", color="yellow", at="table",
           p_WO=(0.0, -0.25, 0.8), size_m=(0.07, 0.07, 0.14)),
    Entity(id="g2", name="silver goblet", category="goblet", color="steel", at="table",
           p_WO=(0.0, 0.25, 0.8), size_m=(0.07, 0.07, 0.14)),
    Entity(id="g3", name="goblet", category="goblet", color="red", at="rack",
           p_WO=(3.0, 0.0, 1.0), size_m=(0.06, 0.06, 0.1)),
)  # fmt: skip


def test_of_several_the_whole_category_is_meant_and_of_one_what_is_called_so() -> None:
    """*All the goblets* were the red one alone, as nothing else is just called goblet."""
    found = {
        count: ground(ObjectQuery(name="goblet", count=count), GOBLETS)  # type: ignore[arg-type]
        for count in ("all", 3, None)
    }
    assert found["all"] == found[3] == Grounded("g1", ("g1", "g2", "g3"))
    assert found[None] == Grounded("g3", ("g3",))
    tallest = ground(ObjectQuery(name="goblet", superlative="tallest", at="table"), GOBLETS)
    assert isinstance(tallest, Ambiguous)
    assert tallest.candidates == ("g1", "g2")
    lit = ground(ObjectQuery(name="goblet", color="yellow"), GOBLETS)
    assert lit == Grounded("g1", ("g1",)), "no goblet is just called so that is yellow"


def test_between_two_of_a_category_is_between_any_two_of_it() -> None:
    candle = Entity(id="c1", name="candle", p_WO=(0.0, 0.0, 0.8), size_m=(0.05, 0.05, 0.1))
    far = Entity(id="c2", name="candle", p_WO=(0.0, 0.7, 0.8), size_m=(0.05, 0.05, 0.1))
    two = Relation(how="between", of=ObjectQuery(name="goblet", count=2))
    found = ground(ObjectQuery(name="candle", relation=two), (candle, far, *GOBLETS))
    assert found == Grounded("c1", ("c1",))


def test_where_nothing_called_so_stands_so_one_of_the_category_may() -> None:
    box = Entity(id="b1", name="box", p_WO=(0.0, -0.4, 0.8), size_m=(0.05, 0.05, 0.1))
    beside = Relation(how="near", of=ObjectQuery(name="box"))
    found = ground(ObjectQuery(name="goblet", relation=beside), (box, *GOBLETS))
    assert found == Grounded("g1", ("g1",))


def test_twins_are_told_apart_by_where_they_are() -> None:
    twin = Entity(id="c3", name="cup", color="red", at="sink")
    found = ground(ObjectQuery(name="cup", color="red"), (RED, twin))
    assert isinstance(found, Ambiguous)
    assert found.labels == ("the one at the table", "the one at the sink")


def test_what_stands_on_a_board_stands_on_its_shelf() -> None:
    high = Entity(id="c4", name="cup", color="red", at="upper shelf", of="shelf")
    low = Entity(id="c5", name="cup", color="red", at="table", of="table")
    for at in ("shelf", "upper shelf"):
        found = ground(ObjectQuery(name="cup", at=at), [low, high])
        assert isinstance(found, Grounded)
        assert found.ids == ("c4",)


def test_superlatives_compare_sizes_and_masses() -> None:
    for superlative, wanted in (("largest", "b1"), ("smallest", "c2"), ("heaviest", "b1"),
                                ("lightest", "c1"), ("tallest", "b1")):  # fmt: skip
        found = ground(ObjectQuery(superlative=superlative), HOME)  # type: ignore[arg-type]
        assert isinstance(found, Grounded)
        assert found.id == wanted


def test_a_superlative_of_view_is_measured_by_the_caller() -> None:
    ranks = {"leftmost": lambda e: {"c1": 0.1, "c2": 0.9}.get(e.id)}
    found = ground(ObjectQuery(superlative="leftmost"), HOME, ranks=ranks)  # type: ignore[arg-type]
    assert isinstance(found, Grounded)
    assert found.id == "c2"


def test_counts_take_several() -> None:
    assert ground(ObjectQuery(name="cup", count="all"), HOME) == Grounded("c1", ("c1", "c2"))
    assert ground(ObjectQuery(name="cup", count=2), HOME) == Grounded("c1", ("c1", "c2"))


def test_what_is_not_there_is_unknown_with_what_comes_near() -> None:
    found = ground(ObjectQuery(name="cup", color="green"), HOME)
    assert isinstance(found, Unknown)
    assert found.what == "green cup"
    assert "red cup" in found.nearest[0]
    assert "there is no green cup" in found.reason


def test_a_thing_whose_place_is_not_known_may_be_anywhere() -> None:
    assert isinstance(ground(ObjectQuery(name="bottle", at="table"), HOME), Grounded)


@given(st.permutations(HOME), st.sampled_from(["red", "blue"]))
def test_the_order_of_the_world_does_not_matter(world: list[Entity], color: str) -> None:
    found = ground(ObjectQuery(name="cup", color=color), world)
    assert isinstance(found, Grounded)
    assert found.id == {"red": "c1", "blue": "c2"}[color]


STRAWBERRY, PLUM = Entity(id="j1", name="strawberry jam"), Entity(id="j2", name="plum jam")


def test_what_names_have_in_common_means_all_of_them() -> None:
    found = ground(ObjectQuery(name="jam"), (*HOME, STRAWBERRY, PLUM))
    assert isinstance(found, Ambiguous)
    assert found.candidates == ("j1", "j2")
    assert ground(ObjectQuery(name="jam"), (*HOME, PLUM)) == Grounded("j2", ("j2",))


def test_a_name_means_nothing_longer_where_something_is_called_so() -> None:
    jam = Entity(id="j3", name="jam")
    assert ground(ObjectQuery(name="jam"), (STRAWBERRY, PLUM, jam)) == Grounded("j3", ("j3",))


def test_an_id_means_what_has_it() -> None:
    assert ground(ObjectQuery(name="c2", at="shelf"), HOME) == Grounded("c2", ("c2",))
