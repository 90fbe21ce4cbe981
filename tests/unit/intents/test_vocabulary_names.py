"""Vocabularies and finding their names in text."""

import msgspec
import pytest

from intents.english.words.names import NameIndex
from intents.vocabulary import Names, Spot, Thing, Vocabulary

HOME = Vocabulary.of(
    objects=["tea spoon", Thing(name="mug", synonyms=("beaker",)), "glasses", "bread knife"],
    places=["side table", Spot(name="settee"), "trash can"],
    rooms=["kitchen"],
    people=["Ada"],
    categories={"tool": "tools"},
)


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("tea spoon", "tea spoon"),
        ("teaspoons", "tea spoon"),
        ("bread knives", "bread knife"),
        ("sidetable", "side table"),
        ("beakers", "mug"),
        ("sofa", "settee"),
        ("rubbish bin", "trash can"),
        ("tools", "tool"),
        ("ada", "Ada"),
    ],
)
def test_names_are_found_whatever_the_spelling_plural_or_synonym(said: str, name: str) -> None:
    match = NameIndex(HOME).match([*said.split(), "now"], 0)
    assert match is not None
    assert match.end == len(said.split())
    assert [n.name for n in match.names] == [name]


def test_the_longest_name_wins() -> None:
    index = NameIndex(Vocabulary.of(objects=["orange", "orange juice"]))
    match = index.match(["orange", "juice"], 0)
    assert match is not None
    assert match.names[0].name == "orange juice"


def test_a_synonym_shared_by_two_names_of_a_world_stands_for_neither() -> None:
    both = NameIndex(Vocabulary.of(places=["couch", "sofa"]))
    assert [n.name for n in both.exact("couch")] == ["couch"]
    assert both.exact("settee") == ()


def test_a_part_of_a_name_points_to_all_names_that_have_it() -> None:
    index = NameIndex(Vocabulary.of(places=["upper shelf", "lower shelf", "desk"]))
    assert [n.name for n in index.partial("shelf")] == ["upper shelf", "lower shelf"]


def test_json_takes_plain_names_and_entries() -> None:
    text = """{"objects": ["cup", {"name": "tea", "category": "drink", "synonyms": ["chai"]}],
               "places": ["desk"], "people": ["Bo"], "categories": {"drink": "drinks"}}"""
    vocabulary = msgspec.json.decode(text, type=Names).vocabulary()
    assert vocabulary.objects[1].synonyms == ("chai",)
    assert vocabulary.rooms == ()
    assert hash(vocabulary) == hash(msgspec.json.decode(text, type=Names).vocabulary())


@pytest.mark.parametrize("bad", ['{"object": []}', '{"places": [3]}', '{"objects": [{}]}', "[]"])
def test_a_malformed_vocabulary_is_an_error(bad: str) -> None:
    with pytest.raises(msgspec.DecodeError):
        msgspec.json.decode(bad, type=Names)
