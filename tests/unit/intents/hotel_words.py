"""A made-up hotel, whose names the tests of words and phrases share."""

from intents.outcomes import Goals, Outcome
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary

HOTEL = Vocabulary.of(
    objects=[
        *(Thing(name=name, category="linen") for name in ("pillow", "bath towel", "bed sheet")),
        *(Thing(name=name, category="drink") for name in ("cola", "tea")),
        *(Thing(name=name, category="dish") for name in ("wine glass", "teapot", "saucer")),
        *(Thing(name=name, category="tool") for name in ("scissors", "hammer", "torch")),
        *("suitcase", "hair dryer", "room key", "menu", "peach", "cap", "scarf", "power bank"),
    ],
    places=[
        *("counter", "bar", "minibar", "wardrobe", "bath tub", "trolley", "luggage rack"),
        *("side table", "window", "lift", "bin", "heater", "door", "desk lamp"),
    ],
    rooms=["lobby", "suite", "pantry", "restaurant", "terrace", "spa"],
    people=["Olga", "Ravi", "Hans", "Lucia", "Grandpa"],
    categories={"linen": "linens", "drink": "drinks", "dish": "dishes", "tool": "tools"},
)


def heard(said: str) -> Outcome:
    """What is understood in the hotel."""
    return parse(said, HOTEL)


def assert_means_the_same(said: str, plainly: str) -> None:
    """Both are understood, and ask for the same."""
    one, other = heard(said), heard(plainly)
    assert isinstance(other, Goals), plainly
    assert isinstance(one, Goals), one
    assert one.goals == other.goals
