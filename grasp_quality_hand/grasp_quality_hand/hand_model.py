# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo model of the D'Claw hand, palm up, with an object above it."""

from dataclasses import dataclass
from pathlib import Path
import xml.etree.ElementTree as ElementTree

from grasp_quality_hand.fetch_dclaw import dclaw_directory, DClawUnavailable, is_complete, URDF
from grasp_quality_hand.grasp_objects import FRICTION, TORSIONAL_FRICTION
import mujoco
import numpy as np

FINGERS = ('finger_1', 'finger_2', 'finger_3')
TIP_CENTRE = np.array([0.073, 0.0, 0.0])    # ball at the end, in the last link's frame [m]
TIP_RADIUS = 0.010                          # [m]
HOLDER = 'holder'                           # the weld that holds the object before the grasp
TIMESTEP = 0.001                            # [s]
ARMATURE = 0.003                            # inertia of the geared motors at the joints [kg m^2]
DAMPING = 0.4                               # of the geared motors [N m s/rad]


@dataclass(frozen=True)
class HandModel:
    """
    The compiled model and the indices into it that everything else needs.

    Attributes
    ----------
    mujoco : mujoco.MjModel
        The compiled model.
    joint_names : tuple of str
        Names as in the URDF, finger by finger, from the base out.
    joint_qpos, joint_dof : ndarray, shape (9,)
        Addresses of the joints in qpos and in qvel.
    effort_limits : ndarray, shape (9, 2)
        Smallest and largest torque of each joint's motor, as in the URDF [N m].
    finger_of_geom : ndarray, shape (ngeom,)
        Index of the finger that a geometry belongs to, -1 for none.
    tip_bodies, tip_geoms : ndarray, shape (3,)
        Last link of each finger and the geometry of its fingertip.
    object_body, object_geom, object_qpos : int
        The object, and the address of its pose in qpos.
    holder : int
        The weld between world and object.

    """

    mujoco: mujoco.MjModel
    joint_names: tuple
    joint_qpos: np.ndarray
    joint_dof: np.ndarray
    effort_limits: np.ndarray
    finger_of_geom: np.ndarray
    tip_bodies: np.ndarray
    tip_geoms: np.ndarray
    object_body: int
    object_geom: int
    object_qpos: int
    holder: int


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
    _set_options(spec)
    for geom in spec.geoms:
        geom.contype, geom.conaffinity = 1, 0
        _set_friction(geom)
    for joint in spec.joints:
        joint.armature, joint.damping[0] = ARMATURE, DAMPING
        motor = spec.add_actuator(name=joint.name, target=joint.name,
                                  trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_motor()
    _add_object(spec, grasp_object)
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


def _set_options(spec):
    """Set the options under which loads at slip agree with Coulomb's cone."""
    spec.option.timestep = TIMESTEP
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 1000.0
    spec.option.noslip_iterations = 50
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST


def _set_friction(geom):
    """Give a geometry the soft-finger contact and its stiffness."""
    geom.condim = 4
    geom.friction = [FRICTION, TORSIONAL_FRICTION, 0.0]
    geom.solref[:2] = [0.003, 1.0]
    geom.solimp[:3] = [0.99, 0.999, 0.0005]


def _add_object(spec, grasp_object):
    """Add the object, free, and the weld that holds it until the grasp is closed."""
    shapes = {'box': mujoco.mjtGeom.mjGEOM_BOX, 'sphere': mujoco.mjtGeom.mjGEOM_SPHERE}
    body = spec.worldbody.add_body(name='object', pos=[0.0, 0.0, grasp_object.height])
    body.add_freejoint(name='object')
    geom = body.add_geom(name='object', type=shapes[grasp_object.shape], mass=grasp_object.mass,
                         contype=0, conaffinity=1)
    geom.size[:len(grasp_object.size)] = grasp_object.size
    _set_friction(geom)
    holder = spec.add_equality(name=HOLDER, type=mujoco.mjtEq.mjEQ_WELD,
                               objtype=mujoco.mjtObj.mjOBJ_BODY, name1='object', name2='world')
    holder.data[:] = 0.0    # anchor (3,), pose (7,): zeros mean as it stands
    holder.data[10] = 1.0    # torque over force [m]
    holder.active = True


def _index(model):
    """Return the HandModel around a compiled model."""
    joints = [model.joint(f'joint_f{finger}_{j}') for finger in (1, 2, 3) for j in (0, 1, 2)]
    finger_of_geom = np.full(model.ngeom, -1)
    for geom in range(model.ngeom):
        body = model.body(model.geom_bodyid[geom]).name
        if body.startswith('link_f'):
            finger_of_geom[geom] = int(body[len('link_f')]) - 1
    tip_bodies = np.array([model.body(f'link_f{finger}_3').id for finger in (1, 2, 3)])
    is_mesh = model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    tip_geoms = [np.flatnonzero(is_mesh & (model.geom_bodyid == body))[0] for body in tip_bodies]
    return HandModel(
        mujoco=model,
        joint_names=tuple(joint.name for joint in joints),
        joint_qpos=np.array([joint.qposadr[0] for joint in joints]),
        joint_dof=np.array([joint.dofadr[0] for joint in joints]),
        effort_limits=model.jnt_actfrcrange[[joint.id for joint in joints]],
        finger_of_geom=finger_of_geom,
        tip_bodies=tip_bodies,
        tip_geoms=np.array(tip_geoms),
        object_body=model.body('object').id,
        object_geom=model.geom('object').id,
        object_qpos=int(model.joint('object').qposadr[0]),
        holder=model.equality(HOLDER).id)
