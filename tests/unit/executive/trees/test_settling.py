"""Settling what is meant between looks, and several things each in its turn."""

from __future__ import annotations

from typing import get_args

import pytest

from executive.blackboard import Blackboard
from executive.meaning.handlers.steps import PASSED_OVER
from executive.skills.give import GiveParams
from executive.skills.look import LookParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.trees import parts as p
from executive.trees.build import build, finished
from executive.trees.each import HOPELESS
from robot.failures import CATALOGUE, Failure, Spoilt, codes, failure
from tests.fakes.rig import Rig
from tests.fakes.scripted_skills import Script

OPEN = failure("ambiguous", "two things fit")
LOOKS = tuple(p.Errand(name=f"look {n}", params=LookParams(around=True)) for n in (1, 2))


def pick(object_id: str) -> p.Errand:
    return p.Errand(name=f"pick up {object_id}", params=PickParams(object_id=object_id))


class Asked:
    """Answers a question with the answers given, the last one over and over."""

    def __init__(self, *answers: tuple[str, ...] | Failure) -> None:
        self.answers, self.times = list(answers), 0

    def __call__(self, _board: Blackboard) -> tuple[str, ...] | Failure:
        self.times += 1
        return self.answers[min(self.times, len(self.answers)) - 1]


def settle(question: Asked, *, thorough: bool = False) -> p.Settle:
    def then(ids: tuple[str, ...]) -> p.Part:
        return p.Series(name="then", parts=tuple(pick(object_id) for object_id in ids))

    return p.Settle(
        name="which", looks=LOOKS, question=question, then=then, likely=then(("cup",)),
        thorough=thorough,
    )  # fmt: skip


def play(part: p.Part, scripts=None, *, done=frozenset()):
    rig = Rig(scripts)
    rig.executive.submit(lambda stage: build(part, stage, done=done), text="task")
    return rig, rig.run()


def steps(rig: Rig) -> list[str]:
    return [e.data["step"] for e in rig.journal.recent if e.event == "step"]


@pytest.mark.parametrize("looks", [0, 1, 2])
def test_it_looks_only_until_it_is_settled(looks):
    question = Asked(*[OPEN] * looks, ("jug", "mug"))
    rig, verdict = play(settle(question))
    assert verdict is True
    seen = [f"look {n + 1}" for n in range(looks)]
    assert steps(rig) == [*seen, "pick up jug", "pick up mug"]


def test_what_takes_all_looks_is_not_asked_before():
    question = Asked(("jug",))
    rig, verdict = play(settle(question, thorough=True))
    assert verdict is True
    assert steps(rig) == ["look 1", "look 2", "pick up jug"]
    assert question.times == 1


def test_what_is_still_open_after_the_last_look_fails_as_the_question_says():
    rig, verdict = play(settle(Asked(OPEN)))
    assert verdict == OPEN
    assert steps(rig) == ["look 1", "look 2"]


def test_a_look_that_fails_fails_it():
    _, verdict = play(settle(Asked(OPEN)), {LookParams: [Script(code="fallen")]})
    assert isinstance(verdict, Failure)
    assert verdict.code == "fallen"


def test_what_was_settled_before_is_not_asked_again():
    def task(question: Asked) -> p.Part:
        return p.Series(name="task", parts=(settle(question),))

    ends = {PickParams: [Script(), Script(code="internal")]}
    rig, _ = play(task(Asked(OPEN, ("jug", "mug"))), ends)
    done = finished({"event": e.event, **e.data} for e in rig.journal.recent)
    again, verdict = play(task(Asked(OPEN)), done=done)
    assert verdict is True
    assert steps(again) == ["pick up mug"]


def each(*things: str) -> p.Each:
    return p.Each(name="each", parts=tuple(map(pick, things)), things=things)


def test_all_are_done_and_said():
    rig, verdict = play(each("cup", "jug"))
    assert verdict is True
    (said,) = [s.params for s in rig.troupe.made if isinstance(s.params, SayParams)]
    assert said.text == "Done: cup and jug."


