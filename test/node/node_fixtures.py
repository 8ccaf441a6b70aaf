# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Fixtures of all tests that start nodes, and the environment they need before ROS is imported."""

from contextlib import contextmanager
import itertools
import os
from types import SimpleNamespace

import pytest

os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'

NUMBERS = itertools.count()


@pytest.fixture(scope='session', autouse=True)
def ros_log_dir(tmp_path_factory):
    """Keep the log files of ROS out of the home directory."""
    os.environ['ROS_LOG_DIR'] = str(tmp_path_factory.mktemp('ros'))


@pytest.fixture(scope='module')
def start(tmp_path_factory):
    """Start nodes with parameters; each has a namespace, a process, a client and an auditor."""
    with begun_nodes(tmp_path_factory) as begin:
        yield begin


@contextmanager
def begun_nodes(tmp_path_factory):
    """Give a function that starts nodes; end them, and check how they and their auditors end."""
    from harness import Client, start_audit, start_node

    begun = []

    def begin(*arguments, start_node=start_node, **parameters):
        namespace = f'/hand_{next(NUMBERS)}'
        log = tmp_path_factory.mktemp('node') / 'log.txt'
        process = start_node(log, namespace, *arguments, **parameters)
        begun.append(SimpleNamespace(
            namespace=namespace, process=process, client=None, expected=set(), audit=start_audit(
                log.with_name('audit.txt'), namespace,
                use_sim_time=parameters.get('use_sim_time', 'false'))))
        # a participant that is there before the node's endpoints are learns of them 2 s later
        process.until_it_says('active')
        begun[-1].audit.until_it_says('listening')
        begun[-1].client = Client(namespace)
        begun[-1].audit.until_it_says('has told its parameters')  # before it is to judge
        return begun[-1]

    yield begin
    for node in begun:
        if node.client is not None:
            node.client.close()
        if node.process.popen.poll() is None:
            assert node.process.end() == 0, node.process.log()
        for words in {'internal error', 'Traceback'} - node.expected:
            assert words not in node.process.log()
        assert node.audit.end() in (0, 2), node.audit.log()  # 2: no forces were published
        assert 'without parameters' not in node.audit.log()
