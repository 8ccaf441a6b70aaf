# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A hand that can be worked out by hand: two fingers of one hinge each, 0.1 m long."""

LENGTH = 0.1      # of a finger [m]
MASS = 0.2        # of a finger, at half its length [kg]
EFFORT = 2.0      # limit of each joint [N m]


def urdf(effort=EFFORT):
    """Return the URDF: fingers along +z at x = +-0.05 m, with hinges about +y."""
    finger = ''
    for name, x in (('left', -0.05), ('right', 0.05)):
        finger += f"""
  <link name="{name}_finger"><inertial><origin xyz="0 0 {LENGTH / 2}"/><mass value="{MASS}"/>
    <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="{name}_hinge" type="revolute"><parent link="palm"/><child link="{name}_finger"/>
    <origin xyz="{x} 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="{effort}" velocity="10"/></joint>"""
    return f'<robot name="two_fingers"><link name="palm"/>{finger}\n</robot>'
