"""Faults on purpose strike when their trigger says, as often as it says, and mistakes are named."""

import pytest

from executive.journal.journal import Journal
from executive.missions import fault_plans
from executive.runs import faults
from robot.errors import ConfigError
from robot.planning.requests import BasePathRequest
from robot.reality.faults import Push
from tests.fakes.oracle_planner import RulePlanner

PUSH = {"fault": "push", "impulse_n_s": [0, 5, 0]}


class Runtime:
    def __init__(self):
        self.suffered = []

    def inject(self, fault):
        self.suffered.append(fault)


def injector(journal, *entries, **more):
    runtime = Runtime()
    plans = tuple(fault_plans.plan(entry) for entry in entries)
    return runtime, faults.Injector(plans, runtime, journal, begin_s=1.0, **more)


def run(journal, made, events):
    """Ten ticks a second; `events` by their time."""
    times = []
    for n in range(10, 100):
        now_s = n / 10
        for event, data in events.get(now_s, []):
            journal.write(now_s, event, **data)
        before = len(made.struck)
        made.tick(now_s)
        times += [now_s] * (len(made.struck) - before)
    return times


def test_a_time_is_counted_from_the_beginning_of_the_run():
    journal = Journal()
    runtime, made = injector(journal, {"at_s": 2.0, **PUSH})
    assert run(journal, made, {}) == [3.0]
    assert runtime.suffered == [Push(impulse_n_s=(0.0, 5.0, 0.0))]
    assert [event.data for event in journal.recent if event.event == "fault"] == [PUSH]


def test_a_step_triggers_by_name_or_id_after_a_delay_once():
    journal = Journal()
    _, made = injector(journal, {"step": "pick*", "after_s": 0.5, **PUSH}, {"step": "2.1", **PUSH})
    again = [("step", {"step": "pick up the cup", "id": "2.1"})]
    assert run(journal, made, {2.0: again, 4.0: again}) == [2.0, 2.5]


def test_a_phase_triggers_as_often_as_it_may():
    journal = Journal()
    _, made = injector(journal, {"phase": "lifting*", "step": "pick*", "times": 2, **PUSH})
    lift = ("phase", {"step": "pick it", "phase": "lifting the cup"})
    other = ("phase", {"step": "put it", "phase": "lifting the cup"})
    assert run(journal, made, {2.0: [lift], 3.0: [other], 4.0: [lift], 5.0: [lift]}) == [2.0, 4.0]


def test_draws_follow_the_seed():
    entry = {"fault": "shove", "strength_n_s": 5, "towards_deg": {"uniform": [-180, 180]}}

    def angle(seed):
        runtime, made = injector(Journal(), entry, seed=seed)
        made.tick(1.0)
        return runtime.suffered[0].towards_deg

    assert angle(1) == angle(1) != angle(2)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ({"fault": "pusch"}, "did you mean 'push'"),
        ({"fault": "slow_planer"}, "did you mean 'slow_planner'"),
        ({"fault": "fill_disk", "duration": 3}, "did you mean 'duration_s'"),
        ({"fault": "fill_disk", "duration_s": "long"}, "a number"),
        ({**PUSH, "phase": 3}, "phase"),
        (
            {**PUSH, "times": 0},
            "times of the trigger should be a whole number from 1 to 1000, not 0",
        ),
        ({**PUSH, "at_s": 1.0, "step": "pick"}, "either"),
        ({"fault": "shove", "strength_n_s": {"uniform": 3}}, "a list to draw from"),
    ],
)
def test_what_cannot_be_meant_is_refused(entry, message):
    with pytest.raises(ConfigError, match=message):
        fault_plans.plan(entry)


def test_words_of_the_prompt():
    shove = {"fault": "shove", "strength_n_s": 8, "towards_deg": 90}
    assert fault_plans.in_words("shove strength_n_s=8 towards_deg=90") == shove
    assert fault_plans.in_words("silence topic=lidar") == {"fault": "silence", "topic": "lidar"}
    with pytest.raises(ConfigError, match="key=value"):
        fault_plans.in_words("shove 8")


def test_a_full_disk_holds_the_journal_back_and_loses_nothing(tmp_path):
    with Journal(tmp_path) as journal:
        _, made = injector(journal, {"at_s": 1.0, "fault": "fill_disk", "duration_s": 2.0})
        for n in range(60):
            now_s = 1.0 + n / 10
            journal.write(now_s, "note", number=n)
            made.tick(now_s)
            if n == 20:
                assert journal.problem
        made.close()
        assert not journal.problem
    lines = (tmp_path / "journal.jsonl").read_text().splitlines()
    assert sum('"note"' in line for line in lines) == 60


def test_a_slow_planner_uses_up_its_budget_then_works_again():
    planner = faults.SlowPlanner(RulePlanner())
    _, made = injector(Journal(), {"fault": "slow_planner", "requests": 1}, planner=planner)
    made.tick(1.0)
    request = BasePathRequest(start=(0, 0, 0), goal=(1, 0, 0), around=None)
    first = planner.submit(request, now_s=1.0)
    assert planner.poll(first, now_s=2.0) is None
    assert planner.poll(first, now_s=3.1).code == "planner_timeout"
    second = planner.submit(request, now_s=3.2)
    assert second > 0
    planner.cancel(second)


def test_killing_the_executive_is_left_to_whoever_can():
    killed = []
    _, made = injector(Journal(), {"fault": "kill_executive"}, kill=lambda: killed.append(1))
    made.tick(1.0)
    assert killed == [1]
