"""What can be done about a failure before the step is tried again, and what people are asked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from executive.skills.balance import BalanceParams
from executive.skills.look import LookParams
from executive.skills.navigate import NavigateParams, Step
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.trees.parts import Errand
from robot.failures import Failure

Remedy = Literal["retry", "wait", "look_again", "fetch_again", "step_back", "get_up", "ask"]

WAIT_S = 3.0
STEADY_S = 2.0
STEP_BACK_M = 0.3
EYE_LEVEL_M = 1.1


def _retry(_errand: Errand, _reason: Failure) -> tuple[Errand, ...]:
    return ()


def _wait(_errand: Errand, reason: Failure) -> tuple[Errand, ...]:
    """Stand for a while, with an eye on what is in the way."""
    stand = Errand(name="stand and wait", params=BalanceParams(mode="stand", duration_s=WAIT_S))
    x_m, y_m = reason.evidence.get("x_m"), reason.evidence.get("y_m")
    if not isinstance(x_m, float) or not isinstance(y_m, float):
        return (stand,)
    look = LookParams(p_W=(x_m, y_m, EYE_LEVEL_M))
    return (Errand(name="look at what is in the way", params=look), stand)


def _step_back(errand: Errand, reason: Failure) -> tuple[Errand, ...]:
    params = NavigateParams(by=Step(forward_m=-STEP_BACK_M, or_less=True))
    return (Errand(name="step back", params=params), *_look_again(errand, reason))


def _look_again(errand: Errand, _reason: Failure) -> tuple[Errand, ...]:
    if errand.object_id is None or errand.carries:
        return ()
    params = SearchParams(object_id=errand.object_id)
    return (Errand(name=f"look for {errand.object_name}", params=params),)


def _fetch_again(errand: Errand, reason: Failure) -> tuple[Errand, ...]:
    if errand.object_id is None or not errand.carries:
        return _look_again(errand, reason)
    search = SearchParams(object_id=errand.object_id)
    goal = errand.params.place_id if isinstance(errand.params, PlaceParams) else None
    pick = PickParams(object_id=errand.object_id, for_place_id=goal)
    return (
        Errand(name=f"look for {errand.object_name}", params=search),
        Errand(name=f"pick up {errand.object_name} again", params=pick),
    )


def _get_up(_errand: Errand, _reason: Failure) -> tuple[Errand, ...]:
    params = BalanceParams(mode="get_up", duration_s=STEADY_S)
    return (Errand(name="get up", params=params),)


REMEDIES: dict[Remedy, tuple[str, Callable[[Errand, Failure], tuple[Errand, ...]]]] = {
    "retry": ("try again", _retry),
    "wait": ("wait, then try again", _wait),
    "look_again": ("look again, then retry", _look_again),
    "fetch_again": ("fetch it again, then retry", _fetch_again),
    "step_back": ("step back, then retry", _step_back),
    "get_up": ("get up if allowed, then retry", _get_up),
    "ask": ("ask for help, then retry", _retry),
}
"""Remedy to its name for people and the steps that come before the next attempt."""


def is_idle(remedy: Remedy, reason: Failure) -> bool:
    """Whether a remedy would only do again what the failure says was done to its end."""
    looked = reason.evidence.get("looked")
    if looked == "from all sides":  # the top of a rack, above the eyes
        return remedy in ("wait", "ask")
    return remedy == "look_again" and looked == "everywhere"


ASKING: frozenset[Remedy] = frozenset({"get_up", "ask"})
"""Remedies that begin with a question to a person."""

_SHOW = "please put {it} upright where I can see and reach it"
_CLEAR = "please clear the way"
_LEAVE = "may I get up? Please see that nobody and nothing is near me"

HELP: dict[str, str] = {
    "no_path": _CLEAR,
    "path_blocked": _CLEAR + "{where}",
    "walk_stalled": "please free me from what holds me",
    "start_in_collision": "please take away what I touch",
    "goal_in_collision": "please make room around {it}",
    "no_stance": "please clear the floor in front of {it}",
    "no_free_spot": "please make room where {it} is to go",
    "no_grasp": _SHOW,
    "out_of_reach": _SHOW,
    "grasp_missed": _SHOW,
    "wrong_object": _SHOW,
    "object_dropped": _SHOW,
    "object_not_seen": _SHOW,
    "place_not_seen": "please clear the way to {it} and the view of it",
    "not_made_out": "please turn it so that I can see what it is, or take it away",
    "on_the_floor": _SHOW,
    "place_missed": _SHOW,
    "arm_stalled": "please clear the way of my arm",
    "not_taken": "please take {it} out of my hand",
    "person_near": "please step back from me",
    "person_not_seen": "please stand where I can see you",
    "localisation_lost": "please see that I can find out where I am",
    "sensor_silent": "please check my sensors",
    "lost_balance": _LEAVE,
    "fallen": _LEAVE,
    "hands_full": "please take something out of my hands",
}
"""Failure code to what a person is asked to do; `{it}` is what the step is about."""


def question(reason: Failure, errand: Errand) -> str:
    """What a person is asked: "please move ..., then say continue"."""
    x_m, y_m = reason.evidence.get("x_m"), reason.evidence.get("y_m")
    where = f" at ({x_m}, {y_m}) m" if x_m is not None and y_m is not None else ""
    wish = HELP[reason.code].format(it=errand.object_name or "it", where=where)
    return f"{reason.cause}; {wish}, then say continue"