@pytest.mark.parametrize("fails", [0, 1, 2])
def test_what_fails_with_one_does_not_keep_the_others(fails):
    lives = [Script(code="no_grasp" if n == fails else None) for n in range(3)]
    things = ["cup", "jug", "mug"]
    rig = Rig({PickParams: lives})
    rig.stage.recovers = False
    rig.executive.submit(lambda stage: build(each(*things), stage), text="task")
    verdict = rig.run()
    assert isinstance(verdict, Failure)
    assert verdict.code == "no_grasp"
    assert "1 of 3 not done" in verdict.cause
    assert things[fails] in verdict.cause
    assert [f"pick up {thing}" for thing in things] == [s for s in steps(rig) if "pick" in s]
    (said,) = [s.params for s in rig.troupe.made if isinstance(s.params, SayParams)]
    done, left = said.text.split("Not done:")
    assert things[fails] in left
    assert all(thing in done for thing in things if thing != things[fails])


@pytest.mark.parametrize(
    "code", sorted(HOPELESS - {"emergency_stop", "battery_low", "overheated", "motor_fault"})
)
def test_a_robot_that_cannot_go_on_does_not_try_the_next(code):
    rig = Rig({PickParams: [Script(code=code)]})
    rig.stage.recovers = False
    rig.executive.submit(lambda stage: build(each("cup", "jug"), stage), text="task")
    verdict = rig.run()
    assert isinstance(verdict, Failure)
    assert verdict.code == code
    assert steps(rig) == ["pick up cup"]


def test_a_look_is_no_failure_of_the_robot_itself():
    """A code is in one place of three, by its row of the catalogue."""
    assert {kind.spoils for kind in CATALOGUE.values()} == set(get_args(Spoilt))
    assert HOPELESS.isdisjoint(PASSED_OVER)
    assert set(codes("system")) == {"plant_lost", "internal"}
    assert {"fallen", "emergency_stop", "cancelled"} <= HOPELESS
    assert {"object_not_seen", "no_path"} <= set(PASSED_OVER)
    assert "out_of_reach" not in HOPELESS.union(PASSED_OVER)


PUT = p.Errand(name="put", params=PlaceParams(object_id="cup", place_id="table"))
GIVEN = p.Errand(name="give", params=GiveParams(object_id="cup", person_id="anna"))


def kept(gone: list[str]) -> p.Kept:
    def names(_board: Blackboard, put_down, taken) -> list[str]:
        left = {**put_down, **dict.fromkeys(taken, "the hand")}
        return [f"{thing} on {place}" for thing, place in left.items() if thing in gone]

    return p.Kept(name="kept", gone=names)


def test_what_stands_where_it_was_put_is_done():
    _, verdict = play(p.Series(name="task", parts=(PUT, kept([]))))
    assert verdict is True


def test_what_was_put_down_and_stands_elsewhere_is_not_done():
    _, verdict = play(p.Series(name="task", parts=(PUT, kept(["cup"]))))
    assert isinstance(verdict, Failure)
    assert verdict.code == "not_as_expected"
    assert "cup on table" in verdict.cause


def test_what_was_taken_again_need_not_stand_there_but_has_to_be_held():
    _, verdict = play(p.Series(name="task", parts=(PUT, pick("cup"), kept([]))))
    assert verdict is True
    _, verdict = play(p.Series(name="task", parts=(PUT, pick("cup"), kept(["cup"]))))
    assert isinstance(verdict, Failure)
    assert "cup on the hand" in verdict.cause


@pytest.mark.parametrize("after", [PUT, GIVEN])
def test_what_was_put_down_or_given_away_need_not_be_held(after: p.Errand):
    gone_from_hand = p.Kept(name="kept", gone=lambda _board, _put, taken: sorted(taken))
    _, verdict = play(p.Series(name="task", parts=(pick("cup"), after, gone_from_hand)))
    assert verdict is True
