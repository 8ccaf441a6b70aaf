# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Markers: a grasp, its forces and its map as visualization_msgs.

Every marker of a namespace has the index of its contact as id, so that a new one takes the place
of the old. Forces, task and map share one scale, which the marker ``legend`` states. A friction
cone is the bare head of an ARROW whose tip is the contact: two points instead of a mesh.
"""

from dataclasses import dataclass

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from grasp_quality.directions import force_grid
from grasp_quality.grasp import Grasp
from msg_adapters import colours
from msg_adapters.marker_geometry import Array, grid_faces, thinned_rows
import numpy as np
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

CONE_OPACITY, MAP_OPACITY = 0.55, 0.35
MAP_RINGS = 18         # of the drawn map: Python takes long to write more points into a message
CONE_SHARE = 0.4       # height of the cones, of the lever arm
SHAFT, HEAD = 0.025, 0.05    # diameters of arrows, of the lever arm
TEXT = 0.12            # height of letters, of the lever arm
NOTHING = 1e-9         # arrows shorter than this share of the lever arm are not drawn
NARROWEST = 1e-3       # diameter of a cone without friction, of its height


@dataclass(frozen=True, eq=False)
class Picture:
    """
    What is drawn at one instant, in the object frame.

    Attributes
    ----------
    header : std_msgs.msg.Header
        Object frame, stamp of the contacts.
    grasp : Grasp
        The contacts used.
    optimal : (k, 4) array [N, N, N, N m]
        [t1, t2, n, m_n] of the answer, in the contact frames.
    cone_usage : (k,) array [-]
    measured : tuple of k (4,) arrays or None
        Measured local forces, where there are any.
    alpha : float [-]
    task : (6,) array [N, N m]
        The wrench that alpha multiplies, about the object frame's origin.
    limiting_contact : str
        Name, empty for none.
    metres_per_newton : float
        Scale of forces; torques are drawn as the force that has them at the lever arm.
    lifetime : builtin_interfaces.msg.Duration
        After which a marker that is not renewed disappears.

    """

    header: Header
    grasp: Grasp
    optimal: Array
    cone_usage: Array
    measured: tuple[Array | None, ...]
    alpha: float
    task: Array
    limiting_contact: str
    metres_per_newton: float
    lifetime: Duration


def delete_all(header: Header) -> MarkerArray:
    """Take everything off the screen."""
    return MarkerArray(markers=[Marker(header=header, action=Marker.DELETEALL)])


def grasp_markers(picture: Picture, anew: bool) -> MarkerArray:
    """
    Draw contacts, forces and task.

    Parameters
    ----------
    picture : Picture
        What is to be seen.
    anew : bool
        Whether to begin with DELETEALL, because the contacts are not those drawn before.

    Returns
    -------
    visualization_msgs.msg.MarkerArray

    """
    markers = delete_all(picture.header).markers if anew else []
    for i in range(len(picture.grasp)):
        markers += _contact_markers(picture, i)
    origin, reach = np.zeros(3), picture.grasp.lever_arm
    applied = picture.alpha * picture.task
    unit = picture.metres_per_newton
    markers += [
        _arrow(picture, 'task_force', 0, origin, unit * applied[:3], colours.TASK),
        _arrow(picture, 'task_torque', 0, origin, unit / reach * applied[3:], colours.TASK, 0.6),
        _text(picture, 'legend', 0, picture.grasp.center + [0.0, 0.0, 2.2 * reach], (
            f'alpha {picture.alpha:.4g}, arrows {1e3 * unit:.3g} mm/N, torques '
            f'{1e3 * unit / reach:.3g} mm/(N m)'))]
    return MarkerArray(markers=markers)


def _contact_markers(picture: Picture, i: int) -> list[Marker]:
    grasp, unit = picture.grasp, picture.metres_per_newton
    point, R, reach = grasp.positions[i], grasp.rotations[i], grasp.lever_arm
    normal, name = R[:, 2], grasp.names[i]
    limiting = name == picture.limiting_contact
    measured = picture.measured[i]
    felt = np.zeros(3) if measured is None else unit * R @ measured[:3]
    optimal = picture.optimal[i, :3] if len(picture.optimal) else np.zeros(3)
    return [
        _cone(picture, i, point, normal),
        _arrow(picture, 'optimal_forces', i, point, unit * R @ optimal, colours.OPTIMAL),
        _arrow(picture, 'measured_forces', i, point, felt, colours.MEASURED),
        _text(picture, 'names', i, point - 0.35 * reach * normal,
              f'{name} (limits)' if limiting else name),
        _ball(picture, 'limiting_contact', i, point, limiting)]


def _cone(picture: Picture, i: int, apex: Array, normal: Array) -> Marker:
    marker = _marker(picture, 'friction_cones', i, Marker.ARROW)
    height = CONE_SHARE * picture.grasp.lever_arm
    friction = float(picture.grasp.contacts.effective_friction[i])
    marker.points = [_point(apex + height * normal), _point(apex)]
    marker.scale.x = NARROWEST * height
    marker.scale.y = max(2.0 * friction, NARROWEST) * height
    marker.scale.z = height
    usage = picture.cone_usage[i:i + 1]
    colour = colours.usage_colours(usage)[0] if len(usage) else colours.UNKNOWN
    marker.color = _colour(colour, CONE_OPACITY)
    return marker


def _arrow(picture: Picture, namespace: str, i: int, tail: Array, vector: Array,
           colour: tuple[float, float, float], thin: float = 1.0) -> Marker:
    marker = _marker(picture, namespace, i, Marker.ARROW)
    reach, length = picture.grasp.lever_arm, float(np.linalg.norm(vector))
    if not length > NOTHING * reach:
        marker.action = Marker.DELETE
        return marker
    marker.points = [_point(tail), _point(tail + vector)]
    marker.scale.x, marker.scale.y = thin * SHAFT * reach, thin * HEAD * reach
    marker.scale.z = min(HEAD * 2.0 * reach, 0.5 * length)
    marker.color = _colour(colour, 1.0)
    return marker


def _ball(picture: Picture, namespace: str, i: int, point: Array, shown: bool) -> Marker:
    marker = _marker(picture, namespace, i, Marker.SPHERE)
    if not shown:
        marker.action = Marker.DELETE
        return marker
    marker.pose.position = _point(point)
    size = 3.0 * HEAD * picture.grasp.lever_arm
    marker.scale.x = marker.scale.y = marker.scale.z = size
    marker.color = _colour(colours.LIMITING, 0.8)
    return marker


def _text(picture: Picture, namespace: str, i: int, point: Array, text: str) -> Marker:
    marker = _marker(picture, namespace, i, Marker.TEXT_VIEW_FACING)
    marker.pose.position = _point(point)
    marker.scale.z = TEXT * picture.grasp.lever_arm
    marker.color = _colour((1.0, 1.0, 1.0), 1.0)
    marker.text = text
    return marker


def map_marker(header: Header, resolution: int, alphas: Array, metres_per_newton: float,
               lifetime: Duration) -> MarkerArray:
    """
    Draw the surface of the forces that the grasp can apply, about the object frame's origin.

    Parameters
    ----------
    header : std_msgs.msg.Header
        Object frame, stamp of the contacts.
    resolution : int
        r of the grid of directions.
    alphas : (2 r^2,) array [N]
        Largest force in each direction.
    metres_per_newton : float
        That of the forces.
    lifetime : builtin_interfaces.msg.Duration
        After which the map disappears when it is not renewed.

    Returns
    -------
    visualization_msgs.msg.MarkerArray
        One TRIANGLE_LIST of at most MAP_RINGS rings of the directions.

    """
    rows, rings, columns = thinned_rows(resolution, MAP_RINGS)
    kept = alphas[rows]
    points = [_point(p) for p in
              metres_per_newton * kept[:, None] * force_grid(resolution)[rows, :3]]
    tints = [_colour(c, MAP_OPACITY) for c in colours.alpha_colours(kept)]
    corners = grid_faces(rings, columns).ravel().tolist()
    marker = Marker(header=header, ns='force_map', type=Marker.TRIANGLE_LIST, lifetime=lifetime)
    marker.pose.orientation.w = 1.0
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0
    marker.color = _colour((1.0, 1.0, 1.0), MAP_OPACITY)
    marker.points = [points[corner] for corner in corners]
    marker.colors = [tints[corner] for corner in corners]
    return MarkerArray(markers=[marker])


def _marker(picture: Picture, namespace: str, i: int, kind: int) -> Marker:
    marker = Marker(header=picture.header, ns=namespace, id=i, type=kind,
                    lifetime=picture.lifetime)
    marker.pose.orientation.w = 1.0
    return marker


def _point(array: Array) -> Point:
    x, y, z = array.tolist()
    return Point(x=x, y=y, z=z)


def _colour(rgb: tuple[float, float, float] | Array, opacity: float) -> ColorRGBA:
    red, green, blue = (float(c) for c in rgb)
    return ColorRGBA(r=red, g=green, b=blue, a=opacity)
