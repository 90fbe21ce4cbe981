"""A world as a MuJoCo scene, added to the MJCF of a robot."""

from __future__ import annotations

import mujoco

from robot.model.description import RobotDescription
from sim import motors
from sim.schema import World

TIMESTEP_S = 0.001


def compile_scene(world: World, description: RobotDescription) -> mujoco.MjModel:
    """The robot, with its motors, in the world.

    Raises:
        DescriptionError: if the robot's description and its MJCF disagree.
    """
    spec = mujoco.MjSpec.from_file(str(description.mjcf_path()))
    motors.install(spec, description)
    for key in list(spec.keys):
        spec.delete(key)
    set_physics(spec)
    furnish(spec, world)
    return spec.compile()


def set_physics(spec: mujoco.MjSpec) -> None:
    """Options that hold grasps: an elliptic cone and impratio 100 stop the creep of friction."""
    option = spec.option
    option.timestep = TIMESTEP_S
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 100.0
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET


def furnish(spec: mujoco.MjSpec, world: World) -> None:
    """Add floor, walls, furniture, people and objects."""
    spec.worldbody.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[20.0, 20.0, 0.1],
        friction=[0.9, 0.01, 0.0005],
    )
