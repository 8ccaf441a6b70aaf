# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Pure functions between ROS messages and the objects of the core.

Sign, unit, frame, missing header and QoS names live here and nowhere else: ``contacts``,
``tasks`` and ``measured`` read messages, ``forces`` and ``results`` write them, ``frames`` brings
both into the object frame, ``wrenches`` and ``stamps`` convert the small parts. Nothing here keeps
state or needs a running node.
"""
