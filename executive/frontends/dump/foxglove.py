"""A run as MCAP with Foxglove's schemas; the only file that knows Foxglove's library.

Stamps are the wall clock's where the run began, and the robot's own time from there on.
"""

# pyright: basic

from __future__ import annotations

import errno
import io
from collections.abc import Iterable, Iterator
from typing import Any, BinaryIO

import numpy as np

from executive.frontends.dump import kinematics
from executive.journal.journal import Event
from executive.journal.motion import Moment
from executive.journal.run import Run
from executive.journal.sensed import Sensed
from robot.reality.visual_scene import Geom, Rgba, VisualBody, VisualScene
from robot.se3 import SE3
from robot.shots import Shot

WORLD = "world"
MOST_THINGS = 10_000
"""Each has a topic of its own, of which a file has at most 65,535."""
LEVELS = {
    "failure": "Error", "no recovery": "Error", "recovery": "Warning", "warning": "Warning",
    "fault": "Warning", "stop": "Warning", "abort": "Warning", "hold": "Warning",
}  # fmt: skip
"""Of what is told in words; all else is information."""


def recorded(
    run: Run,
    events: Iterable[Event],
    moments: Iterator[Moment],
    *,
    scene: VisualScene | None,
    motors: tuple[str, ...],
    began_s: float,
    sensed: Iterable[Sensed] = (),
    pictures: Iterable[Shot] = (),
) -> tuple[bytes, int]:
    """The bytes of the file, and how often something beyond the first `MOST_THINGS` was left out.

    Args:
        run: for what is told in words and for the tree.
        events: of the journal, as they are.
        moments: how everything moved.
        scene: what it looks like; None where nobody knows.
        motors: names of joint positions, in the order of the moments'.
        began_s: the wall clock at time 0 of the robot [s since 1970].
        sensed: what was sensed.
        pictures: what the camera saw.
    """
    file = io.BytesIO()
    writer = Writer(file, scene=scene, motors=motors, began_s=began_s, begin_s=run.begin_s)
    writer.news(run)
    for event in events:
        writer.event(event)
    for moment in moments:
        writer.moment(moment)
    for line in sensed:
        writer.sensed(line)
    for shot in pictures:
        writer.shot(shot)
    writer.close()
    return file.getvalue(), writer.left_out


