# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a grasp: hand, object, friction cones and contact forces."""

from grasp_quality_hand import shapes
from grasp_quality_hand.grasp_objects import FRICTION
from grasp_quality_hand.hand_model import build_hand_model
from grasp_quality_hand.measured_grasp import rotation
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
import mujoco
import numpy as np

HAND = np.array([0.47, 0.49, 0.53])
OBJECT = np.array([0.86, 0.84, 0.78])
CONE = np.array([0.34, 0.71, 0.91])
MEASURED = np.array([0.0, 0.45, 0.70])
LIFT = np.array([0.84, 0.37, 0.0])
METRES_PER_NEWTON = 0.003
CONE_HEIGHT = 0.018          # [m]
ARROW_RADIUS = 0.0011        # [m]
LONGEST_EDGE = 0.008         # of the triangles, which are sorted by depth [m]
VIEW = (20.0, -60.0)         # elevation and azimuth [degrees]
MM = 1e3


def draw_grasp(path, grasp_object, grasp, lift, joints, object_pose):
    """
    Save the picture of a grasp.

    Parameters
    ----------
    path : path
        Of the PNG file.
    grasp_object : GraspObject
        What is held.
    grasp : MeasuredGrasp
        What was measured.
    lift : EvaluateTaskWrench.Response
        With the forces that lift best.
    joints : JointState
        Of the hand.
    object_pose : PoseStamped
        In the hand's base frame.

    """
    R, p = pose_of(object_pose)
    positions = grasp.positions @ R.T + p
    normals = np.einsum('ij,kj->ki', R, grasp.rotations[:, :, 2])
    measured = grasp.forces_in_object_frame @ R.T
    best = _forces(lift, grasp.fingers) @ R.T
    hand, tips = _hand(grasp_object, joints)
    held = object_triangles(grasp_object) @ R.T + p
    near = [part(tips, HAND, 0.10), part(held, OBJECT, 0.30)]
    for point, normal, now, most in zip(positions, normals, measured, best):
        near.append(part(shapes.friction_cone(point, normal, FRICTION, CONE_HEIGHT), CONE, 0.35))
        near.append(part(shapes.arrow(point, METRES_PER_NEWTON * now, ARROW_RADIUS), MEASURED))
        near.append(part(shapes.arrow(point, METRES_PER_NEWTON * most, ARROW_RADIUS), LIFT))

    figure = Figure(figsize=(13.0, 6.6))
    figure.subplots_adjust(left=0.0, right=0.96, bottom=0.09, top=0.95, wspace=0.08)
    FigureCanvasAgg(figure)
    whole = figure.add_subplot(1, 2, 1, projection='3d')
    draw_parts(whole, [part(shapes.facing(hand, VIEW), HAND),
                       part(shapes.facing(held, VIEW), OBJECT)])
    frame_axes(whole, np.array([0.0, 0.0, 0.125]), 0.128)
    whole.set_title(f"D'Claw holding the {grasp_object.name}, {MM * grasp_object.mass:.0f} g")
    detail = figure.add_subplot(1, 2, 2, projection='3d')
    draw_parts(detail, near)
    frame_axes(detail, p, 0.060)
    for finger, point, normal in zip(grasp.fingers, positions, normals):
        detail.text(*(MM * (point - 0.022 * normal)), finger, ha='center', fontsize=11)
    detail.set_title(f'Contact forces on the {grasp_object.name} '
                     f'({MM * METRES_PER_NEWTON:.0f} mm of arrow per newton)')
    figure.legend(handles=[
        Patch(color=MEASURED, label='measured force'),
        Patch(color=LIFT, label=f'forces that lift {lift.alpha:.1f} times the weight'),
        Patch(color=CONE, alpha=0.5, label=f'friction cone, coefficient {FRICTION:g}')],
        loc='lower center', ncols=3, fontsize=11, frameon=False)
    figure.savefig(path, dpi=110)


def part(triangles, colour, alpha=1.0):
    """Return triangles cut fine, with their face and edge colours."""
    triangles = shapes.fine(triangles, LONGEST_EDGE)
    faces = shapes.shaded(triangles, colour, alpha)
    return triangles, faces, faces * [1.0, 1.0, 1.0, alpha == 1.0]


def draw_parts(axes, parts):
    """Draw triangles with their colours as one collection, so that all are sorted by depth."""
    triangles, faces, edges = (np.concatenate(things) for things in zip(*parts))
    axes.add_collection3d(Poly3DCollection(MM * triangles, facecolors=faces, edgecolors=edges,
                                           linewidths=0.3))


def frame_axes(axes, centre, reach):
    """Set the limits about a centre in metres, and name the axes."""
    for axis, middle in zip('xyz', centre):
        getattr(axes, f'set_{axis}lim')(MM * (middle - reach), MM * (middle + reach))
        getattr(axes, f'set_{axis}label')(f'{axis} [mm]')
        getattr(axes, f'{axis}axis').set_major_locator(MaxNLocator(5))
    axes.set_box_aspect((1.0, 1.0, 1.0), zoom=1.08)
    axes.patch.set_visible(False)    # it would cover the label beside it
    axes.set_proj_type('ortho')
    axes.view_init(*VIEW)


def pose_of(message):
    """Return rotation and position of a PoseStamped."""
    p, q = message.pose.position, message.pose.orientation
    return rotation((q.x, q.y, q.z, q.w)), np.array([p.x, p.y, p.z])


def _forces(response, fingers):
    """Return the forces of a response in the order of the fingers, shape (k, 3) [N]."""
    forces = {contact.name: contact.wrench.force for contact in response.forces.forces}
    return np.array([[forces[f].x, forces[f].y, forces[f].z] for f in fingers])


def object_triangles(grasp_object):
    """Return the triangles of the object in its own frame."""
    if grasp_object.shape == 'box':
        return shapes.box(grasp_object.size)
    return {'sphere': shapes.ball, 'cylinder': shapes.cylinder}[grasp_object.shape](
        *grasp_object.size)


def _hand(grasp_object, joints):
    """Return the triangles of the hand's and of the fingertips' collision shapes, base frame."""
    hand = build_hand_model(grasp_object)
    angles = dict(zip(joints.name, joints.position))
    return hand_triangles(hand, mujoco.MjData(hand.mujoco),
                          [angles[name] for name in hand.joint_names])


def hand_triangles(hand, data, angles):
    """Return the triangles of the hand's and of the fingertips' collision shapes, base frame."""
    model = hand.mujoco
    data.qpos[hand.joint_qpos] = angles
    mujoco.mj_kinematics(model, data)
    placed = {geom: _collision_shape(model, geom) @ data.geom_xmat[geom].reshape(3, 3).T
              + data.geom_xpos[geom] for geom in range(model.ngeom) if geom != hand.object_geom}
    return (np.concatenate(list(placed.values())),
            np.concatenate([placed[geom] for geom in hand.tip_geoms]))


def _collision_shape(model, geom):
    """Return the triangles of a box or of the hull of a mesh, in its own frame."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_BOX:
        return shapes.box(model.geom_size[geom])
    mesh = model.geom_dataid[geom]
    first = model.mesh_vertadr[mesh]
    last = first + model.mesh_vertnum[mesh]
    return shapes.convex_hull(model.mesh_vert[first:last].astype(float))
