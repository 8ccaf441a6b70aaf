# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Grasps whose answers are known by hand."""

from grasp_quality import Contact, ContactModel, Grasp
import numpy as np

FX, FY, FZ, TX, TY, TZ = np.eye(6)


def antipodal(friction=0.5, torsional_friction=None, caps=(1.0, 1.0), bound='linf', reach=1.0):
    """Return two contacts on the x axis that face each other; soft fingers with gamma."""
    model = ContactModel.PCWF if torsional_friction is None else ContactModel.SFCE
    return Grasp([
        Contact(position=(x * reach, 0.0, 0.0), normal=(-x, 0.0, 0.0), model=model,
                friction=friction, torsional_friction=torsional_friction or 0.0,
                max_normal_force=cap, name=name, finger=name)
        for x, cap, name in ((-1.0, caps[0], 'left'), (1.0, caps[1], 'right'))], bound)


def three_finger(friction=0.5, bound='linf'):
    """Return three contacts on the equator of the unit ball at 180, 60 and -60 degrees."""
    angles = np.deg2rad([180.0, 60.0, -60.0])
    points = np.stack([np.cos(angles), np.sin(angles), np.zeros(3)], axis=1)
    return Grasp([
        Contact(position=p, normal=-p, friction=friction, name=name, finger=name)
        for p, name in zip(points, ('thumb', 'index', 'middle'))], bound)


def cube_of_eight(friction=0.25, bound='linf'):
    """Return the paper's Fig. 3: four contacts on each of the faces x = -1 and x = +1."""
    return Grasp([
        Contact(position=(x, y, z), normal=(-x, 0.0, 0.0), friction=friction,
                finger='left' if x < 0 else 'right')
        for x in (-1.0, 1.0) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], bound)


def single(friction=0.5, model=ContactModel.PCWF, torsional_friction=0.0, cap=1.0):
    """Return one contact at the origin that presses along +x."""
    return Grasp([Contact(
        position=(0.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0), model=model, friction=friction,
        torsional_friction=torsional_friction, max_normal_force=cap)])
