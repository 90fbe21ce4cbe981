"""Which parts of the body steps need: what decides on what can be done side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from executive.skills.catalogue import skill_of
from executive.skills.parameters import SkillParams
from executive.skills.say import Say
from executive.skills.skill import BODY, Resource

_ALL = BODY | frozenset[Resource]({"voice"})


def needed(params: SkillParams | Callable[..., Any]) -> frozenset[Resource]:
    """What one step takes. Parameters made from the blackboard are those of speech."""
    return skill_of(params).needs(params) if isinstance(params, SkillParams) else Say.resources


def needed_by(steps: Iterable[SkillParams | Callable[..., Any]]) -> frozenset[Resource]:
    """What several steps take, all together."""
    return frozenset[Resource]().union(*(needed(params) for params in steps))


def queued_for(steps: Iterable[SkillParams | Callable[..., Any]]) -> frozenset[Resource]:
    """What a job of these steps waits for in the queue, so that it happens in its turn.

    That is what they take, and the eyes where they tell of what there is to be seen: "count the
    cups" after a walk is about the cups at its end. A job that takes nothing (a wait) comes between
    those before it and those after it, words too.
    """
    asked = tuple(steps)
    eyes = any(callable(params) for params in asked)
    wanted = needed_by(asked) | (frozenset[Resource]({"head"}) if eyes else frozenset[Resource]())
    return wanted or _ALL


def conflicts(branches: Iterable[frozenset[Resource]]) -> frozenset[Resource]:
    """The parts of the body that more than one of the branches of a `parallel` wants."""
    seen: set[Resource] = set()
    twice: set[Resource] = set()
    for wanted in branches:
        twice |= wanted & seen
        seen |= wanted
    return frozenset(twice)
