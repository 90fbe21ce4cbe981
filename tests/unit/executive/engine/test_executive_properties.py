"""Whatever skills do and people type: it ends, with a code, and nothing is left at work."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from executive.meaning.request import Refused, Understood, request
from executive.skills.balance import BalanceParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.skills.wait import WaitParams
from robot.failures import CATALOGUE, Failure
from tests.fakes.rig import PICK, PUT, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script
from tests.fakes.worlds import WHERE

KINDS = (NavigateParams, PickParams, PlaceParams, SearchParams, WaitParams, BalanceParams)
scripts = st.builds(
    Script,
    steps=st.integers(0, 5),
    code=st.one_of(st.none(), st.sampled_from(sorted(CATALOGUE))),
    stop_steps=st.integers(0, 5),
    raises=st.sampled_from([False, False, False, True]),
    resources=st.sets(st.sampled_from(["legs", "left_arm", "head"])).map(frozenset),
)


@settings(max_examples=75)
@given(
    lives=st.fixed_dictionaries(
        {kind: st.lists(scripts, min_size=1, max_size=4) for kind in KINDS}
    ),
    errands=st.lists(st.sampled_from([WALK, PICK, PUT, WAIT]), min_size=1, max_size=5),
    stop_at=st.one_of(st.none(), st.integers(0, 60)),
)
def test_every_task_ends_with_a_verdict_and_a_body_at_rest(lives, errands, stop_at):
    rig = Rig(lives).begin(*errands)
    for tick in range(3000):
        if tick == stop_at:
            rig.executive.stop("stopped on request")
        rig.tick()
        if rig.executive.outcome is not None:
            break
    assert rig.executive.outcome is not None
    verdict = rig.executive.outcome.failure or True
    assert verdict is True or (isinstance(verdict, Failure) and verdict.code in CATALOGUE)
    assert rig.stage.quiet
    begun = [skill for skill in rig.troupe.made if skill.calls]
    for skill in begun:
        ended = skill.calls.count("step") > skill.script.steps and not skill.script.raises
        stopped = skill.calls.count("stop") > skill.script.stop_steps
        assert ended or stopped, skill


@settings(max_examples=75)
@given(st.text(max_size=60))
def test_any_text_is_a_task_or_a_refusal(text):
    assert isinstance(request(text, WHERE), Understood | Refused)


WORDS = """pick up put the a red blue cup bottle crate on table shelf loft moon it and then go to
bring all cups me if you see find twice three wait seconds squat one leg stop not no"""
words = st.sampled_from(WORDS.split())


@settings(max_examples=150)
@given(st.lists(words, max_size=12))
def test_any_words_of_the_vocabulary_are_a_task_or_a_refusal(said):
    outcome = request(" ".join(said), WHERE)
    assert isinstance(outcome, Understood | Refused)
    if isinstance(outcome, Refused):
        assert outcome.reason
        assert outcome.suggestion
