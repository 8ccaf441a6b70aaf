# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The executable viewer: the live grasp as a page in the browser.

Three threads that never wait for each other: this loop draws the newest messages at a steady
rate, the thread of ``viewer_calls`` asks services, and viser serves the page.
"""

import os
from pathlib import Path
import signal
import sys
import time
from typing import Any

from grasp_quality_hand.urdf_tree import read_urdf, UrdfError
from grasp_quality_hand.viewer_calls import Caller
from grasp_quality_hand.viewer_controls import Controls
from grasp_quality_hand.viewer_hand import HandAndObject, known_object, object_mesh
from grasp_quality_hand.viewer_listener import Listener
from grasp_quality_hand.viewer_panel import Panel
from grasp_quality_hand.viewer_picture import (
    defaults_from, PARAMETERS, Picture, take_picture)
from grasp_quality_hand.viewer_scene import Scene
from msg_adapters.contacts import ContactDefaults
from msg_adapters.poses import pose_arrays
import numpy as np
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
import rclpy
from rclpy.signals import SignalHandlerOptions
import viser

RATE_HZ = 20.0
NICE = 5                 # the page gives way to the hand and to the node
ASK_PERIOD_S = 1.0       # between two looks at the parameters of node and hand
AMBIENT = 1.2
FIRST_VIEW = np.array([0.12, -0.27, 0.11])  # of the camera from the object [m]
BELOW = np.array([0.0, 0.0, -0.045])        # what it looks at, from the object [m]


class Viewer:
    """The page of one grasp_quality node."""

    def __init__(self, node: Any, calls: Any) -> None:
        self._node, self._logger = node, node.get_logger()
        self._settings = _declare(node)
        self._target = '/' + self._settings['target_node'].strip('/')
        self._hand_node = '/' + self._settings['hand_node'].strip('/')
        self._parameters: dict[str, Any] = {}
        self._defaults = ContactDefaults()
        self._object: str = self._settings['object']
        self._drawn_object: str | None = None
        self._urdf: str | None = None
        self._asked = 0.0
        mesh = object_mesh(self._object)
        self.server = viser.ViserServer(
            host=self._settings['host'], port=self._settings['port'], label='grasp_quality',
            verbose=False)
        self.server.gui.configure_theme(control_layout='fixed', control_width='large',
                                        show_logo=False, show_share_button=False)
        self.server.initial_camera.near = 1e-3
        self.server.scene.set_up_direction('+z')
        self.server.scene.configure_default_lights(cast_shadow=False)
        self.server.scene.configure_environment_map(None)  # its light would wash the colours out
        self.server.scene.add_light_ambient('/ambient', intensity=AMBIENT)
        self._look_at(np.zeros(3))
        self._caller = Caller(calls)
        self._listener = Listener(node, self._target, self._hand_node)
        self._panel = Panel(self.server, self._target)
        self._controls = Controls(
            self.server, self._caller, self._target, self._settings['controls'])
        self._scene = Scene(self.server)
        self._body = HandAndObject(self.server)
        if mesh is not None:
            self._body.set_object(mesh)
            self._drawn_object = self._object
        if self._settings['urdf']:
            path = Path(self._settings['urdf'])
            self._body.set_hand(read_urdf(path.read_text(), path.parent))

    def close(self) -> None:
        """Close the page and end the threads."""
        self._caller.close()
        self.server.stop()

    def draw(self) -> Picture:
        """Show what is new."""
        now = time.monotonic()
        if now - self._asked >= ASK_PERIOD_S:
            self._asked = now
            self._ask()
        heard = self._listener.poll(self._parameters.get('contact_source', 'pose_array'))
        picture = take_picture(heard, self._defaults, now)
        if picture.grasp is not None:
            self._listener.listen_to(picture.grasp.names)
        self._controls.follow(picture.quality, self._defaults.friction)
        self._scene.show_map(self._controls.map_shown.value)
        with self.server.atomic():
            self._draw_body(heard)
            self._scene.draw(picture)
            self._panel.show(picture, now)
        return picture

    def _draw_body(self, heard: Any) -> None:
        description = self._listener.robot_description
        if description is not None and description != self._urdf and not self._settings['urdf']:
            self._urdf = description
            self._body.set_hand(read_urdf(description, Path('/')))
        if self._object != self._drawn_object:
            self._drawn_object = self._object
            self._body.set_object(object_mesh(self._object))
        pose = None
        if heard.object_pose is not None:
            if np.array_equal(self._body.frame.position, np.zeros(3)):
                p = heard.object_pose.pose.position
                self._look_at(np.array([p.x, p.y, p.z]))
            pose = np.eye(4)
            pose[:3, 3], pose[:3, :3] = pose_arrays(heard.object_pose.pose, 'object_pose')
        joints = None if heard.joints is None else dict(
            zip(heard.joints.name, heard.joints.position))
        self._body.place(pose, joints)

    def _look_at(self, point: Any) -> None:
        self.server.initial_camera.look_at = tuple(point + BELOW)
        self.server.initial_camera.position = tuple(point + FIRST_VIEW)

    def _ask(self) -> None:
        self._caller.get_parameters(self._target, PARAMETERS, self._on_parameters)
        if not self._settings['object']:
            self._caller.get_parameters(self._hand_node, ['object'], self._on_object)

    def _on_parameters(self, parameters: dict[str, Any] | None) -> None:
        if parameters is not None:
            self._defaults = defaults_from(parameters)
            self._parameters = parameters

    def _on_object(self, parameters: dict[str, Any] | None) -> None:
        if parameters is not None:
            self._object = known_object(parameters['object'])


def _declare(node: Any) -> dict[str, Any]:
    """Declare the parameters and return their values."""
    table = {
        'host': ('127.0.0.1', 'address to serve the page on; 0.0.0.0 lets other machines in'),
        'port': (8080, 'port of the page; the next free one when it is taken'),
        'controls': (False, 'whether the page may set task, load and friction of the node; any '
                     'web page open in a browser on this machine can then set them too'),
        'target_node': ('grasp_quality', 'the grasp_quality node to show'),
        'hand_node': ('simulated_hand', 'node whose object_pose and up_in_object_frame are shown'),
        'urdf': ('', 'URDF file of the hand; empty: what comes on /robot_description'),
        'object': ('', "'' (ask the hand node), none, box:<x>,<y>,<z> [m], sphere:<radius> [m] or "
                   'a mesh file in the object frame')}
    values = {}
    for name, (default, description) in table.items():
        descriptor = ParameterDescriptor(description=description, read_only=True)
        if name == 'port':
            descriptor.integer_range = [IntegerRange(from_value=1, to_value=65535)]
        values[name] = node.declare_parameter(name, default, descriptor).value
    return values


def main(args: list[str] | None = None) -> int:
    """Serve the page until SIGINT or SIGTERM; return the exit code."""
    stopping: list[int] = []
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    os.nice(NICE)
    node, calls = rclpy.create_node('viewer'), rclpy.create_node(
        'viewer_calls', use_global_arguments=False)
    try:
        viewer = Viewer(node, calls)
    except (UrdfError, ValueError, OSError, rclpy.exceptions.ParameterException) as exc:
        print(f'viewer: {exc}', file=sys.stderr)
        rclpy.shutdown()
        return 1
    server = viewer.server
    print(f'viewer: open http://{server.get_host()}:{server.get_port()} in a browser', flush=True)
    try:
        while not stopping:
            _draw_once(viewer, node.get_logger())
    finally:
        viewer.close()
        calls.destroy_node()
        node.destroy_node()
        rclpy.shutdown()
    return 0


def _draw_once(viewer: Viewer, logger: Any) -> None:
    """Draw, and sleep for the rest of the period."""
    begun = time.monotonic()
    try:
        viewer.draw()
    except Exception as exc:  # the next messages may be good again
        logger.error(f'{type(exc).__name__}: {exc}', throttle_duration_sec=1.0)
    time.sleep(max(0.0, begun + 1.0 / RATE_HZ - time.monotonic()))


if __name__ == '__main__':
    sys.exit(main())
