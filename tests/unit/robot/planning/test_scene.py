"""The planner's own model says what touches, at the clearance asked for."""

import numpy as np

from robot.messages import Shape
from robot.planning.requests import Held
from robot.planning.robot_body import UPRIGHT, Body
from robot.planning.scene import Scene
from robot.planning.solids import Solid
from robot.se3 import SE3


def wall(x: float) -> Solid:
    return Solid(id="wall", kind="box", size_m=(0.1, 4.0, 2.0), X_WG=SE3((x + 0.05, 0.0, 1.0)))


def standing(body: Body, scene: Scene) -> None:
    stand = body.standing(UPRIGHT)
    scene.pose(stand.X_SB, stand.q)
    scene.update()


def test_a_robot_standing_free_touches_nothing(body: Body) -> None:
    scene = Scene(body.description, (wall(0.5),))
    scene.set_clearance(0.05)
    standing(body, scene)
    assert scene.touches(np.ones(scene.model.ngeom, dtype=bool)) == []


def test_clearance_decides_what_touches(body: Body) -> None:
    scene = Scene(body.description, (wall(0.20),))
    standing(body, scene)
    scene.set_clearance(0.0)
    assert scene.touches(scene.trunk_geoms) == []
    scene.set_clearance(0.05)
    touches = scene.touches(scene.trunk_geoms)
    assert {touch.second for touch in touches} == {"wall"}
    assert all(0.0 < touch.distance_m < 0.05 for touch in touches)


def test_what_may_be_touched_is_left_out(body: Body) -> None:
    scene = Scene(body.description, (wall(0.1),))
    scene.set_clearance(0.0)
    standing(body, scene)
    assert scene.touches(scene.trunk_geoms)
    assert scene.touches(scene.trunk_geoms, allowed=frozenset({"wall"})) == []


def test_a_held_thing_moves_with_the_hand(body: Body) -> None:
    rod = Shape(kind="box", size_m=(0.02, 0.02, 0.4))
    held = Held(id="rod", shape=rod, X_GO=SE3())
    grasp = Scene(body.description)
    standing(body, grasp)
    hand = grasp.grasp_pose("right")
    ball = Solid(
        id="post", kind="cylinder", size_m=(0.02, 0.02, 0.02), X_WG=SE3(hand.apply((0, 0, 0.18)))
    )
    assert not _touched(body, Scene(body.description, (ball,)))
    assert "held" in _touched(body, Scene(body.description, (ball,), ("right", held)))


def test_a_thing_can_be_moved_without_a_new_model(body: Body) -> None:
    ball = Solid(id="ball", kind="cylinder", size_m=(0.1, 0.1, 0.1), X_WG=SE3())
    scene = Scene(body.description, (), None, (ball,))
    scene.move_thing(SE3((3.0, 0.0, 0.3)))
    assert not _touched(body, scene)
    scene.move_thing(SE3((0.0, 0.0, 0.3)))
    scene.move_thing(SE3((0.1, 0.1, 0.3)))
    assert _touched(body, scene)


def _touched(body: Body, scene: Scene) -> set[str]:
    scene.set_clearance(0.0)
    standing(body, scene)
    return {t.first for t in scene.touches(np.ones(scene.model.ngeom, dtype=bool))}
