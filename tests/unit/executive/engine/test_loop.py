"""The loop wakes up at once, counts every Ctrl-C, and leaves nobody with stiff motors by chance."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

from executive.engine.executive import Executive
from executive.engine.loop import Interrupts, run
from executive.journal.journal import Journal
from executive.skills.context import SkillContext
from executive.skills.wait import WaitParams
from executive.trees.build import build
from executive.trees.parts import Errand, Series
from robot.clock import Waker
from robot.messages import Damp, Stand
from tests.fakes.puppet_runtime import PuppetRuntime
from tests.fakes.waiting import HANG_S, eventually
from tests.fakes.worlds import JUNO, puppet

FOREVER = Errand(name="wait", params=WaitParams())
NEVER_S = 10 * HANG_S


class Sleeper(PuppetRuntime):
    """A runtime that would sleep for very long between two ticks, if it were not woken."""

    def __post_init__(self):
        super().__post_init__()
        self.waker = Waker()

    def advance(self, duration_s):
        self.waker.wait(NEVER_S)
        super().advance(duration_s)

    def wake(self):
        self.waker.wake()


def executive_on(runtime):
    context = SkillContext(link=runtime.link, planner=runtime.planner, description=JUNO)
    executive = Executive(context, Journal(), rates_hz={})
    task = Series(name="task", parts=(FOREVER,))
    executive.submit(lambda stage: build(task, stage), text="wait")
    return executive


def in_a_thread(runtime, executive, **more):
    given = {"interrupts": Interrupts(), **more}
    thread = threading.Thread(target=run, args=(runtime, executive), kwargs=given)
    thread.start()
    return thread


def test_a_request_from_another_thread_cuts_the_wait_short():
    runtime = Sleeper(puppet())
    executive = executive_on(runtime)
    thread = in_a_thread(runtime, executive)
    assert eventually(lambda: executive.on_request.__name__ == "wake")
    executive.pause()
    assert eventually(lambda: executive.state == "pausing")
    executive.stop("enough")
    while thread.is_alive():  # every further tick needs somebody to wake it
        runtime.wake()
        time.sleep(0.001)
    assert executive.outcome.failure.code == "cancelled"


def test_a_ctrl_c_cuts_the_wait_short_and_stops():
    runtime = Sleeper(puppet())
    executive = executive_on(runtime)
    interrupts = Interrupts()
    thread = in_a_thread(runtime, executive, interrupts=interrupts)
    assert eventually(lambda: executive.on_request.__name__ == "wake")
    interrupts.press()
    assert eventually(lambda: any(isinstance(sent, Stand) for sent in runtime.puppet.sent))
    while thread.is_alive():
        runtime.wake()
        time.sleep(0.001)
    assert runtime.puppet.mode == "stand"


PRESS_TWICE = """
import os, re, signal, sys, time
pid = int(sys.argv[1])
sys.stdin.read()
for _ in range(2):
    os.kill(pid, signal.SIGINT)
    # Of two signals that wait the kernel makes one: the next is sent when this one has arrived.
    while any(int(word, 16) >> signal.SIGINT - 1 & 1
              for word in re.findall(r"Pnd:\\t(.*)", open(f"/proc/{pid}/status").read())):
        time.sleep(0.001)
