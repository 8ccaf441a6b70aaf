# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The RViz and Foxglove files show topics, namespaces and fields that there are."""

import json
from pathlib import Path
import re

from ament_index_python.packages import get_package_share_directory
from builtin_interfaces.msg import Duration
from grasp_quality import Contact, evaluate, Grasp, TaskWrench
from grasp_quality_msgs.msg import GraspQuality
from msg_adapters.markers import grasp_markers, map_marker, Picture
import numpy as np
from std_msgs.msg import Header

CONFIG = Path(get_package_share_directory('grasp_quality')) / 'config'
TASK = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])


def namespaces():
    grasp = Grasp([Contact((x, 0.0, 0.0), normal=(-x, 0.0, 0.0), friction=0.5)
                   for x in (-1.0, 1.0)])
    answer = evaluate(grasp, TaskWrench(TASK))
    picture = Picture(
        header=Header(), grasp=grasp, optimal=answer.forces, cone_usage=answer.cone_usage,
        measured=(None, None), alpha=1.0, task=TASK, limiting_contact='', metres_per_newton=1.0,
        lifetime=Duration())
    surface = map_marker(Header(), 2, np.ones(8), 1.0, Duration())
    return {m.ns for m in grasp_markers(picture, False).markers + surface.markers}


def test_rviz_shows_every_namespace_of_the_markers():
    text = (CONFIG / 'grasp_quality.rviz').read_text()
    block = text.split('Namespaces:')[1].split('Topic:')[0]
    assert set(re.findall(r'(\w+): true', block)) == namespaces()
    assert 'Value: /grasp_quality/markers' in text


def test_foxglove_plots_fields_that_there_are():
    layout = json.loads((CONFIG / 'grasp_quality.foxglove.json').read_text())
    fields = GraspQuality.get_fields_and_field_types()
    panels = layout['configById'].items()
    paths = [path['value'] for name, panel in panels if name.startswith('Plot')
             for path in panel['paths']]
    assert len(paths) == 4
    for path in paths:
        topic, field = path.rsplit('.', 1)
        assert topic == '/grasp_quality/quality' and field in fields
    assert '/grasp_quality/markers' in layout['configById']['3D!grasp']['topics']
