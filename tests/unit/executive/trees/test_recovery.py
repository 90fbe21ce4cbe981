"""Whatever goes wrong in whatever order, recovery ends, and it ends with a code."""

from __future__ import annotations

from collections import Counter

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.trees.recovery import PER_STEP, PER_TASK, RULES, unasked
from executive.trees.remedies import HELP, REMEDIES, question
from robot.failures import CATALOGUE, Failure, failure
from tests.fakes.rig import PICK, PUT, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

CODES = sorted(CATALOGUE)


def at_first_try(rig: Rig) -> int:
    """How many steps were done without a recovery."""
    done = [event.data["id"] for event in rig.journal.recent if event.event == "done"]
    return sum("+" not in path for path in done)


lives = st.lists(st.one_of(st.none(), st.sampled_from(CODES)), min_size=1, max_size=30)


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(picks=lives, puts=lives, walks=lives, searches=lives)
def test_recovery_comes_to_an_end_whatever_fails_in_whatever_order(picks, puts, walks, searches):
    def scripts(codes):
        return [Script(code=code) for code in codes]

    rig = Rig(
        {
            PickParams: scripts(picks),
            PlaceParams: scripts(puts),
            NavigateParams: scripts(walks),
            SearchParams: scripts(searches),
        }
    )
    verdict = rig.begin(WALK, PICK, PUT, WAIT).run(4000)
    assert verdict is True or (isinstance(verdict, Failure) and verdict.code in CATALOGUE)
    recoveries = [event.data for event in rig.journal.recent if event.event == "recovery"]
    assert len(recoveries) <= PER_TASK + at_first_try(rig)
    for name in ("walk", "pick", "put", "wait"):
        assert sum(data["step"] == name for data in recoveries) <= PER_STEP


def test_a_long_job_that_gets_on_does_not_run_out_of_recoveries():
    rounds = 3 * PER_TASK
    rig = Rig({PickParams: [Script(code="grasp_missed"), Script()] * rounds})
    assert rig.begin(*[PICK, WAIT] * rounds).run(20 * rounds * 20) is True
    assert rig.executive.outcome.recoveries == rounds


def test_a_job_that_gets_on_with_nothing_ends_when_its_recoveries_are_spent():
    rig = Rig({PickParams: [Script(code="grasp_missed"), Script()] * 3 * PER_TASK})
    assert rig.begin(*[PICK] * 3 * PER_TASK).run().code == "grasp_missed"
    assert rig.executive.outcome.recoveries == PER_TASK


def test_remedies_go_from_local_to_global_and_a_person_comes_last():
    order = ["retry", "look_again", "fetch_again", "wait", "step_back", "get_up", "ask"]
    assert set(order) == set(REMEDIES)
    for rule in RULES.values():
        names = [remedy for remedy, _ in rule.tries]
        assert len(set(names)) == len(names)
        assert "ask" not in names[:-1]
        if "step_back" in names:
            assert set(names[names.index("step_back") + 1 :]) <= {"ask"}


def test_a_search_that_looked_everywhere_is_not_followed_by_another():
    rule = RULES["object_not_seen"]
    hidden = failure("object_not_seen", "it did not show")
    nowhere = failure("object_not_seen", "it is nowhere", looked="everywhere")
    assert rule.next(hidden, Counter()) == ("look_again", 1)
    assert rule.next(nowhere, Counter()) == ("ask", 1)


def test_nobody_waits_or_asks_for_a_view_that_the_home_itself_hides():
    rule = RULES["place_not_seen"]
    assert rule.next(failure("place_not_seen", "hidden"), Counter()) == ("wait", 1)
    above = failure("place_not_seen", "above the eyes", looked="from all sides")
    assert rule.next(above, Counter()) is None


def test_a_fallen_robot_gets_up_only_when_a_person_lets_it():
    rig = Rig({NavigateParams: [Script(code="fallen"), Script()]}).begin(WALK)
    rig.executive.attended = True
    rig.tick(100)
    assert "may I get up" in rig.executive.question
    assert "get up" not in [
        event.data["step"] for event in rig.journal.recent if event.event == "step"
    ]
    rig.executive.answer("continue")
    assert rig.run() is True
    steps = [event.data["step"] for event in rig.journal.recent if event.event == "step"]
    assert steps == ["walk", "get up", "walk"]


def test_a_fallen_robot_that_nobody_lets_up_stays_down():
    rig = Rig({NavigateParams: [Script(code="fallen"), Script()]}).begin(WALK)
    assert rig.run().code == "fallen"
    steps = [event.data["step"] for event in rig.journal.recent if event.event == "step"]
    assert steps == ["walk"]


def test_there_is_a_question_for_every_code_that_asks_for_help():
    assert unasked() == []
    assert set(HELP) <= set(CATALOGUE)
    asked = question(failure("path_blocked", "a chair is there", x_m=1.2, y_m=0.4), WALK)
    assert asked == "a chair is there; please clear the way at (1.2, 0.4) m, then say continue"
    asked = question(failure("grasp_missed", "it slipped"), PICK)
    assert "please put cup upright" in asked


def test_a_person_who_helps_gets_the_step_tried_again():
    rig = Rig({PickParams: [Script(code="hands_full"), Script()]})
    rig.begin(PICK, WAIT)
    for _ in range(60):
        rig.tick()
        if rig.stage.help.asker is not None:
            rig.executive.answer("continue")
            break
    assert rig.run() is True
    assert rig.troupe.names() == ["pick", "pick", "wait"]


def test_without_recovery_the_first_failure_is_the_last():
    rig = Rig({PickParams: [Script(code="grasp_missed")]})
    rig.stage.recovers = False
    assert rig.begin(PICK).run().code == "grasp_missed"
    assert rig.troupe.names() == ["pick"]