"""


def test_two_signals_in_one_long_call_are_two():
    interrupts = Interrupts()
    command = [sys.executable, "-S", "-c", PRESS_TWICE, str(os.getpid())]
    with interrupts.listen(), subprocess.Popen(command, stdin=subprocess.PIPE) as presser:
        assert presser.stdin is not None
        presser.stdin.close()
        while presser.poll() is None:
            sum(range(10_000_000))  # a call that lets no handler run before it is over
        assert presser.returncode == 0
        assert eventually(lambda: interrupts.count == 2)


HUP, TERM, INT = signal.SIGHUP, signal.SIGTERM, signal.SIGINT


@pytest.mark.parametrize(
    ("signals", "count"),
    [((HUP, HUP), 1), ((HUP, TERM, HUP, TERM), 1), ((TERM, TERM, TERM), 1), ((HUP, INT), 1),
     ((INT, HUP, TERM), 1), ((INT, HUP, INT), 2)],
)  # fmt: skip
def test_hang_ups_and_terminations_are_one_wish_however_many(signals, count):
    interrupts = Interrupts()
    before = signal.signal(HUP, signal.SIG_DFL)  # the tests may be run under nohup
    try:
        with interrupts.listen():
            for number in signals:
                os.kill(os.getpid(), number)
            assert eventually(lambda: interrupts.pressed == len(signals))
        assert interrupts.count == count
    finally:
        signal.signal(HUP, before)


def test_a_terminal_that_is_closed_while_it_works_brings_it_to_a_stand():
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    runtime.at = [(1.0, interrupts.wish)] * 3 + [(1.02, interrupts.wish)]
    executive = executive_on(runtime)
    run(runtime, executive, interrupts=interrupts)
    assert not any(isinstance(sent, Damp) for sent in runtime.puppet.sent)
    assert runtime.puppet.mode == "stand"
    assert executive.outcome.failure.code == "cancelled"


def test_the_third_ctrl_c_leaves_at_once_with_the_motors_damped():
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    runtime.at = [(1.0, lambda: interrupts.press(3))]
    with pytest.raises(KeyboardInterrupt):
        run(runtime, executive_on(runtime), interrupts=interrupts)
    assert isinstance(runtime.puppet.sent[-1], Damp)


def test_two_presses_in_one_tick_damp():
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    runtime.at = [(1.0, interrupts.press), (1.0, interrupts.press)]
    executive = executive_on(runtime)
    run(runtime, executive, interrupts=interrupts)
    assert isinstance(runtime.puppet.sent[-1], Damp)
    assert executive.outcome.failure.code == "cancelled"


@pytest.mark.parametrize("number", [INT, TERM])
def test_what_keeps_a_fast_robot_waiting_is_broken_off(number):
    """Whatever computes in a tick, and however long: a plan in a hall of a thousand tables."""
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    executive = executive_on(runtime)

    def compute():
        os.kill(os.getpid(), number)
        while True:
            sum(range(1000))

    runtime.at = [(1.0, compute)]
    with interrupts.listen(patience_s=0.05):
        run(runtime, executive, interrupts=interrupts)
    assert isinstance(runtime.puppet.sent[-1], Damp)
    assert executive.outcome.failure.code == "cancelled"


def test_a_press_that_a_tick_has_seen_breaks_nothing_off():
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    executive = executive_on(runtime)
    runtime.at = [(1.0, lambda: os.kill(os.getpid(), INT)), (1.1, lambda: time.sleep(0.1))]
    with interrupts.listen(patience_s=0.05):
        run(runtime, executive, interrupts=interrupts)
        time.sleep(0.1)
    assert not any(isinstance(sent, Damp) for sent in runtime.puppet.sent)


def test_after_a_stop_the_next_ctrl_c_is_a_first_one_again():
    runtime = PuppetRuntime(puppet())
    interrupts = Interrupts()
    executive = executive_on(runtime)
    runtime.at = [(1.0, interrupts.press), (4.0, interrupts.press)]
    run(runtime, executive, interrupts=interrupts, until=lambda: runtime.clock.now_s() > 6.0)
    assert interrupts.count == 0
    assert not any(isinstance(sent, Damp) for sent in runtime.puppet.sent)
    assert sum(event.event == "stop" for event in executive.journal.recent) == 2


def test_time_stands_still_for_a_fast_robot_that_waits_for_its_operator():
    runtime = PuppetRuntime(puppet())
    executive = executive_on(runtime)
    executive.attended = True
    executive.pause()
    asked = []

    def until():
        if executive.state == "paused":
            asked.append(runtime.clock.now_s())
        if len(asked) == 3:
            executive.stop("enough")
        return executive.outcome is not None

    run(runtime, executive, interrupts=Interrupts(), until=until)
    assert len(set(asked)) == 1
