"""What may be lost in other words than those that were said, and how sure they then have to be."""

import pytest

from intents.context import Context
from intents.doubts import (
    DOUBTED_ALONE,
    NEVER,
    QUITE_SURE,
    SURE,
    SURER,
    SUREST,
    TAKEN_BACK,
    WITNESSED,
    needed,
)
from intents.english.learnt.choice import SILENT, Both, Name, Side
from intents.english.paraphrase.source import units, words_of
from intents.english.words.names import index_of
from intents.outcomes import Goals, Question
from intents.parser import first_look
from intents.stakes import Stake, stake_of
from intents.vocabulary import Vocabulary

LIGHTHOUSE = Vocabulary.of(
    objects=["oil can", "master key", "room key", "spyglass", "flare"],
    places=["lantern", "chest", "rail"],
    rooms=["gallery"],
    people=["Morwenna", "Jago"],
)
INDEX = index_of(LIGHTHOUSE)


def least(said: str, plain: str, *, likely: float = 0.9, asked_for: float = SURE) -> float:
    """How likely the plain words have to be in place of what was said."""
    before = first_look(said, LIGHTHOUSE, Context())
    other = first_look(plain, LIGHTHOUSE, Context()).outcome
    assert isinstance(other, Goals), plain
    told = [one for one in units(words_of(said), INDEX) if one.names]
    names = [Name(one.sort, one.names, one.is_whole, one.said) for one in told]
    both = Both(said, names, plain, likely, SILENT, Side("goals", other.goals))
    return needed(said, INDEX, before, both, least=asked_for)


@pytest.mark.parametrize(
    ("said", "plain", "wanted"),
    [
        ("hoick us the flare off that rail there would ye", "bring the flare at the rail to me",
         SURE),
        ("hoick the master key hither, no, the room key I want", "bring the room key to me",
         TAKEN_BACK),
        ("Not the master key, ye gowk, the room key hither", "bring the room key to me",
         TAKEN_BACK),
        ("the master key hither somehow. The room key, sorry", "bring the room key to me",
         TAKEN_BACK),
        ("hoick the master key hither, och no, the room key", "bring the master key to me", NEVER),
        ("hoick every key hither but not the room key, master key", "bring the master key to me",
         NEVER),
        ("the flare for Jago and yon spyglass hither", "bring the spyglass to me", NEVER),
        ("The lantern, it makes smoke, shut it", "close the lantern", SURE),
        ("The lantern, it makes such smoke", "close the lantern", QUITE_SURE),
        ("hoick two flares hither for Jago somehow", "bring the flare to Jago", NEVER),
        ("hoick the flare to Jago at nine o'clock somehow", "bring the flare to Jago", NEVER),
        ("would ye be stopping there ten minutes somehow", "wait 10 s", NEVER),
        ("would ye be stopping there ten minutes somehow", "wait 600 s", SURE),
        ("hoick yersel back twa metres somehow", "walk 1 m back", NEVER),
        ("wind yon flare hither, quarter turn", "turn 180 degrees left", NEVER),
        ("spin yersel somehow, quarter turn", "turn 90 degrees left", SURE),
        ("hoick yersel back somehow", "walk 1 m back", SURE),
        ("would ye be stopping at the rail ten minutes somehow", "go to the rail", SURER),
        ("how would anybody ever hoick the flare to Jago?", "bring the flare to Jago", NEVER),
        ("my hands are wet, you bring the flare somehow?", "bring the flare to me", SURE),
    ],
)  # fmt: skip
def test_what_may_be_lost_asks_for_more(said: str, plain: str, wanted: float) -> None:
    assert least(said, plain) == wanted


def test_two_that_agree_have_to_be_less_sure() -> None:
    said, plain = "bring the flare to Morwenna, thole the morrow", "bring the flare to Morwenna"
    before = first_look(said, LIGHTHOUSE, Context())
    other = first_look(plain, LIGHTHOUSE, Context()).outcome
    assert isinstance(before.outcome, Question)
    assert isinstance(other, Goals)
    assert before.outcome.goals == other.goals
    alike = Side("question", before.outcome.goals), Side("goals", other.goals)
    both = Both(said, [], plain, 0.4, *alike)
    assert needed(said, INDEX, before, both) == WITNESSED
    unlike = both._replace(own=SILENT)
    assert needed(said, INDEX, before, unlike) == DOUBTED_ALONE


def test_words_that_the_network_is_not_sure_of_have_to_be_surer() -> None:
    said, plain = "hoick us the flare off that rail", "bring the flare at the rail to me"
    assert least(said, plain, likely=0.3) == DOUBTED_ALONE
    assert least(f"{said} for ten minutes", plain, likely=0.3) == SUREST


@pytest.mark.parametrize(
    ("plain", "stake", "wanted"),
    [
        ("look for the flare", Stake.LOOK, DOUBTED_ALONE),
        ("open the chest", Stake.DEVICE, DOUBTED_ALONE),
        ("bring the flare to me", Stake.MOTION, SUREST),
        ("go to the gallery", Stake.MOTION, SUREST),
    ],
)
def test_the_less_is_at_stake_the_less_sure_one_need_be(
    plain: str, stake: Stake, wanted: float
) -> None:
    said = "the flare and the chest in the gallery, if it please ye somehow"
    goals = first_look(plain, LIGHTHOUSE, Context()).goals
    assert stake_of(goals) is stake
    names_kept = "chest" if stake is Stake.DEVICE else "flare"
    told = said if stake is Stake.DEVICE else f"the {names_kept} hither, if it please ye somehow"
    told = told.replace("flare", "gallery") if "gallery" in plain else told
    assert least(told, plain, likely=0.3) == wanted


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("hoick the flare hither with both hands", "bring the flare to me"),
        ("hoick the flare hither later", "bring the flare to me"),
        ("hoick the upper flare hither", "bring the flare to me"),
        ("hoick the flare hither without the chest", "bring the flare to me"),
        ("hoick him the flare hither", "bring the flare to me"),
        ("smash the flare on the chest", "put the flare on the chest"),
    ],
)
def test_on_purpose_nothing_is_lost_that_limits_an_order(said: str, plain: str) -> None:
    assert least(said, plain, asked_for=SURER) == NEVER


def test_a_doubt_never_asks_for_less() -> None:
    said, plain = "what are ye upto", "what are you doing"
    assert least(said, plain) == DOUBTED_ALONE
    assert least(said, plain, asked_for=SURER) == SURER


def test_people_are_counted_more_surely_where_somebody_spoke_of_people() -> None:
    plain = "count the people in the gallery"
    assert least("reckon up how many there be in the gallery", plain) == DOUBTED_ALONE
    assert least("reckon up the folk there be in the gallery", plain) == SURE


def test_on_purpose_what_loses_nothing_has_to_be_surer() -> None:
    assert least("hoick us the flare hither", "bring the flare to me", asked_for=SURER) == SURER
