# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The demo's pulls: predicted alpha beside the load that the hand then holds."""

from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
import time
from typing import Any

from grasp_quality_hand.demo_follower import Follower
from grasp_quality_hand.demo_processes import (
    ChildProcess, DemoFailure, DemoTimeout, executable)
from grasp_quality_hand.demo_questions import force
from grasp_quality_hand.fetch_dclaw import dclaw_directory, URDF
from grasp_quality_hand.grasp_objects import GraspObject
from grasp_quality_hand.measured_grasp import grasp_anew, MeasuredGrasp, newest_sample
from grasp_quality_hand.slip import slip_distance
from grasp_quality_msgs.msg import ContactForceArray
from grasp_quality_msgs.srv import EvaluateTaskWrench, PullObject
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
TOPIC = '/grasp_quality_demo/contact_forces'
WAYS = {'down': (0.0, 0.0, -1.0), 'along +x': (1.0, 0.0, 0.0), 'along -y': (0.0, -1.0, 0.0)}
GROWTH, LIMIT = 0.10, 1.5    # of the load: shares of alpha a second, and shares of alpha
FIRST_COMMAND = 20.0         # deadlines: for the bridge to start, for other forces to take over,
TAKING_OVER = 20.0           # and for a pull, which takes simulated time [s]
PULLING = 90.0
KEPT = 5                     # of so many samples one is kept for the animation
FEW_COMMANDS = 20            # fewer may be left over from the bridge before
PATIENCE = 0.4               # of the bridge with a busy machine: age of what it follows [s]
TOO_RARE = 0.05              # between commands: the follower's feedback is a radian late then [s]
FINGER_LINKS = ('link_f1_3', 'link_f2_3', 'link_f3_3')


@dataclass
class PullRecord:
    """
    One pull: what was predicted, what was held, and how it went.

    Attributes
    ----------
    way : str
    alpha : float
        Predicted by the node [N].
    held : float, or None
        Measured [N]; None when it was not pulled, as the machine was too busy to hold the object.
    silence : float
        Longest time between two commands to the joints while it pulled, or was to hold still [s].
    frames : list of Frame

    """

    way: str
    direction: Array
    alpha: float
    held: float | None = None
    silence: float = 0.0
    frames: list['Frame'] = field(default_factory=list)


@dataclass(frozen=True)
class Frame:
    """The hand and the object at one moment of a pull."""

    load: float              # [N]
    moved: float             # of the object since the pull began, |dp| + 20 mm |dtheta| [m]
    joints: Any
    object_pose: Any
    measured: MeasuredGrasp


def show_pulls(client: Any, children: list[ChildProcess], grasp_object: GraspObject, cap: float,
               hand: str, output: Path) -> list[PullRecord]:
    """
    Hold the object with optimised forces, pull on it until it slips, and print the loads.

    Parameters
    ----------
    client : DemoClient
        Hears and asks.
    children : list of ChildProcess
        Gets the bridge to joint efforts while it runs.
    grasp_object : GraspObject
        What is held.
    cap : float
        Largest normal force of a finger [N].
    hand : str
        Name of the simulated hand's node.
    output : Path
        Folder of logs.

    """
    publisher = client.create_publisher(ContactForceArray, TOPIC)
    records = []
    for way in WAYS:
        grasp_anew(client)
        follower = Follower(client, publisher)
        bridge = ChildProcess('force_to_effort', _bridge_command(client, hand),
                              output / 'force_to_effort.log')
        children.append(bridge)
        try:
            records.append(_pull(client, follower, grasp_object, cap, hand, way))
        finally:
            follower.stop()
            bridge.end()
            children.remove(bridge)
    print('\n'.join(_table(grasp_object.name, records)), flush=True)
    return records


def _bridge_command(client: Any, hand: str) -> list[Any]:
    """Return the command of force_to_effort for D'Claw."""
    def listed(names: Any) -> str:
        return f'[{", ".join(names)}]'

    parameters = {
        'robot_description_file': dclaw_directory() / URDF,
        'joints': listed(client.heard.joints.name), 'contact_names': listed(client.fingers),
        'contact_links': listed(FINGER_LINKS), 'max_force_age': PATIENCE,
        'max_joint_age': PATIENCE, 'max_pose_age': PATIENCE}
    command = [executable('grasp_quality_hand', 'force_to_effort'), '--ros-args', '-r',
               f'grasp_quality/contact_forces:={TOPIC}', '-r', f'object_pose:={hand}/object_pose']
    for name, value in parameters.items():
        command += ['-p', f'{name}:={value}']
    return command


def _pull(client: Any, follower: Follower, grasp_object: GraspObject, cap: float, hand: str,
          way: str) -> PullRecord:
    """Pull one way until the object slips."""
    measured = newest_sample(client)
    direction = np.array(WAYS[way])
    answer, _ = client.ask(EvaluateTaskWrench, 'evaluate_task_wrench', EvaluateTaskWrench.Request(
        task_wrench=force(-direction), external_wrench=force(-measured.weight)))
    record = PullRecord(way, direction, answer.alpha)
    follower.take(measured, grasp_object, cap, np.append(-direction, np.zeros(3)))
    client.listen_until(lambda: client.heard.commands > FEW_COMMANDS, FIRST_COMMAND,
                        'force_to_effort did not command efforts')
    client.heard.silence = 0.0
    follower.blend()
    try:
        client.listen_until(lambda: follower.blended and follower.still, TAKING_OVER,
                            'the optimised forces did not take over and hold the object still')
    except DemoTimeout:
        record.silence = max(client.heard.silence, time.monotonic() - client.heard.commanded)
        if record.silence > TOO_RARE:
            return record
        raise

    samples = count()

    def keep(message: Any) -> None:
        if next(samples) % KEPT:
            return
        sample, heard = newest_sample(client), client.heard
        if sample is not None:
            record.frames.append(Frame(
                float(heard.load[:3] @ direction), slip_distance(follower.displacement),
                heard.joints, heard.object_pose, sample))

    client.on_contacts.append(keep)
    client.heard.silence = 0.0
    response = client.call_while_listening(PullObject, f'{hand}/pull', PullObject.Request(
        wrench=force(direction), growth=GROWTH * record.alpha, limit=LIMIT * record.alpha),
        PULLING)
    client.on_contacts.remove(keep)
    if not response.success:
        raise DemoFailure(f'the hand did not pull: {response.message}')
    record.held, record.silence = response.held, client.heard.silence
    return record


def _table(name: str, records: list[PullRecord]) -> list[str]:
    """Return what was predicted and what was held, as lines."""
    lines = ['', f'Pulls on the {name}, held with optimised forces, until it slips by 0.5 mm;',
             'a pull along -y is met by forces along +y, one down by a lift beside the weight',
             '  pull          predicted alpha    held load    held / predicted']
    for record in records:
        lines.append(f'  {record.way:<12} {record.alpha:14.3f} N ' + (
            'not pulled: it was not held still' if record.held is None else
            f'{record.held:10.3f} N {record.held / record.alpha:19.3f}'))
        if record.silence > TOO_RARE:
            lines.append('    the machine was busy: commands came up to '
                         f'{1e3 * record.silence:.0f} ms apart, which tells nothing of the grasp')
    return lines
