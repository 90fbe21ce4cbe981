"""Pictures of a scene that is put into postures: `robot.reality.studio`."""

# pyright: basic

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

import mujoco
import numpy as np

from robot.closing import Closing
from robot.reality.studio import Image, Standing
from robot.reality.visual_scene import Flat
from sim.plant import Plant, close_couplings
from sim.render import Renderer, View

SHADOW_PX = 1024
"""Of the shadow map: a picture takes a tenth of the time that MuJoCo's 4096 take."""
WALLS = 1
"""Their group (`sim.bodies`): of a home of many rooms they would stand before the robot."""
NOWHERE = (0.0, 0.0, -50.0, 1.0, 0.0, 0.0, 0.0)
LOOK = View(distance_m=3.4, heading_deg=125.0, down_deg=20.0)


class FilmStudio(Closing):
    """A plant that is not run."""

    def __init__(self, plant: Plant, *, width: int, height: int) -> None:
        """Prepare; nothing is opened before `with`."""
        self._model: Any = plant.model
        self._data: Any = plant.data
        self._robot = plant.robot
        self._world = plant.world
        self._motors = plant.motors.q_index
        base = plant.model.body(plant.robot.base_body).id
        self._base = int(plant.model.jnt_qposadr[plant.model.body_jntadr[base]])
        plant.model.vis.quality.shadowsize = SHADOW_PX
        self._renderer = Renderer(plant.model, width=width, height=height)
        if len(plant.world.rooms) > 1:
            self._renderer.leave_out(WALLS)

    def __enter__(self) -> Self:
        """Open what renders."""
        self._renderer.__enter__()
        return self

    @property
    def by(self) -> str:
        """What renders, for people: EGL or rays."""
        return self._renderer.by

    def close(self) -> None:
        """Free the context."""
        self._renderer.close()

    def shoot(self, standing: Standing, *, at_m: tuple[float, float]) -> Image:
        """One picture, which looks at a point of the floor."""
        model, data = self._model, self._data
        data.qpos[self._base : self._base + 7] = standing.base
        if len(standing.q) == len(self._motors):
            data.qpos[self._motors] = standing.q
        close_couplings(model, data.qpos)
        self._put("object", standing.objects, [item.id for item in self._world.objects])
        self._put("person", standing.people, [item.id for item in self._world.people])
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_camlight(model, data)
        view = View(
            at=(*at_m, 0.7), distance_m=LOOK.distance_m, heading_deg=LOOK.heading_deg,
            down_deg=LOOK.down_deg,
        )  # fmt: skip
        return np.ascontiguousarray(self._renderer.image(data, view))

    def _put(self, kind: str, poses: Mapping[str, Flat | None], ids: list[str]) -> None:
        model, data = self._model, self._data
        for one in ids:
            body = int(model.body(f"{kind}/{one}").id)
            pose, mocap = poses.get(one) or NOWHERE, int(model.body_mocapid[body])
            if mocap >= 0:
                data.mocap_pos[mocap], data.mocap_quat[mocap] = pose[:3], pose[3:]
            else:
                first = int(model.jnt_qposadr[model.body_jntadr[body]])
                data.qpos[first : first + 7] = pose
