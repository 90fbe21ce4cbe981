"""A world as a MuJoCo scene: physics options, lights, and the robot in it.

Bodies of the world are called `furniture/ID`, `object/ID`, `person/ID`, `wall/ID`, so that no name
collides with the robot's, which keep theirs.
"""

from __future__ import annotations

import mujoco

from robot.model import mjcf
from robot.model.description import RobotDescription
from sim import atlas, bodies, motors, person_body, placing
from sim.paint import Paint
from sim.world_schema import World

GROUND_M = 40.0


def compile_scene(
    world: World, description: RobotDescription, *, timestep_s: float = 0.001
) -> mujoco.MjModel:
    """The robot, with its motors, in the world; every object must have a spot.

    Raises:
        DescriptionError: if the robot's description and its MJCF disagree.
    """
    spec = mjcf.spec(description.source)
    motors.install(spec, description)
    for key in list(spec.keys):
        spec.delete(key)
    set_physics(spec)
    spec.option.timestep = timestep_s
    furnish(spec, world)
    return spec.compile()


def furnish(spec: mujoco.MjSpec, world: World) -> None:
    """Add floor, walls, furniture, people, objects and light to a scene."""
    paint = Paint(spec)
    set_light(spec, world.bounds_m)
    _floor(spec, world, paint)
    for room in world.rooms:
        for wall in atlas.walls(room):
            bodies.add_wall(spec, wall, paint)
    for item in world.furniture:
        bodies.add_furniture(spec, item, paint)
    for person in world.people:
        person_body.add_person(spec, person, paint)
    bodies.add_sills(spec)
    poses = placing.object_poses(world)
    for item in world.objects:
        bodies.add_object(spec, item, poses[item.id], paint)


def set_physics(spec: mujoco.MjSpec) -> None:
    """Options that hold grasps, and cost little.

    An elliptic cone and impratio 100 stop the creep of friction. What rests sleeps until touched
    (in a furnished room that halves the time of a step); bodies here have few geoms, so the middle
    phase of collision only costs; sparse Jacobians make a step of a walking robot a quarter faster.
    """
    option = spec.option
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 100.0
    option.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE
    option.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_MIDPHASE


def _floor(spec: mujoco.MjSpec, world: World, paint: Paint) -> None:
    """One plane to stand on; each room's covering is a film half a millimetre above, to look at."""
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[GROUND_M, GROUND_M, 0.1],
        material=paint.plain("ground", (0.47, 0.49, 0.51)),
        friction=bodies.FLOOR_FRICTION,
        condim=3,
    )
    for room in world.rooms:
        half = (room.size_m[0] / 2, room.size_m[1] / 2)
        spec.worldbody.add_geom(
            name=f"covering/{room.id}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[*half, 0.00025],
            pos=[*room.at_m, 0.00025],
            material=paint.floor(room.floor, room.size_m),
            contype=0,
            conaffinity=0,
        )


def set_light(spec: mujoco.MjSpec, bounds_m: tuple[float, float, float, float]) -> None:
    """A soft sky, a lamp with shadows and one to fill over x_min, y_min, x_max, y_max."""
    visual = spec.visual
    visual.headlight.ambient[:] = [0.44, 0.44, 0.44]
    visual.headlight.diffuse[:] = [0.24, 0.24, 0.24]
    visual.headlight.specular[:] = [0.05, 0.05, 0.05]
    visual.quality.shadowsize = 4096
    visual.quality.offsamples = 4
    visual.global_.offwidth, visual.global_.offheight = 1920, 1080
    visual.map.znear, visual.map.zfar = 0.01, 40.0
    visual.map.shadowclip, visual.map.shadowscale = 1.6, 0.6
    x_min, y_min, x_max, y_max = bounds_m
    x, y = (x_min + x_max) / 2, (y_min + y_max) / 2
    spec.stat.center[:] = [x, y, 0.6]
    spec.stat.extent = max(3.0, min(8.0, 0.6 * max(x_max - x_min, y_max - y_min)))
    spec.worldbody.add_light(
        name="lamp", type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, castshadow=True,
        pos=[x + 1.5, y - 2.0, 5.0], dir=[-0.35, 0.45, -1.0],
        diffuse=[0.42, 0.41, 0.39], specular=[0.15, 0.15, 0.15], ambient=[0, 0, 0],
    )  # fmt: skip
    spec.worldbody.add_light(
        name="fill", type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, castshadow=False,
        pos=[x - 3.0, y + 3.0, 5.0], dir=[0.6, -0.5, -0.8],
        diffuse=[0.14, 0.15, 0.17], specular=[0, 0, 0], ambient=[0, 0, 0],
    )  # fmt: skip
    spec.add_texture(
        name="sky", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.78, 0.85, 0.92], rgb2=[0.55, 0.62, 0.70], width=256, height=1536,
    )  # fmt: skip
