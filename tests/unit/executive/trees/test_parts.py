"""Parts as trees: loops, attempts, deadlines, handlers; the paths of steps, and what is done."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.skills.balance import BalanceParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.say import SayParams
from executive.trees import parts as p
from executive.trees.build import before, build, finished
from tests.fakes.rig import PICK, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

SAY = p.Errand(name="say", params=SayParams(text="hello"))
SQUAT = p.Errand(name="squat", params=BalanceParams(mode="squat"))
WALK_FAILS = {NavigateParams: [Script(code="fallen")]}  # nothing is tried again after that


def series(*parts: p.Part) -> p.Series:
    return p.Series(name="task", parts=parts)


def play(part: p.Part, scripts=None, *, done=frozenset()):
    rig = Rig(scripts)
    rig.executive.submit(lambda stage: build(part, stage, done=done), text="task")
    return rig, rig.run()


def ids(rig: Rig, kind: str = "step") -> list[str]:
    return [e.data["id"] for e in rig.journal.recent if e.event == kind]


def test_every_step_has_its_path():
    part = series(WALK, series(PICK, WAIT), WALK)
    rig, verdict = play(part)
    assert verdict is True
    assert ids(rig) == ids(rig, "done") == ["1", "2.1", "2.2", "3"]


def test_what_a_recovery_does_has_paths_of_its_own():
    rig, verdict = play(series(WALK, PICK), {PickParams: [Script(code="grasp_missed"), Script()]})
    assert verdict is True
    assert ids(rig) == ["1", "2", "2+1.1", "2+1"]
    events = [{"event": e.event, **e.data} for e in rig.journal.recent]
    assert finished(events) == {"1", "2"}


def test_steps_that_are_done_are_not_done_again():
    part = series(WALK, series(PICK, WAIT), WALK)
    rig, verdict = play(part, done=frozenset({"1", "2.1"}))
    assert verdict is True
    assert ids(rig) == ["2.2", "3"]


def test_a_loop_does_each_round_afresh():
    loop = p.Loop(name="3 times", bodies=(series(WALK, PICK),), at_most=3)
    rig, verdict = play(series(loop, WAIT))
    assert verdict is True
    assert ids(rig) == ["1#1.1", "1#1.2", "1#2.1", "1#2.2", "1#3.1", "1#3.2", "2"]


def test_a_long_loop_does_not_grow_the_tree():
    loop = p.Loop(name="40 times", bodies=(series(SAY, SAY, SAY),), at_most=40)
    rig = Rig()
    rig.executive.submit(lambda stage: build(loop, stage), text="task")
    sizes = []
    for _ in range(500):
        rig.tick()
        sizes.append(sum(1 for _ in rig.tree.root.iterate()))
        if rig.executive.outcome is not None:
            break
    assert rig.executive.outcome is not None
    assert max(sizes) < 40 * 2 + 80


@pytest.mark.parametrize("rounds", [0, 1, 4])
def test_a_while_asks_before_each_round(rounds):
    asked = []

    def question(_board):
        asked.append(1)
        return len(asked) <= rounds

    loop = p.Loop(name="while", bodies=(WALK,), at_most=10, question=question)
    rig, verdict = play(series(loop, WAIT))
    assert verdict is True
    assert rig.troupe.names() == ["navigate"] * rounds + ["wait"]
    assert len(asked) == rounds + 1


def test_a_while_that_does_not_end_fails_after_its_bound():
    loop = p.Loop(name="while", bodies=(WALK,), at_most=3, question=lambda board: True)
    rig, verdict = play(series(loop, WAIT))
    assert verdict.code == "timeout"
    assert "3 rounds" in verdict.cause
    assert rig.troupe.names() == ["navigate"] * 3


def test_a_retry_tries_again_up_to_its_bound():
    turns = [Script(code="fallen"), Script(code="fallen"), Script()]
    retry = p.Retry(name="retry", part=series(PICK, WALK), attempts=3)
    rig, verdict = play(series(retry, WAIT), {NavigateParams: turns})
    assert verdict is True
    assert ids(rig) == ["1.1", "1.2", "1*2.1", "1*2.2", "1*3.1", "1*3.2", "2"]

    rig, verdict = play(series(p.Retry(name="r", part=WALK, attempts=2), WAIT), WALK_FAILS)
    assert verdict.code == "fallen"
    assert ids(rig) == ["1", "1*2"]


def test_a_timeout_ends_what_it_stands_around():
    slow = {NavigateParams: [Script(steps=1000)]}
    timed = p.Timeout(name="walk", part=WALK, limit_s=2.0)
    rig, verdict = play(series(timed, WAIT), slow)
    assert verdict.code == "timeout"
    assert 2.0 <= rig.executive.outcome.took_s < 2.3
    assert rig.troupe.made[0].calls.count("stop") >= 1

    rig, verdict = play(series(timed, WAIT), {NavigateParams: [Script(steps=5)]})
    assert verdict is True


def test_time_on_hold_is_none_of_a_timeout():
    timed = p.Timeout(name="walk", part=WALK, limit_s=2.0)
    rig = Rig({NavigateParams: [Script(steps=30)]})
    rig.executive.submit(lambda stage: build(timed, stage), text="task")
    rig.tick(10)
    rig.executive.pause()
    rig.tick(200)
    rig.executive.resume()
    assert rig.run() is True


def test_the_handler_of_the_code_is_run_and_mends_the_step():
    handled = p.OnFail(name="walk", part=WALK, handlers=(("no_grasp", PICK), ("fallen", SQUAT)))
    rig, verdict = play(series(handled, WAIT), WALK_FAILS)
    assert verdict is True
    assert ids(rig) == ["1", "1.fallen", "2"]


def test_any_handles_what_has_no_handler_of_its_own():
    handled = p.OnFail(name="walk", part=WALK, handlers=(("any", SQUAT), ("no_grasp", PICK)))
    rig, verdict = play(series(handled, WAIT), WALK_FAILS)
    assert verdict is True
    assert ids(rig) == ["1", "1.any", "2"]


def test_a_failure_without_a_handler_stays_what_it_is():
    handled = p.OnFail(name="walk", part=WALK, handlers=(("no_grasp", PICK),))
    _, verdict = play(series(handled, WAIT), WALK_FAILS)
    assert verdict.code == "fallen"


def test_giving_up_says_why():
    handler = p.GiveUp(name="give up", cause="nobody is at home")
    handled = p.OnFail(name="walk", part=WALK, handlers=(("any", handler),))
    _, verdict = play(series(handled, WAIT), WALK_FAILS)
    assert (verdict.code, verdict.cause) == ("given_up", "nobody is at home")


@pytest.mark.parametrize("fails", [False, True])
def test_always_is_done_in_any_case_and_changes_no_outcome(fails):
    scripts = dict(WALK_FAILS) if fails else {}
    scripts[BalanceParams] = [Script(code="internal")]
    part = p.Always(name="walk", part=WALK, after=series(SAY, SQUAT))
    rig, verdict = play(series(part, WAIT), scripts)
    assert ids(rig) == ["1", "1.always.1", "1.always.2", *([] if fails else ["2"])]
    assert verdict is True if not fails else verdict.code == "fallen"


def test_always_comes_after_a_timeout_too():
    timed = p.Timeout(name="walk", part=WALK, limit_s=1.0)
    rig, verdict = play(
        p.Always(name="walk", part=timed, after=SAY), {NavigateParams: [Script(steps=1000)]}
    )
    assert verdict.code == "timeout"
    assert rig.troupe.names() == ["navigate", "say"]


def test_a_stop_by_the_operator_runs_no_always():
    part = p.Always(name="walk", part=WALK, after=SQUAT)
    rig = Rig({NavigateParams: [Script(steps=1000)]})
    rig.executive.submit(lambda stage: build(part, stage), text="task")
    rig.tick(5)
    rig.executive.stop("enough")
    assert rig.run().code == "cancelled"
    assert "balance" not in rig.troupe.names()


def test_parallel_parts_run_at_the_same_time_and_each_once():
    scripts = {
        NavigateParams: [Script(steps=20)],
        SayParams: [Script(steps=2, resources=frozenset({"voice"}))],
    }
    both = p.Parallel(name="both", parts=(WALK, series(SAY, SAY)))
    rig, verdict = play(series(both, WAIT), scripts)
    assert verdict is True
    assert ids(rig) == ["1.1", "1.2.1", "1.2.2", "2"]


def test_a_parallel_part_that_fails_ends_the_others():
    scripts = {
        NavigateParams: [Script(steps=1000)],
        SayParams: [Script(steps=2, code="internal", resources=frozenset({"voice"}))],
    }
    rig, verdict = play(p.Parallel(name="both", parts=(WALK, SAY)), scripts)
    assert verdict.code == "internal"
    assert rig.troupe.made[0].calls.count("stop") >= 1


def test_an_expectation_that_comes_true_in_time_holds():
    answers = [False, False, True]

    def question(_board):
        return answers.pop(0) if len(answers) > 1 else answers[0]

    finding = p.Finding(text="the cup stands", question=question)
    rig, verdict = play(p.Expect(name="expect", findings=(finding,)))
    assert verdict is True
    assert [e.data["so"] for e in rig.journal.recent if e.event == "expect"] == [True]


def test_an_expectation_that_is_wrong_says_what_is_there_instead():
    good = p.Finding(text="the sky is up", question=lambda board: True)
    bad = p.Finding(text="pigs fly", question=lambda board: False, found=lambda board: "they walk")
    rig, verdict = play(p.Expect(name="expect", findings=(good, bad)))
    assert verdict.code == "not_as_expected"
    assert verdict.cause.endswith("pigs fly (instead: they walk)")
    assert [e.data["so"] for e in rig.journal.recent if e.event == "expect"] == [True, False]


def test_a_branch_is_taken_as_before_when_the_run_goes_on():
    branch = p.Branch(name="if", question=lambda board: True, then=series(WALK), otherwise=PICK)
    rig, _ = play(series(branch, WAIT))
    events = [{"event": e.event, **e.data} for e in rig.journal.recent]
    assert finished(events) == {"1.then.1", "1?then", "2"}
    other = p.Branch(name="if", question=lambda board: False, then=series(WALK), otherwise=PICK)
    rig, _ = play(series(other, WAIT), done=frozenset({"1?then"}))
    assert ids(rig) == ["1.then.1", "2"]


def test_what_has_to_be_looked_at_comes_before_a_branch_is_taken():
    seen: list[str] = []

    def question(_board):
        return bool(seen)

    rig, _ = play(p.Branch(name="if", question=question, then=WAIT, otherwise=PICK, look=WALK))
    assert ids(rig) == ["look", "else"]
    seen.append("it")
    rig, _ = play(p.Branch(name="if", question=question, then=WAIT, otherwise=PICK, look=WALK))
    assert ids(rig) == ["look", "then"]


def test_without_the_look_neither_branch_is_taken():
    branch = p.Branch(name="if", question=lambda board: False, then=WAIT, otherwise=PICK, look=WALK)
    rig, verdict = play(series(branch), WALK_FAILS)
    assert verdict.code == "fallen"
    assert set(ids(rig)) == {"1.look"}


def test_a_skill_may_take_as_long_as_it_says():
    scripts = {NavigateParams: [Script(steps=10**6, limit_s=limit_s) for limit_s in (1.0, 3.0)]}
    _rig, verdict = play(WALK, scripts)
    assert verdict.code == "timeout"
    assert "longer than 3 s" in verdict.cause


def test_a_branch_that_was_taken_is_not_looked_at_again():
    branch = p.Branch(name="if", question=lambda board: False, then=WAIT, otherwise=PICK, look=WALK)
    rig, _ = play(series(branch, SAY), done=frozenset({"1?then"}))
    assert ids(rig) == ["1.then", "2"]
    assert before(series(branch, SAY), "1.then") == {"1?then"}
    assert before(series(branch, SAY), "1.look") == frozenset()
    assert before(series(branch, SAY), "2") == {"1/"}


def cut(rig: Rig, after: str) -> frozenset[str]:
    """What is done when a run is cut off after the first event of a step."""
    events = [{"event": e.event, **e.data} for e in rig.journal.recent]
    last = next(n for n, e in enumerate(events) if (e["event"], e.get("id")) == ("step", after))
    return finished(events[: last + 1])


def test_a_run_goes_on_in_the_attempt_that_it_was_in():
    retry = p.Retry(name="retry", part=series(PICK, WALK), attempts=3)
    part = series(retry, WAIT)
    turns = {NavigateParams: [Script(code="fallen"), Script()]}
    rig, verdict = play(part, turns)
    assert verdict is True
    assert ids(rig) == ["1.1", "1.2", "1*2.1", "1*2.2", "2"]
    rig_then, verdict = play(part, done=cut(rig, "1*2.2"))
    assert verdict is True
    assert ids(rig_then) == ["1*2.2", "2"]
    rig_then, _ = play(part, done=cut(rig, "2"))
    assert ids(rig_then) == ["2"], "what an attempt but the first has done is done"


def test_attempts_that_were_used_up_before_stay_so():
    retry = p.Retry(name="retry", part=WALK, attempts=3)
    rig, verdict = play(series(retry), WALK_FAILS)
    assert verdict is not True
    rig_then, verdict = play(series(retry), WALK_FAILS, done=cut(rig, "1*3"))
    assert verdict is not True
    assert ids(rig_then) == ["1*3"]


def test_beginning_at_a_step_leaves_out_what_comes_before():
    loop = p.Loop(name="3 times", bodies=(series(WALK, PICK),), at_most=3)
    timed = p.Timeout(name="t", part=series(WALK, loop), limit_s=60.0)
    part = series(WAIT, timed, WAIT)
    assert before(part, "9") is None
    assert before(part, "2.2#4") is None
    done = before(part, "2.2#2.2")
    assert done is not None
    rig, verdict = play(part, done=done)
    assert verdict is True
    assert ids(rig) == ["2.2#2.2", "2.2#3.1", "2.2#3.2", "3"]


# --- for any part -------------------------------------------------------------------------------

LEAVES = st.sampled_from([WALK, PICK, WAIT, SQUAT])


WRAPPERS = (
    lambda part: p.Retry(name="r", part=part, attempts=2),
    lambda part: p.Timeout(name="t", part=part, limit_s=1e6),
    lambda part: p.OnFail(name="f", part=part, handlers=(("any", SQUAT),)),
    lambda part: p.Always(name="a", part=part, after=SQUAT),
)
"""A step has each of them at most once, in this order."""


def _dressed(part: p.Part, chosen: tuple[bool, ...]) -> p.Part:
    for wrap, wanted in zip(WRAPPERS, chosen, strict=True):
        part = wrap(part) if wanted else part
    return part


def _wrapped(inner: st.SearchStrategy[p.Part]) -> st.SearchStrategy[p.Part]:
    several = st.lists(inner, min_size=1, max_size=3).map(tuple)
    bare = st.one_of(
        several.map(lambda parts: p.Series(name="s", parts=parts)),
        LEAVES,
        inner.map(lambda part: p.Loop(name="l", bodies=(part,), at_most=2)),
        st.tuples(inner, st.booleans()).map(
            lambda both: p.Branch(
                name="b",
                question=lambda board: both[1],
                then=both[0],
                otherwise=both[0],
                look=WALK if both[1] else None,
            )
        ),
    )
    return st.tuples(bare, st.tuples(*[st.booleans()] * 4)).map(lambda both: _dressed(*both))


PARTS = st.recursive(LEAVES, _wrapped, max_leaves=6).map(lambda part: series(part, WAIT))


@settings(max_examples=30, deadline=None)
@given(part=PARTS, data=st.data())
def test_a_run_that_is_taken_up_again_does_the_rest_and_only_the_rest(part, data):
    whole, verdict = play(part)
    assert verdict is True
    events = [{"event": e.event, **e.data} for e in whole.journal.recent]
    assert len(ids(whole)) == len(set(ids(whole)))  # paths are unique
    cut = data.draw(st.integers(0, len(events)))
    rest, verdict = play(part, done=finished(events[:cut]))
    assert verdict is True
    already = {event["id"] for event in events[:cut] if event["event"] == "done"}
    assert ids(rest) == [path for path in ids(whole) if path not in already]


@settings(max_examples=30, deadline=None)
@given(part=PARTS, data=st.data())
def test_any_step_can_be_begun_at(part, data):
    whole, _ = play(part)
    order = ids(whole)
    first = data.draw(st.sampled_from(order))
    done = before(part, first)
    assert done is not None
    rest, verdict = play(part, done=done)
    assert verdict is True
    assert ids(rest) == order[order.index(first) :]