class Writer:
    """A file that takes a run as it comes, a chunk at a time.

    Attributes:
        left_out: how often something beyond the first `MOST_THINGS` was left out.
    """

    def __init__(
        self,
        file: BinaryIO,
        *,
        scene: VisualScene | None,
        motors: tuple[str, ...],
        began_s: float,
        begin_s: float,
        chunk_bytes: int = 1 << 20,
    ) -> None:
        """Begin the file, with what everything looks like.

        Args:
            file: it is written to; whoever opened it closes it.
            scene: what it looks like; None where nobody knows.
            motors: names of joint positions, in the order of the moments'.
            began_s: the wall clock at time 0 of the robot [s since 1970].
            begin_s: the robot's time at which the run begins.
            chunk_bytes: what is written at a time; what has not been written a crash takes along.
        """
        import foxglove
        from foxglove import Channel, channels
        from foxglove.mcap import MCAPWriteOptions

        context = foxglove.Context()
        options = MCAPWriteOptions(profile="", compression_threads=0, chunk_size=chunk_bytes)
        self._mcap = foxglove.open_mcap(file, context=context, writer_options=options)
        self._scene_known, self._motors = scene, motors
        self._told = 0
        self._changed: dict[int, int] = {}
        self._began_s = began_s
        self._joints = channels.JointStatesChannel("/joint_states", context=context)
        self._transforms = channels.FrameTransformsChannel("/tf", context=context)
        self._fixed = channels.FrameTransformsChannel("/tf_static", context=context)
        self._scene = channels.SceneUpdateChannel("/scene", context=context)
        self._base = channels.PoseInFrameChannel("/base_pose", context=context)
        self._words = channels.LogChannel("/log", context=context)
        self._tree = Channel("/tree", message_encoding="json", context=context)
        self._events = Channel("/events", message_encoding="json", context=context)
        self._state = Channel("/state", message_encoding="json", context=context)
        self._scans = channels.LaserScanChannel("/scan", context=context)
        self._shots = {
            "colour": channels.CompressedImageChannel("/camera/image", context=context),
            "depth": channels.CompressedImageChannel("/camera/depth", context=context),
        }
        self._motors_told = Channel("/motors", message_encoding="json", context=context)
        self._things: dict[str, Any] = {}
        self.left_out = 0
        self._context = context
        self._bodies: dict[str, VisualBody] = {}
        if scene is not None:
            self._looks(scene, begin_s)

    def close(self) -> None:
        """Write what is left, and the index. Raises OSError if the file takes no more."""
        try:
            self._mcap.close()
        except RuntimeError as error:  # Foxglove's, once a write has failed
            raise OSError(errno.EIO, "the disk is full, or takes no more of it") from error

    # --- once ---

    def _looks(self, scene: VisualScene, t_s: float) -> None:
        """What everything looks like: it hangs on frames, which move."""
        from foxglove.messages import FrameTransforms, SceneUpdate

        still: list[Any] = []
        for place, body in enumerate(scene.bodies):
            if body.role in ("object", "person"):
                self._bodies[f"{body.role}/{body.id}"] = body
            elif body.role == "robot":
                still.append(self._entity(body.id, body, scene, SE3(), body.id, t_s))
            else:
                X_WB = kinematics.pose_of(body.X_PB)
                name = f"{body.role}/{body.id or place}"
                still.append(self._entity(WORLD, body, scene, X_WB, name, t_s))
        still = [entity for entity in still if entity is not None]
        self._scene.log(SceneUpdate(entities=still), log_time=self._ns(t_s))
        fixed = [
            self._transform(
                t_s, scene.bodies[body.parent].id, body.id, kinematics.pose_of(body.X_PB)
            )
            for body in kinematics.links(scene)
            if not kinematics.moves(body)
        ]
        self._fixed.log(FrameTransforms(transforms=fixed), log_time=self._ns(t_s))

    # --- what has come since the last time ---

    def news(self, run: Run) -> None:
        """What a run tells that was not yet told: words, and changes of the tree."""
        self._tell(run)
        self._changes(run)

    def _tell(self, run: Run) -> None:
        from foxglove.messages import Log, LogLevel

        lines, self._told = run.log[self._told :], len(run.log)
        for line in lines:
            level = getattr(LogLevel, LEVELS.get(line.kind, "Info"))
            told = Log(
                timestamp=self._stamp(line.t_s), level=level, message=line.text, name=line.kind
            )
            self._words.log(told, log_time=self._ns(line.t_s))

    def _changes(self, run: Run) -> None:
        changes: list[Any] = []
        for _, node in run.walk():
            known, self._changed[node.id] = self._changed.get(node.id, 0), len(node.changes)
            changes += [(change.t_s, node, change) for change in node.changes[known:]]
        for t_s, node, change in sorted(changes, key=lambda one: one[0]):
            record = {
                "id": node.id, "parent": node.parent, "kind": node.kind, "name": node.name,
                "state": change.state, "note": change.note,
            }  # fmt: skip
            self._tree.log(record, log_time=self._ns(t_s))

    # --- one after the other ---

    def event(self, event: Event) -> None:
        """A line of the journal."""
        record = {"n": event.n, "event": event.event, **event.data}
        self._events.log(record, log_time=self._ns(event.t_s))

    def moment(self, moment: Moment) -> None:
        """How everything stands."""
        from foxglove.messages import FrameTransforms, JointState, JointStates, PoseInFrame

        scene, motors = self._scene_known, self._motors
        at = self._ns(moment.t_s)
        stamp = self._stamp(moment.t_s)
        names = motors if len(motors) == len(moment.q) else map(str, range(len(moment.q)))
        pairs = zip(names, moment.q, strict=True)
        joints = [JointState(name=name, position=q) for name, q in pairs]
        self._joints.log(JointStates(timestamp=stamp, joints=joints), log_time=at)
        X_WB = kinematics.pose_of(moment.base)
        pose = PoseInFrame(timestamp=stamp, frame_id=WORLD, pose=_pose(X_WB))
        self._base.log(pose, log_time=at)
        found: list[Any] = []
        if scene is not None:
            base = scene.bodies[scene.base].id
            found.append(self._transform(moment.t_s, WORLD, base, X_WB))
            found += [
                self._transform(
                    moment.t_s,
                    scene.bodies[body.parent].id,
                    body.id,
                    kinematics.in_parent(body, moment.q),
                )
                for body in kinematics.links(scene)
                if kinematics.moves(body)
            ]
            self._transforms.log(FrameTransforms(transforms=found), log_time=at)
        for role, known in (("object", moment.objects), ("person", moment.people)):
            for name, flat in known.items():
                self._thing(f"{role}/{name}", flat, scene, moment.t_s)
        state = {"held": moment.held, "charge": moment.charge, "late": moment.late}
        news = {name: value for name, value in state.items() if value is not None}
        if news:
            self._state.log(news, log_time=at)

    def sensed(self, line: Sensed) -> None:
        """What was sensed: scans in the lidar's frame, torques and temperatures of motors."""
        from foxglove.messages import LaserScan, Pose

        at = self._ns(line.t_s)
        scene, scan = self._scene_known, line.scan
        if scan is not None and scene is not None:
            ranges_m = np.frombuffer(scan.ranges_mm, "<u2", len(scan.ranges_mm) // 2) / 1000.0
            ranges_m[ranges_m == 0.0] = np.inf
            pose: Pose = _pose(kinematics.pose_of(scene.lidar.X_BS))
            told = LaserScan(
                timestamp=self._stamp(line.t_s), frame_id=scene.bodies[scene.lidar.body].id,
                pose=pose, start_angle=scan.from_rad,
                end_angle=scan.from_rad + scan.step_rad * max(0, len(ranges_m) - 1),
                ranges=ranges_m.tolist(), intensities=[],
            )  # fmt: skip
            self._scans.log(told, log_time=at)
        news = {"torque": line.torque, "heat_c": line.heat}
        if any(news.values()):
            self._motors_told.log({"names": self._motors, **news}, log_time=at)

    def shot(self, shot: Shot) -> None:
        """A picture, as it was packed."""
        from foxglove.messages import CompressedImage

        scene = self._scene_known
        frame = scene.bodies[scene.camera.body].id if scene is not None else WORLD
        told = CompressedImage(
            timestamp=self._stamp(shot.t_s), frame_id=frame, data=shot.data, format=shot.type
        )
        self._shots[shot.kind].log(told, log_time=self._ns(shot.t_s))

    def _thing(self, name: str, flat: Any, scene: VisualScene | None, t_s: float) -> None:
        """Where something is seen: a topic each, so that whoever seeks finds the newest of each."""
        from foxglove import channels
        from foxglove.messages import SceneEntityDeletion, SceneUpdate

        channel = self._things.get(name)
        if channel is None and len(self._things) >= MOST_THINGS:
            self.left_out += 1
            return
        if channel is None:
            channel = self._things[name] = channels.SceneUpdateChannel(
                f"/things/{name}", context=self._context
            )
        body = self._bodies.get(name)
        if flat is None or body is None or scene is None:
            gone = SceneEntityDeletion(timestamp=self._stamp(t_s), id=name)
            channel.log(SceneUpdate(deletions=[gone]), log_time=self._ns(t_s))
            return
        entity = self._entity(WORLD, body, scene, kinematics.pose_of(flat), name, t_s)
        entities = [entity] if entity is not None else []
        channel.log(SceneUpdate(entities=entities), log_time=self._ns(t_s))

    # --- parts ---

    def _ns(self, t_s: float) -> int:
        return max(0, round((self._began_s + t_s) * 1e9))

    def _stamp(self, t_s: float) -> Any:
        from foxglove.messages import Timestamp

        sec, nsec = divmod(self._ns(t_s), 1_000_000_000)
        return Timestamp(sec=sec, nsec=nsec)

    def _transform(self, t_s: float, parent: str, child: str, X_PC: SE3) -> Any:
        from foxglove.messages import FrameTransform

        return FrameTransform(
            timestamp=self._stamp(t_s),
            parent_frame_id=parent,
            child_frame_id=child,
            translation=_vector(X_PC.p),
            rotation=_rotation(X_PC),
        )

    def _entity(  # noqa: PLR0917
        self, frame: str, body: VisualBody, scene: VisualScene, X_FB: SE3, name: str, t_s: float
    ) -> Any:
        from foxglove.messages import KeyValuePair, SceneEntity

        shapes: Any = {}
        for geom in body.geoms:
            X_FG = X_FB @ kinematics.pose_of(geom.X_BG)
            for kind, shape in _shapes(geom, scene, X_FG):
                shapes.setdefault(kind, []).append(shape)
        if not shapes:
            return None
        told = [KeyValuePair(key="name", value=body.name)] if body.name else []
        return SceneEntity(
            timestamp=self._stamp(t_s), frame_id=frame, id=name, frame_locked=True, metadata=told,
            **shapes,
        )  # fmt: skip


def _shapes(geom: Geom, scene: VisualScene, X_FG: SE3) -> Iterator[tuple[str, Any]]:
    from foxglove import messages as m

    pose, color = _pose(X_FG), _color(geom.rgba)
    a, b, c = geom.size_m
    match geom.kind:
        case "box":
            yield (
                "cubes",
                m.CubePrimitive(pose=pose, size=_vector((2 * a, 2 * b, 2 * c)), color=color),
            )
        case "sphere":
            yield "spheres", _ball(X_FG, (a, a, a), color)
        case "ellipsoid":
            yield "spheres", _ball(X_FG, (a, b, c), color)
        case "cylinder" | "capsule":
            yield (
                "cylinders",
                m.CylinderPrimitive(
                    pose=pose,
                    size=_vector((2 * a, 2 * a, 2 * b)),
                    bottom_scale=1.0,
                    top_scale=1.0,
                    color=color,
                ),
            )
            if geom.kind == "capsule":
                for end in (-b, b):
                    yield "spheres", _ball(X_FG @ SE3((0.0, 0.0, end)), (a, a, a), color)
        case "mesh" if 0 <= geom.mesh < len(scene.meshes):
            mesh = scene.meshes[geom.mesh]
            points = np.frombuffer(mesh.points_m, np.float32).reshape(-1, 3).tolist()
            faces = np.frombuffer(mesh.faces, np.uint32).tolist()
            corners = [m.Point3(x=x, y=y, z=z) for x, y, z in points]
            yield (
                "triangles",
                m.TriangleListPrimitive(pose=pose, points=corners, color=color, indices=faces),
            )
        case _:
            pass


def _ball(X_FG: SE3, radii_m: tuple[float, float, float], color: Any) -> Any:
    from foxglove.messages import SpherePrimitive

    a, b, c = radii_m
    return SpherePrimitive(pose=_pose(X_FG), size=_vector((2 * a, 2 * b, 2 * c)), color=color)


def _vector(p: tuple[float, float, float]) -> Any:
    from foxglove.messages import Vector3

    x, y, z = p
    return Vector3(x=x, y=y, z=z)


def _pose(X: SE3) -> Any:
    from foxglove.messages import Pose

    return Pose(position=_vector(X.p), orientation=_rotation(X))


def _rotation(X: SE3) -> Any:
    from foxglove.messages import Quaternion

    w, x, y, z = X.quat_wxyz
    return Quaternion(x=x, y=y, z=z, w=w)


def _color(rgba: Rgba) -> Any:
    from foxglove.messages import Color

    r, g, b, a = rgba
    return Color(r=r, g=g, b=b, a=a)
