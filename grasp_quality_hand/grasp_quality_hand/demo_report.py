# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo prints about one grasp."""

from grasp_quality_hand.demo_questions import AXES, SIDEWAYS, TILT
import numpy as np

WIDTH = 96


def report(name, grasp, slip_margins, cap, answers):
    """
    Return the tables of one grasp as text.

    Parameters
    ----------
    name : str
        Of the object.
    grasp : MeasuredGrasp
        What was measured.
    slip_margins : ndarray, shape (k,)
        Of the measured forces.
    cap : float
        Largest normal force of a finger that the node reckons with [N].
    answers : Answers
        Of the node.

    """
    weight = np.linalg.norm(grasp.weight)
    title = f' {name}: weight {weight:.3f} N, in {len(grasp.fingers)} fingers '
    return '\n'.join([
        '', title.center(WIDTH, '='),
        *_contacts(grasp, slip_margins), '',
        *_abilities(weight, answers), '',
        *_cone(answers.cone), '',
        *_polytope(answers.polytope), '',
        *_lift_forces(grasp, cap, answers.lift.response)])


def friction_margin(forces):
    """Return 1 - the largest cone usage of a ContactForceArray; 1 is safest, 0 about to slip."""
    return 1.0 - max(force.cone_usage for force in forces.forces)


def _contacts(grasp, slip_margins):
    """Yield the measured contacts."""
    yield 'Measured contacts, object frame (x, y, z)'
    yield ('  finger       position [mm]            inward normal          normal force [N]'
           '   slip margin')
    for finger, position, R, force, margin in zip(
            grasp.fingers, grasp.positions, grasp.rotations, grasp.forces, slip_margins):
        yield (f'  {finger:<10} {_vector(1e3 * position, 7, 1)}    {_vector(R[:, 2], 7, 3)}'
               f'  {force[2]:12.2f}      {margin:11.2f}')
    total = grasp.forces_in_object_frame.sum(axis=0)
    yield f'  sum          {_vector(total, 7, 3)} N'
    yield (f'  weight       {_vector(-grasp.weight, 7, 3)} N, balanced by the sum to '
           f'{100 * grasp.imbalance:.2g} %')


def _abilities(weight, answers):
    """Yield the single wrenches."""
    yield 'Task wrench: the largest alpha that the fingers can apply'
    yield ('  task                                       alpha    proved below    solve [ms]'
           '    round trip [ms]')
    lift = f'lift with the weight ({weight:.3f} N upwards)'
    yield _ability(lift, answers.lift, ' ')
    for axis, answer in zip(AXES, answers.axes):
        yield _ability(f'force along {axis}', answer, 'N')


def _ability(task, answer, unit):
    """Return one line of the single wrenches."""
    alpha, upper = answer.response.alpha, answer.response.alpha_upper
    return (f'  {task:<38} {alpha:9.4f} {unit} {upper:13.4f} {unit}'
            f' {1e3 * answer.solve_time:11.2f}    {1e3 * answer.round_trip:11.2f}')


def _cone(answer):
    """Yield the task cone."""
    response = answer.response
    yield (f'Task cone: lift, and up to {np.rad2deg(TILT):.0f} degrees aside of it '
           '(alpha in object weights)')
    yield (f'  best wrench in it {response.alpha:.4f}; along its axis {response.alpha_axis:.4f}; '
           f'worst on its surface {response.alpha_worst:.4f}')
    yield _times(answer)


def _polytope(answer):
    """Yield the task polytope."""
    response = answer.response
    alphas = ', '.join(f'{alpha:.4f}' for alpha in response.alphas)
    yield f'Task polytope: the weight, and {SIDEWAYS:g} of it to each of four sides'
    yield (f'  alphas {alphas}; quality {response.quality:.4f}; smallest {response.alpha_min:.4f}')
    yield ('  sums of these wrenches, each up to its alpha, are all held after scaling by '
           f'{response.parallelotope_scale:.4f}')
    yield _times(answer)


def _times(answer):
    """Return the times of an answer as text."""
    return (f'  solved in {1e3 * answer.solve_time:.1f} ms, '
            f'round trip {1e3 * answer.round_trip:.1f} ms')


def _lift_forces(grasp, cap, response):
    """Yield the contact forces that lift with the largest alpha."""
    yield f'Contact forces that lift with alpha {response.alpha:.4f}, object frame (x, y, z)'
    yield ('  finger       force [N]                normal part [N]    of its cap      '
           'share of the cone used')
    for contact in response.forces.forces:
        force = np.array([getattr(contact.wrench.force, axis) for axis in 'xyz'])
        normal = force @ [getattr(contact.normal, axis) for axis in 'xyz']
        yield (f'  {contact.name:<10} {_vector(force, 7, 2)} {normal:18.2f} '
               f'{100 * normal / cap:11.0f} % {contact.cone_usage:20.2f}')
    yield (f'  friction margin {friction_margin(response.forces):.2f}, as the largest alpha takes '
           "it all (the node's barrier_weight buys margin)")
    yield f'  limited most by {response.limiting_contact or "no single contact"}'


def _vector(values, width, digits):
    """Return numbers in columns; no minus before a rounded zero."""
    return ' '.join(f'{value:{width}.{digits}f}' for value in np.round(values, digits) + 0.0)
