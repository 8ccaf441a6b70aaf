# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What all simulated hands have in common: contact physics, the object, and where things stand.

Elliptic cones, a high impratio and the noslip solver make loads at slip agree with Coulomb's cone
(docs/truth.md); with pyramids or an impratio of 1 they are wrong by large factors.

"""

from dataclasses import dataclass
from typing import Any

from grasp_quality_hand.grasp_objects import GraspObject
import mujoco
import numpy as np
from numpy.typing import NDArray

HOLDER = 'holder'                           # the weld that holds the object before the grasp
IMPRATIO = 1000.0            # enough for a hand in real time
NOSLIP_ITERATIONS = 50       # enough for a hand in real time
NOSLIP_TOLERANCE = 1e-6
SOLREF = (0.003, 1.0)                       # time constant [s] and damping ratio of contacts
SOLIMP = (0.99, 0.999, 0.0005)
SHAPES = {'box': mujoco.mjtGeom.mjGEOM_BOX, 'sphere': mujoco.mjtGeom.mjGEOM_SPHERE,
          'cylinder': mujoco.mjtGeom.mjGEOM_CYLINDER}

Spec = Any      # mujoco.MjSpec and mujoco.MjsGeom have no types that mypy could see


@dataclass(frozen=True)
class HandModel:
    """
    The compiled model and the indices into it that everything else needs.

    Attributes
    ----------
    mujoco : mujoco.MjModel
        The compiled model.
    joint_names : tuple of str
        In the order of the efforts.
    joint_qpos, joint_dof : ndarray, shape (n,)
        Addresses of the joints in qpos and in qvel.
    effort_limits : ndarray, shape (n, 2)
        Smallest and largest effort of each joint [N m, N for a sliding joint].
    finger_of_geom : ndarray, shape (ngeom,)
        Index of the finger that a geometry belongs to, -1 for none.
    tip_bodies, tip_geoms : ndarray, shape (fingers,)
        Last link of each finger and the geometry of its fingertip.
    object_body, object_geom, object_qpos : int
        The object, and the address of its pose in qpos.
    holder : int
        The weld between world and object.

    """

    mujoco: Any
    joint_names: tuple[str, ...]
    joint_qpos: NDArray[np.int_]
    joint_dof: NDArray[np.int_]
    effort_limits: NDArray[np.float64]
    finger_of_geom: NDArray[np.int_]
    tip_bodies: NDArray[np.int_]
    tip_geoms: NDArray[np.int_]
    object_body: int
    object_geom: int
    object_qpos: int
    holder: int


def set_options(spec: Spec, timestep: float, noslip_iterations: int = NOSLIP_ITERATIONS,
                noslip_tolerance: float = NOSLIP_TOLERANCE, impratio: float = IMPRATIO) -> None:
    """
    Set the options under which loads at slip agree with Coulomb's cone.

    Parameters
    ----------
    spec : mujoco.MjSpec
        To be changed.
    timestep : float
        [s]
    noslip_iterations : int
        At most so many, in each time step.
    noslip_tolerance : float
        Change of friction at which they end. When that is early, contacts creep below their
        friction limit.
    impratio : float
        Stiffness of friction over that of normal forces in what the noslip solver begins with.

    """
    spec.option.timestep = timestep
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = impratio
    spec.option.noslip_iterations = noslip_iterations
    spec.option.noslip_tolerance = noslip_tolerance
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST


def set_contact(geom: Spec, friction: float, torsional_friction: float) -> None:
    """
    Give a geometry its stiffness and its friction.

    Of two geometries that touch, the larger coefficients and the richer model count.

    Parameters
    ----------
    geom : mujoco.MjsGeom
        To be changed.
    friction : float
        [-]; 0 for a contact without friction.
    torsional_friction : float
        [m]; 0 for a point contact.

    """
    geom.condim = 4 if torsional_friction > 0.0 else 3 if friction > 0.0 else 1
    geom.friction = [friction, torsional_friction, 0.0]
    geom.solref[:2] = SOLREF
    geom.solimp[:3] = SOLIMP


def add_object(spec: Spec, grasp_object: GraspObject) -> None:
    """Add the object, free, and the weld that holds it until the grasp is closed."""
    body = spec.worldbody.add_body(name='object', pos=[0.0, 0.0, grasp_object.height])
    body.add_freejoint(name='object')
    geom = body.add_geom(name='object', type=SHAPES[grasp_object.shape], mass=grasp_object.mass,
                         contype=0, conaffinity=1)
    geom.size[:len(grasp_object.size)] = grasp_object.size
    set_contact(geom, grasp_object.friction, grasp_object.torsional_friction)
    holder = spec.add_equality(name=HOLDER, type=mujoco.mjtEq.mjEQ_WELD,
                               objtype=mujoco.mjtObj.mjOBJ_BODY, name1='object', name2='world')
    holder.data[:] = 0.0    # anchor (3,), pose (7,): zeros mean as it stands
    holder.data[10] = 1.0    # torque over force [m]
    holder.active = True


def index_of(model: Any, joint_names: tuple[str, ...], effort_limits: NDArray[np.float64],
             finger_of_geom: NDArray[np.int_], tip_bodies: NDArray[np.int_],
             tip_geoms: NDArray[np.int_]) -> HandModel:
    """Return the HandModel around a compiled model, with what its builder knows."""
    joints = [model.joint(name) for name in joint_names]
    return HandModel(
        mujoco=model, joint_names=joint_names,
        joint_qpos=np.array([joint.qposadr[0] for joint in joints], dtype=int),
        joint_dof=np.array([joint.dofadr[0] for joint in joints], dtype=int),
        effort_limits=effort_limits, finger_of_geom=finger_of_geom,
        tip_bodies=tip_bodies, tip_geoms=tip_geoms,
        object_body=model.body('object').id, object_geom=model.geom('object').id,
        object_qpos=int(model.joint('object').qposadr[0]), holder=model.equality(HOLDER).id)
