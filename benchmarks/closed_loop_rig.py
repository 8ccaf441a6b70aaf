# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The processes of the closed loop, and a node that watches it from outside."""

from collections.abc import Callable
from pathlib import Path
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, PoseStamped
from grasp_quality_hand.demo_processes import ChildProcess, executable
from grasp_quality_hand.fetch_dclaw import dclaw_directory, URDF
from grasp_quality_hand.grasp_objects import FRICTION, OBJECTS, TORSIONAL_FRICTION
import numpy as np
from numpy.typing import NDArray
import pinocchio
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import Trigger

DEADLINE_S = 60.0
RATE_HZ = 200
CAP = 8.0                   # of every fingertip [N]
FINGERS = (1, 2, 3)
OBEYED = 0.05               # difference of an effort from the newest command, at most [N m]
SETTLE_S = 2.0
HOLDING = {'holding_stiffness': 10.0, 'holding_damping': 0.1}  # N m/rad, N m s/rad


class Rig:
    """Starts and ends the loop; hears poses, commands and diagnostics with their arrival times."""

    def __init__(self, folder: Path, object_name: str, **disturbances: float) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder, self._object = folder, object_name
        self._children: dict[str, ChildProcess] = {}
        self.node: Any = rclpy.create_node('closed_loop')
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        self.poses: list[tuple[float, Any]] = []
        self.commands: list[tuple[float, NDArray[np.float64]]] = []
        self.phases: list[tuple[float, str]] = []
        self.contacts = 0
        self._differences: list[float] = []  # of the motors' efforts from the newest command
        self._listen(PoseStamped, '/simulated_hand/object_pose', lambda m: self.poses.append(
            (time.monotonic(), _pose(m))))
        self._listen(Float64MultiArray, '/effort_controller/commands', lambda m: (
            self.commands.append((time.monotonic(), np.array(m.data)))))
        self._listen(JointState, '/joint_states', self._compare)
        self._listen(PoseArray, '/grasp_quality/contact_poses', self._count)
        self._listen(DiagnosticArray, '/diagnostics', self._on_diagnostics, 10)
        self._start('simulated_hand', 'grasp_quality_hand', [], rate=float(RATE_HZ),
                    object=object_name, **disturbances)
        self.start_quality()
        names = [f'finger_{i}' for i in FINGERS]
        self._start(
            'force_to_effort', 'grasp_quality_hand',
            ['object_pose:=/simulated_hand/object_pose',
             'grasp_quality/contact_forces:=grasp_quality/holding_forces'],
            robot_description_file=dclaw_directory() / URDF, rate=float(RATE_HZ),
            joints=_list(f'joint_f{i}_{j}' for i in FINGERS for j in range(3)),
            contact_names=_list(names), contact_links=_list(f'link_f{i}_3' for i in FINGERS),
            **HOLDING)
        self._start('holding_load', 'grasp_quality_hand',
                    ['object_pose:=/simulated_hand/object_pose'], mass=OBJECTS[object_name].mass)

    def start_quality(self) -> None:
        """Start the quality node; its live task is the weight, upward."""
        self._start(
            'grasp_quality_node', 'grasp_quality', [],
            contact_names=_list(f'finger_{i}' for i in FINGERS), contact_model='SFCE',
            friction_coefficient=FRICTION, torsional_friction_coefficient=TORSIONAL_FRICTION,
            max_normal_force=CAP, task_wrench='[0.0,0.0,1.0,0.0,0.0,0.0]')

    def _start(self, name: str, package: str, remaps: list[str], **parameters: Any) -> None:
        command: list[Any] = [executable(package, name), '--ros-args']
        for remap in remaps:
            command += ['-r', remap]
        for key, value in parameters.items():
            command += ['-p', f'{key}:={value}']
        self._children[name] = ChildProcess(name, command, self._folder / f'{name}.txt')

    def _listen(self, kind: Any, topic: str, callback: Callable[[Any], Any],
                qos: Any = qos_profile_sensor_data) -> None:
        self.node.create_subscription(kind, topic, callback, qos)

    def _compare(self, message: JointState) -> None:
        if self.commands:
            difference = np.array(message.effort) - self.commands[-1][1]
            self._differences = [*self._differences[-49:], float(np.abs(difference).max())]

    def _obeys(self) -> bool:
        """Whether the driver's efforts are ours: before, the object is held for the fingers."""
        return len(self._differences) == 50 and max(self._differences) < OBEYED

    def _count(self, message: PoseArray) -> None:
        self.contacts += 1

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if 'joint efforts' in status.name:
                phase = next(item.value for item in status.values if item.key == 'phase')
                self.phases.append((time.monotonic(), phase))

    def kill_quality(self) -> float:
        """Kill the quality node as a crash does; return when [s]."""
        self._children.pop('grasp_quality_node').kill()
        return time.monotonic()

    def spin(self, seconds: float) -> None:
        """Listen for a while."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._executor.spin_once(timeout_sec=0.01)
            for child in self._children.values():
                child.check()

    def until(self, condition: Callable[[], Any], what: str) -> None:
        """Listen until a condition holds."""
        end = time.monotonic() + DEADLINE_S
        while not condition():
            if time.monotonic() > end:
                raise TimeoutError(f'waited {DEADLINE_S:g} s for {what}; see {self._folder}')
            self.spin(0.02)

    def call(self, kind: Any, name: str, request: Any) -> None:
        """Call a service and wait for its answer."""
        client = self.node.create_client(kind, name)
        self.until(client.service_is_ready, name)
        future = client.call_async(request)
        self.until(future.done, f'an answer of {name}')

    def grasp(self) -> None:
        """Close the hand, and wait until the fingers alone hold the object, by our commands."""
        self.call(Trigger, '/simulated_hand/close', Trigger.Request())
        self.until(lambda: self.commands and self.phases and self.phases[-1][1] == 'FOLLOWING',
                   'efforts that follow')
        self.until(self._obeys, 'the hand to obey')
        self.spin(SETTLE_S)
        self.call(Trigger, '/holding_load/hold_here', Trigger.Request())
        self.spin(SETTLE_S)

    def close(self) -> None:
        """End all processes and leave."""
        for child in self._children.values():
            child.end()
        self._executor.shutdown()
        self.node.destroy_node()


def drift(poses: list[tuple[float, Any]]) -> tuple[float, float]:
    """Largest way [m] and turn [rad] from the first of some poses."""
    (R0, p0), rest = poses[0][1], [pose for _, pose in poses]
    return (max(float(np.linalg.norm(p - p0)) for _, p in rest),
            max(float(np.linalg.norm(pinocchio.log3(R0.T @ R))) for R, _ in rest))


def _pose(message: PoseStamped) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    p, q = message.pose.position, message.pose.orientation
    return pinocchio.Quaternion(q.w, q.x, q.y, q.z).matrix(), np.array([p.x, p.y, p.z])


def _list(words: Any) -> str:
    return f'[{",".join(words)}]'
