import pytest
from prompt_toolkit.completion import CompleteEvent
from prompt_toolkit.document import Document

from executive.frontends.prompt.command import Command
from executive.frontends.prompt.completion import LineCompleter
from intents.vocabulary import Someone, Spot, Thing, Vocabulary

WORLD = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="watering can", synonyms=("sprinkler",))],
    places=[Spot(name="upper board"), Spot(name="table")],
    rooms=["kitchen"],
    people=[Someone(name="Anna")],
)
COMMANDS = (
    Command(name="goals", usage="goals [drop N]", summary="s", run=print,
            choices=lambda: ("add", "drop")),
    Command(name="plan", usage="plan SENTENCE", summary="s", run=print, takes_sentence=True),
    Command(name="pause", usage="pause", summary="s", run=print),
)  # fmt: skip


def completed(typed: str) -> set[str]:
    """The lines that completion makes of a line."""
    document = Document(typed)
    found = LineCompleter(COMMANDS, WORLD).get_completions(document, CompleteEvent())
    return {typed[: len(typed) + one.start_position] + one.text for one in found}


@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ("pa", "pause"),
        ("PA", "pause"),
        ("goals d", "goals drop"),
        ("pick u", "pick up"),
        ("bring the r", "bring the red cup"),
        ("bring the red c", "bring the red cup"),
        ("take the watering c", "take the watering can"),
        ("take the spr", "take the sprinkler"),
        ("put it on the u", "put it on the upper board"),
        ("go to the kit", "go to the kitchen"),
        ("follow an", "follow Anna"),
        ("plan go to the ta", "plan go to the table"),
    ],
)
def test_a_line_is_completed(typed: str, wanted: str):
    assert wanted in completed(typed)


@pytest.mark.parametrize("typed", ["pause ", "zzz", "bring the red cup", ""])
def test_there_is_nothing_to_complete_a_line_wrongly_with(typed: str):
    for line in completed(typed):
        assert line.casefold().startswith(typed.casefold())
        assert line != typed


def test_a_command_without_an_argument_takes_no_names():
    assert completed("pause re") == set()
