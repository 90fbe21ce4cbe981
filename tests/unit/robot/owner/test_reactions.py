"""The owner's ladder: whatever happens, the worst wins, stays, and only a person ends it."""

import random
from dataclasses import dataclass

import pytest

from robot.drivers.motors.alarms import Level
from robot.owner.reactions import (
    AT_MOST_S,
    BY_CODE,
    HOLDS_S,
    ROWS,
    WELL,
    Refused,
    Signs,
    State,
    after,
    reset,
)

PERIOD_S = 0.002
SEEDS = range(30)


def random_signs(dice: random.Random) -> Signs:
    """Each sign is off, has just begun, or has lasted long."""
    return Signs(*(dice.choice((0.0, 0.0, 0.0, 0.004, 0.05, 3.0)) for _ in Signs._fields))


def worst_of(signs: Signs, level: Level) -> Level:
    return max((row.level for row in ROWS if row.holds(signs, level)), default=Level.OK)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_latched_never_gets_less_and_the_most_severe_wins(seed):
    dice, state = random.Random(seed), WELL
    for _ in range(40):
        signs = random_signs(dice)
        new = after(state, signs)
        wanted = worst_of(signs, state.level)
        if state.latched:
            wanted = max(wanted, *(BY_CODE[code].level for code in state.latched))
        assert new.level == wanted
        assert new.latched >= state.latched
        assert not state.latched or new.level >= state.level
        state = new


@pytest.mark.parametrize("seed", SEEDS)
def test_the_code_is_that_of_a_row_at_the_level(seed):
    dice, state = random.Random(seed), WELL
    for _ in range(40):
        state = after(state, random_signs(dice))
        if state.level == Level.OK:
            assert state.code == ""
        else:
            assert BY_CODE[state.code].level == state.level


def test_everything_from_the_sit_on_is_latched_and_nothing_before():
    assert all(row.is_latched == (row.level >= Level.SIT) for row in ROWS)


def test_no_sign_no_row():
    assert after(WELL, Signs()) == WELL


@dataclass
class Silence:
    """A controller that stops commanding at 0, and what else is so."""

    astray_s: float = 0.0

    def states(self, periods: int) -> list[State]:
        state, told = WELL, []
        for period in range(1, periods + 1):
            state = after(state, Signs(silent_s=period * PERIOD_S, astray_s=self.astray_s))
            told.append(state)
        return told


def test_silence_holds_for_6_ms_and_then_lowers():
    levels = [state.level for state in Silence().states(6)]
    assert levels == [Level.HOLD] * round(HOLDS_S / PERIOD_S) + [Level.SIT] * 3


def test_a_robot_that_does_not_stand_damps_instead():
    levels = [state.level for state in Silence(astray_s=1.0).states(6)]
    assert levels == [Level.HOLD] * 3 + [Level.DAMP] * 3


def test_where_a_controller_has_claimed_the_motors_it_holds_for_20_ms():
    state = WELL
    for period in range(1, 11):
        state = after(state, Signs(silent_s=period * PERIOD_S, claimed_s=1.0))
        assert state.level == Level.HOLD
    state = after(state, Signs(silent_s=AT_MOST_S + PERIOD_S, claimed_s=1.0))
    assert (state.level, state.code) == (Level.SIT, "controller_silent")


def test_a_command_within_the_hold_ends_it_as_if_nothing_had_been():
    held = Silence().states(3)[-1]
    assert held.level == Level.HOLD
    assert after(held, Signs()) == WELL


def test_a_command_after_it_changes_nothing():
    lowering = Silence().states(4)[-1]
    assert after(lowering, Signs()) == lowering


def test_the_way_down_ends_without_torque():
    state = Silence().states(4)[-1]
    state = after(state, Signs(silent_s=3.0, lowering_s=2.5, seated_s=0.4))
    assert state.level == Level.SIT
    state = after(state, Signs(silent_s=3.0, lowering_s=3.0, seated_s=0.51))
    assert (state.level, state.code) == (Level.DAMP, "seated")
    state = after(state, Signs(silent_s=6.0, seated_s=3.0, damping_s=1.9))
    assert state.level == Level.DAMP
    state = after(state, Signs(silent_s=6.0, seated_s=3.0, damping_s=2.1))
    assert (state.level, state.code) == (Level.OFF, "at_rest")


def test_a_foot_that_unloads_for_a_moment_on_the_way_down_is_no_fall():
    state = Silence().states(4)[-1]
    state = after(state, Signs(silent_s=0.5, lowering_s=0.4, astray_s=0.02))
    assert state.level == Level.SIT
    state = after(state, Signs(silent_s=0.6, lowering_s=0.5, astray_s=0.12))
    assert (state.level, state.code) == (Level.DAMP, "tipping")


@pytest.mark.parametrize("level", [Level.OK, Level.HOLD, Level.SIT, Level.DAMP])
def test_the_stop_input_takes_all_torque_from_anywhere(level):
    begun = {
        Level.OK: WELL,
        Level.HOLD: Silence().states(1)[-1],
        Level.SIT: Silence().states(4)[-1],
        Level.DAMP: Silence(astray_s=1.0).states(4)[-1],
    }[level]
    assert begun.level == level
    assert after(begun, Signs(stop_s=PERIOD_S)).level == Level.OFF


@pytest.mark.parametrize("seed", SEEDS)
def test_a_reset_is_taken_only_where_no_torque_is_given_and_nothing_is_wrong(seed):
    dice, state = random.Random(seed), WELL
    for _ in range(40):
        state = after(state, random_signs(dice))
        signs = random_signs(dice)
        answer = reset(state, signs)
        pressed = signs.stop_s > 0.0
        gives_torque = bool(state.latched) and state.level < Level.OFF
        assert isinstance(answer, Refused) == (pressed or gives_torque)
        if isinstance(answer, State):
            assert answer == WELL
            state = answer


def test_a_reset_while_the_stop_is_pressed_says_so():
    off = after(WELL, Signs(stop_s=0.1))
    refused = reset(off, Signs(stop_s=0.2))
    assert isinstance(refused, Refused)
    assert refused.code == "stop_pressed"
    assert "release" in refused.cure
    assert reset(off, Signs()) == WELL
