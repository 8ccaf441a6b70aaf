# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The same grasp with its contacts elsewhere: what does not depend on places is not made again.

For contacts that come as a stream: names, friction, caps and what follows from them stay as they
are, and are not checked and scaled again with every sample.
"""

from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import InvalidGraspError
from grasp_quality.grasp import Grasp

# of a Grasp; every other attribute depends on places
ANYWHERE = ('bound', 'joint_limits', 'groups', 'names', 'scales', 'force_units', 'force_scale',
            'cap_total', 'least_cap')


def moved(grasp: Grasp, contacts: ContactSet) -> Grasp:
    """
    Put a grasp's contacts elsewhere.

    Parameters
    ----------
    grasp : Grasp
        Stays as it is.
    contacts : ContactSet
        From ``grasp.contacts.moved``: the same but for positions and rotations.

    Raises
    ------
    InvalidGraspError
        With joint limits: their Jacobians are those of the old places.

    """
    if grasp.joint_limits is not None:
        raise InvalidGraspError(
            'a grasp with joint_limits cannot be moved: make a Grasp with the limits of the new '
            'places')
    there = object.__new__(Grasp)
    there.__dict__.update(
        {name: grasp.__dict__[name] for name in ANYWHERE if name in grasp.__dict__},
        contacts=contacts)
    return there
