"""Goals of the whole body: walking, following, postures, waiting."""

from __future__ import annotations

import math

from executive.meaning.handlers.putting import part_of_floor
from executive.meaning.identify import Scene, cannot
from executive.skills.balance import BalanceParams
from executive.skills.follow import FollowParams
from executive.skills.navigate import FloorPose, NavigateParams, Step
from executive.skills.stop import StopParams
from executive.skills.wait import WaitParams
from executive.trees.parts import Errand, Part
from intents import goals


def go_to(goal: goals.GoTo, scene: Scene) -> Part:
    """Walk to a place, a person or a pose, or by a step."""
    if goal.by is not None:
        by = goal.by
        step = Step(
            forward_m=by.forward_m or 0.0, left_m=by.left_m or 0.0, turn_rad=by.turn_rad or 0.0
        )
        return Errand(name=_walk_words(step), params=NavigateParams(by=step))
    if goal.pose is not None:
        pose = FloorPose(x_m=goal.pose.x_m, y_m=goal.pose.y_m, yaw_rad=goal.pose.yaw_rad)
        name = f"go to ({pose.x_m:.2f}, {pose.y_m:.2f})"
        return Errand(name=name, params=NavigateParams(pose=pose))
    if goal.place is None:
        raise cannot("invalid_goal", "go where?", suggestion="name a place")
    if goal.place == goals.OPERATOR:
        return go_to_person(goals.Person(who="operator"), scene)
    person = scene.knowledge.person(goal.place)
    if person is not None and not scene.knowledge.places(goal.place):
        return go_to_person(goals.Person(name=goal.place), scene)
    place = scene.places(goal.place)[0]
    if goal.part is not None and place.floor:
        name = f"go to the {goal.part.replace('_', ' ')} of the {goal.place}"
        return Errand(name=name, params=part_of_floor(place, goal.part))
    return Errand(name=f"go to the {goal.place}", params=NavigateParams(place_id=place.id))


def _walk_words(step: Step) -> str:
    words = [
        f"{abs(step.forward_m):.2g} m {'forward' if step.forward_m > 0 else 'back'}"
        if step.forward_m else "",
        f"{abs(step.left_m):.2g} m {'left' if step.left_m > 0 else 'right'}" if step.left_m else "",
    ]  # fmt: skip
    walk = " and ".join(word for word in words if word)
    side, turn_deg = "left" if step.turn_rad > 0 else "right", abs(math.degrees(step.turn_rad))
    turn = f"turn {turn_deg:.0f}° {side}" if step.turn_rad else ""
    return ", ".join(word for word in (turn, f"walk {walk}" if walk else "") if word) or "stay"


def go_to_person(person: goals.Person, scene: Scene) -> Errand:
    """One step: walk up to a person."""
    found = scene.person(person)
    return Errand(name=f"go to {found.name}", params=NavigateParams(person_id=found.id))


def follow(goal: goals.Follow, scene: Scene) -> Part:
    """Walk behind a person, to a place if one was said."""
    person = scene.person(goal.person)
    place = scene.places(goal.to)[0] if goal.to else None
    params = FollowParams(person_id=person.id, place_id=place.id if place else None)
    return Errand(name=f"follow {person.name}", params=params)


def balance(goal: goals.Balance, _scene: Scene) -> Part:
    """Take a posture, or get up."""
    if goal.mode == "sit":
        raise cannot("unsupported", "this robot cannot sit down yet", suggestion="let it squat")
    duration_s = 3.0 if goal.duration_s is None else goal.duration_s
    rises = goal.mode == "stand" and goal.duration_s is None  # "get up", "stand up"
    mode = "get_up" if rises else goal.mode
    params = BalanceParams(mode=mode, side=goal.side, duration_s=duration_s)
    words = {"stand": "stand", "squat": "squat", "one_leg": "stand on one leg", "lean": "lean"}
    return Errand(name=f"{words[goal.mode]} for {duration_s:g} s", params=params)


def wait(goal: goals.Wait, _scene: Scene) -> Part:
    """Do nothing for a span."""
    if goal.duration_s is None:
        raise cannot("invalid_goal", "wait for how long?", suggestion="say 'wait ten seconds'")
    params = WaitParams(duration_s=goal.duration_s)
    return Errand(name=f"wait {goal.duration_s:g} s", params=params)


def stop(_goal: goals.Goal, _scene: Scene) -> Part:
    """Come to a stand."""
    return Errand(name="come to a stand", params=StopParams())
