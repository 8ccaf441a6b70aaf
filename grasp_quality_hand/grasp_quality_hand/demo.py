# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulated hand and node in processes of their own, asked as a client asks.

For a cube and for a ball: the hand closes, the node is asked through its services, the answers are
printed and two pictures are saved.

"""

import argparse
import os
from pathlib import Path
import signal
import sys
import time

from grasp_quality import Contact, ContactModel, Grasp, slip_margin
from grasp_quality_hand.demo_client import DemoClient
from grasp_quality_hand.demo_processes import ChildProcess, claim_domain, DemoFailure, executable
from grasp_quality_hand.demo_pull import show_pulls
from grasp_quality_hand.demo_questions import ask_all
from grasp_quality_hand.demo_recording import recording
from grasp_quality_hand.demo_report import report
from grasp_quality_hand.demo_viewer import show_page
from grasp_quality_hand.grasp_objects import FRICTION, OBJECTS, TORSIONAL_FRICTION
from grasp_quality_hand.grasp_picture import draw_grasp
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_hand.map_picture import draw_map
from grasp_quality_hand.measured_grasp import grasp_anew
from grasp_quality_hand.pull_animation import draw_pull
import numpy as np
import rclpy
from rclpy.signals import SignalHandlerOptions

TARGET, HAND = '/grasp_quality', '/simulated_hand'
CAP = 10.0                   # largest normal force of a finger [N]
MIN_CONTACT_FORCE = 0.05     # [N]
JOINT_DAMPING = 0.2          # of the hand's motors, small: it brakes what slips [N m s/rad]
SHOWN = ('cube', 'ball')


def main(args=None):
    """Run the demo; return the exit code."""
    options = _options(args)
    output = Path(options.output)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    claim = None
    try:
        output.mkdir(parents=True, exist_ok=True)
        claim = claim_domain()
        os.environ.setdefault('ROS_LOG_DIR', str((output / 'log').resolve()))
        _run(options, output, [])
        code = 0
    except KeyboardInterrupt:
        print('demo: stopped', flush=True)
        code = 0 if options.keep else 130
    except (DemoFailure, OSError) as error:
        print(f'demo failed: {error}', file=sys.stderr)
        code = 1
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        for child in reversed(ChildProcess.started):
            child.end()
        if claim is not None:
            claim.close()
    return code


def _options(args):
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.strip().splitlines()[0])
    parser.add_argument('--output', default='build/demo', help='folder for pictures and logs '
                        '(default %(default)s)')
    parser.add_argument('--objects', nargs='+', choices=OBJECTS, default=list(SHOWN),
                        help=f'what the hand is to hold (default: {", ".join(SHOWN)})')
    parser.add_argument('--keep', action='store_true',
                        help='keep hand and node running until Ctrl-C')
    return parser.parse_args(args)


def _run(options, output, children):
    """Start everything, show every object, and wait when asked to."""
    children.append(ChildProcess('the simulated hand', _hand_command(), output / 'hand.log'))
    children.append(ChildProcess('the grasp_quality node', _node_command(), output / 'node.log'))
    print('starting the simulated hand and the grasp_quality node', flush=True)
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    client = DemoClient(FINGERS, TARGET, HAND, children)
    try:
        with recording(output, _node_parameters()):
            for name in options.objects:
                _show(client, children, OBJECTS[name], output)
        if options.keep:
            show_page(client, children, output)
            _wait(children)
    finally:
        client.close()
        rclpy.shutdown()


def _hand_command():
    """Return the command of the simulated hand."""
    return [executable('grasp_quality_hand', 'simulated_hand'), '--ros-args', '-p',
            f'joint_damping:={JOINT_DAMPING}']


def _node_parameters():
    """Return what is known about this hand."""
    fingers = f'[{", ".join(FINGERS)}]'
    return {
        'contact_names': fingers, 'contact_fingers': fingers, 'contact_model': 'SFCE',
        'friction_coefficient': FRICTION, 'torsional_friction_coefficient': TORSIONAL_FRICTION,
        'max_normal_force': CAP, 'min_contact_force': MIN_CONTACT_FORCE}


def _node_command():
    """Return the command of the node, with the parameters of this hand."""
    command = [executable('grasp_quality', 'grasp_quality_node'), '--ros-args']
    for name, value in _node_parameters().items():
        command += ['-p', f'{name}:={value}']
    return command


def _show(client, children, grasp_object, output):
    """Let the hand hold one object, ask about the grasp, pull on it, print and draw it all."""
    name = grasp_object.name
    client.choose_object(name)
    grasp = grasp_anew(client)
    answers = ask_all(client, grasp.weight)
    print(report(name, grasp, _slip_margins(grasp), CAP, answers), flush=True)
    pictures = output / f'{name}_grasp.png', output / f'{name}_force_map.png'
    draw_grasp(pictures[0], grasp_object, grasp, answers.lift.response, client.heard.joints,
               client.heard.object_pose)
    force_map = answers.force_map.response
    directions = np.array([[w.force.x, w.force.y, w.force.z] for w in force_map.directions])
    draw_map(pictures[1], name, directions, np.array(force_map.alphas), grasp)
    print(f'\nForce map: {len(directions)} directions, solved in '
          f'{1e3 * answers.force_map.solve_time:.0f} ms\nPictures: {pictures[0]}, {pictures[1]}',
          flush=True)
    records = show_pulls(client, children, grasp_object, CAP, HAND, output)
    animation = output / f'{name}_pull.gif'
    drawn = next((record for record in records if record.frames), None)
    if drawn is not None:
        draw_pull(animation, grasp_object, drawn)
        print(f'Animation of the pull {drawn.way}: {animation}', flush=True)
    else:
        print('No animation: no sample of a pull was heard', flush=True)


def _slip_margins(grasp):
    """Return the slip margin of every measured contact force, shape (k,)."""
    contacts = [Contact(position=position, rotation=R, model=ContactModel.SFCE,
                        friction=FRICTION, torsional_friction=TORSIONAL_FRICTION,
                        max_normal_force=CAP, name=finger, finger=finger)
                for finger, position, R in zip(grasp.fingers, grasp.positions, grasp.rotations)]
    return slip_margin(Grasp(contacts), grasp.forces)


def _wait(children):
    """Keep everything running until Ctrl-C."""
    domain = os.environ['ROS_DOMAIN_ID']
    print('\nhand and node keep running; end with Ctrl-C. To look at them from another shell:\n'
          f'  export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST',
          flush=True)
    while True:
        for child in children:
            child.check()
        time.sleep(0.5)


if __name__ == '__main__':
    sys.exit(main())
