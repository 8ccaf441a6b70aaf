# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The contact-point hand: light spheres that press on the object with commanded forces.

It has no mechanism between motor and contact, so that what it measures is friction and nothing
else. Free spheres slide along three axes (and turn about the normal, where the contact carries a
moment) and are commanded a whole contact force. Guided spheres slide along the normal alone: the
normal force is commanded, and friction gives whatever is needed sideways, or slips.

"""

from typing import Any

from grasp_quality import Grasp
from grasp_quality_hand.grasp_objects import GraspObject
from grasp_quality_hand.hand_physics import (
    add_object, HandModel, index_of, set_contact, set_options)
import mujoco
import numpy as np

SPHERE_RADIUS = 0.003        # [m]
SPHERE_MASS = 0.0005         # small beside the object's, which has to show that it slips [kg]
TIMESTEP = 0.0005            # [s]
# noslip iterations, their tolerance, impratio
FAST = (50, 1e-6, 1e3)       # in real time
FREE = (200, 1e-10, 1e3)     # to measure with; stiffer friction shakes light free spheres
GUIDED = (300, 1e-10, 3e4)   # to measure with; softer friction creeps below its limit
LARGEST_FORCE = 100.0        # of a motor [N]
AXES = 'xyz'


def build_point_hand(grasp_object: GraspObject, grasp: Grasp, guided: bool = False,
                     real_time: bool = False) -> HandModel:
    """
    Build the spheres of a grasp around an object.

    Parameters
    ----------
    grasp_object : GraspObject
        Its friction must not be larger than the grasp's: MuJoCo takes the larger of the two.
    grasp : Grasp
        Where the contacts are and with which friction, in the object frame.
    guided : bool
        Whether the spheres slide along their normals alone.
    real_time : bool
        Whether a hand for a person to try, with gravity, is wanted, or one to measure with.
        The spheres have no weight.

    Returns
    -------
    HandModel
        Contact i is finger i; its joints stand together in the order x, y, z, turn.

    """
    spec = mujoco.MjSpec()
    set_options(spec, TIMESTEP, *(FAST if real_time else GUIDED if guided else FREE))
    if not real_time:
        spec.option.gravity = [0.0, 0.0, 0.0]
    add_object(spec, grasp_object)
    names = [name for index in range(len(grasp))
             for name in _add_sphere(spec, grasp_object, grasp, index, guided)]
    for name in names:
        spec.add_actuator(name=name, target=name,
                          trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    model = spec.compile()
    bodies = np.array([model.body(f'point_{index}').id for index in range(len(grasp))])
    geoms = np.array([model.geom(f'point_{index}').id for index in range(len(grasp))])
    finger_of_geom = np.full(model.ngeom, -1)
    finger_of_geom[geoms] = np.arange(len(grasp))
    limits = np.tile([-LARGEST_FORCE, LARGEST_FORCE], (len(names), 1))
    return index_of(model, tuple(names), limits, finger_of_geom, bodies, geoms)


def _add_sphere(spec: Any, grasp_object: GraspObject, grasp: Grasp, index: int,
                guided: bool) -> 'list[str]':
    """Add the sphere of one contact; return the names of its joints."""
    name = f'point_{index}'
    normal = grasp.rotations[index][:, 2]
    friction, torsional = grasp.scales[index, 0], grasp.scales[index, 3]
    centre = grasp.positions[index] - SPHERE_RADIUS * normal + [0.0, 0.0, grasp_object.height]
    body = spec.worldbody.add_body(name=name, pos=centre, gravcomp=1.0)
    geom = body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_SPHERE, mass=SPHERE_MASS,
                         contype=1, conaffinity=0)
    geom.size[0] = SPHERE_RADIUS
    set_contact(geom, friction, torsional)
    joints = {f'{name}_n': normal} if guided else {
        f'{name}_{axis}': direction for axis, direction in zip(AXES, np.eye(3))}
    for joint, direction in joints.items():
        body.add_joint(name=joint, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=direction)
    if torsional > 0.0 and not guided:
        joints[f'{name}_turn'] = normal
        body.add_joint(name=f'{name}_turn', type=mujoco.mjtJoint.mjJNT_HINGE, axis=normal)
    return list(joints)
