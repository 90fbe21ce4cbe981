"""A made-up workshop, whose names the tests of the grammar share."""

from intents.vocabulary import Spot, Thing, Vocabulary

WORKSHOP = Vocabulary.of(
    objects=[
        Thing(name="mug", category="dish", color="red"),
        Thing(name="mug", category="dish", color="blue"),
        Thing(name="thermos", category="drink"),
        Thing(name="lemonade", category="drink"),
        Thing(name="screwdriver", category="tool"),
        Thing(name="tape measure", category="tool", synonyms=("ruler tape",)),
        "toolbox",
        "orange",
    ],
    places=["workbench", "upper rack", "lower rack", "sofa", Spot(name="locker"), "front door"],
    rooms=["office", "garage", "living room"],
    people=["Ada", "Emil", "Noor"],
    categories={"dish": "dishes", "drink": "drinks", "tool": "tools"},
)
