# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo model of the D'Claw hand, palm up, with an object above it."""

from pathlib import Path
import xml.etree.ElementTree as ElementTree

from grasp_quality_hand.fetch_dclaw import dclaw_directory, DClawUnavailable, is_complete, URDF
from grasp_quality_hand.hand_physics import add_object, index_of, set_contact, set_options
import mujoco
import numpy as np

FINGERS = ('finger_1', 'finger_2', 'finger_3')
TIP_CENTRE = np.array([0.073, 0.0, 0.0])    # ball at the end, in the last link's frame [m]
TIP_RADIUS = 0.010                          # [m]
TIMESTEP = 0.001                            # [s]
ARMATURE = 0.003                            # inertia of the geared motors at the joints [kg m^2]
DAMPING = 0.4                               # of the geared motors [N m s/rad]


def build_hand_model(grasp_object, dclaw=None):
    """
    Build hand and object.

    D'Claw's base frame has its fingers along +z, so the palm looks up as it stands.  Only hand
    and object collide; the fingers pass through each other.

    Parameters
    ----------
    grasp_object : GraspObject
        What the hand will hold.
    dclaw : path, optional
        Folder with D'Claw's files; dclaw_directory() when not given.

    Returns
    -------
    HandModel

    """
    spec = mujoco.MjSpec.from_string(_urdf(Path(dclaw or dclaw_directory())))
    set_options(spec, TIMESTEP)
    for geom in spec.geoms:
        geom.contype, geom.conaffinity = 1, 0
        set_contact(geom, grasp_object.friction, grasp_object.torsional_friction)
    for joint in spec.joints:
        joint.armature, joint.damping[0] = ARMATURE, DAMPING
        motor = spec.add_actuator(name=joint.name, target=joint.name,
                                  trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_motor()
    add_object(spec, grasp_object)
    return _index(spec.compile())


def _urdf(folder):
    """Return the text of D'Claw's URDF as MuJoCo reads it: collision shapes, absolute paths."""
    if not is_complete(folder):
        raise DClawUnavailable(f"no complete D'Claw in {folder}: run fetch_dclaw, or set "
                               'GRASP_QUALITY_DCLAW_DIR to the folder that holds it')
    robot = ElementTree.parse(folder / URDF).getroot()
    for link in robot.iter('link'):
        for visual in link.findall('visual'):
            link.remove(visual)
    for mesh in robot.iter('mesh'):
        mesh.set('filename', str((folder / mesh.get('filename')).resolve()))
    extension = ElementTree.SubElement(robot, 'mujoco')
    ElementTree.SubElement(extension, 'compiler', strippath='false')
    return ElementTree.tostring(robot, encoding='unicode')


def _index(model):
    """Return the HandModel around a compiled model."""
    names = tuple(f'joint_f{finger}_{j}' for finger in (1, 2, 3) for j in (0, 1, 2))
    finger_of_geom = np.full(model.ngeom, -1)
    for geom in range(model.ngeom):
        body = model.body(model.geom_bodyid[geom]).name
        if body.startswith('link_f'):
            finger_of_geom[geom] = int(body[len('link_f')]) - 1
    tip_bodies = np.array([model.body(f'link_f{finger}_3').id for finger in (1, 2, 3)])
    is_mesh = model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    tip_geoms = [np.flatnonzero(is_mesh & (model.geom_bodyid == body))[0] for body in tip_bodies]
    limits = model.jnt_actfrcrange[[model.joint(name).id for name in names]]
    return index_of(model, names, limits, finger_of_geom, tip_bodies, np.array(tip_geoms))
