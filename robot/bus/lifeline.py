"""What a process of the robot asks of the system: its end, and its turn."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from enum import IntEnum
from types import FrameType

PR_SET_PDEATHSIG = 1
PR_SET_TIMERSLACK = 29
TIMER_SLACK_NS = 5_000
REAL_TIME_PRIORITY = 1


class Turn(IntEnum):
    """Who gives way to whom, as nice values: a step of 5 is three times the processor.

    Loops that are real-time come before all of them; what they hand over travels in threads that
    are not. Others on the computer have 0, and take turns with pictures rather than with the
    senses: a robot that does not see where it is cannot walk.
    """

    BODY = -12
    SENSES = -10
    EXECUTIVE = -10
    PLANNING = -8
    PICTURES = -6
    OTHERS = 0


class Stop:
    """False until SIGTERM or SIGINT asks the process to end."""

    def __init__(self) -> None:
        """Listen from now on; only in a main thread."""
        self._asked = False
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._hear)

    def __bool__(self) -> bool:
        """Whether to stop."""
        return self._asked

    def _hear(self, _number: int, _frame: FrameType | None) -> None:
        self._asked = True


def tie_to_parent(parent_pid: int) -> None:
    """Die at once (SIGKILL) when the parent's starting thread ends, however it ends.

    If that was before this was asked for, it dies here, in the same way: nobody is left to be told.
    Also asks the kernel for exact sleeps. Linux only; elsewhere nothing happens.
    """
    if sys.platform != "linux":
        return
    libc = ctypes.CDLL(None, use_errno=True)
    libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    libc.prctl(PR_SET_TIMERSLACK, TIMER_SLACK_NS, 0, 0, 0)
    if os.getppid() != parent_pid:
        os.kill(os.getpid(), signal.SIGKILL)


def ask_for_real_time() -> bool:
    """Let this thread run before everything that is not real-time; says whether that was granted.

    It takes root, CAP_SYS_NICE or an `rtprio` limit; without, the loop runs like any other.
    """
    if sys.platform != "linux":
        return False
    policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    try:
        os.sched_setscheduler(0, policy, os.sched_param(REAL_TIME_PRIORITY))
    except OSError:
        return False
    return True


def ask_for_turn(turn: Turn) -> bool:
    """Let this thread, and those that it begins, run before others; says if that was granted.

    It takes root, CAP_SYS_NICE or a `nice` limit; without, all stays as it is.
    """
    try:
        os.setpriority(os.PRIO_PROCESS, 0, turn)
    except OSError:
        return False
    return True
