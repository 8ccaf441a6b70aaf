# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Security that is asked for and may not be in force keeps the node from being active."""

from pathlib import Path
from xml.etree import ElementTree

from ament_index_python.packages import get_package_share_directory
from grasp_quality.node_security import unsecured_reason
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, wrench
from harness import Client, start_node
import pytest
from rclpy.node import NodeNameNonExistentError

ENABLE, STRATEGY = 'ROS_SECURITY_ENABLE', 'ROS_SECURITY_STRATEGY'


@pytest.mark.parametrize('environment', [
    {}, {ENABLE: 'false'}, {ENABLE: ''}, {ENABLE: 'false', STRATEGY: 'Enforce'},
    {ENABLE: 'true', STRATEGY: 'Enforce'}])
def test_all_is_as_asked(environment):
    assert unsecured_reason(environment) == ''


@pytest.mark.parametrize('environment', [
    {ENABLE: 'true'}, {ENABLE: 'true', STRATEGY: 'Permissive'}, {ENABLE: 'True'}, {ENABLE: '1'},
    {ENABLE: 'True', STRATEGY: 'Enforce'}, {ENABLE: 'true', STRATEGY: 'enforce'},
    {STRATEGY: 'Enforce'}])
def test_whatever_ros_does_not_guarantee_is_named(environment):
    reason = unsecured_reason(environment)
    assert all(f'{name}={value}' in reason for name, value in environment.items())
    assert 'allow_unsecured' in reason


def answer_of(namespace):
    client = Client(namespace)
    try:
        return client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench',
                           contacts=contact_array(ANTIPODAL), task_wrench=wrench(fy=1.0))
    finally:
        client.close()


def test_keys_that_are_not_found_keep_the_node_inactive(tmp_path):
    process = start_node(tmp_path / 'log.txt', '/unsecured', environment={
        ENABLE: 'true', 'ROS_SECURITY_KEYSTORE': str(tmp_path / 'none')})
    process.until_it_says('autostart failed')
    assert 'security was asked for (ROS_SECURITY_ENABLE=true)' in process.log()
    assert answer_of('/unsecured').result.code == ResultCode.NOT_ACTIVE
    assert process.end() == 0


def test_the_parameter_allows_it_and_the_log_says_so(tmp_path):
    process = start_node(
        tmp_path / 'log.txt', '/open', allow_unsecured='true', environment={ENABLE: 'True'})
    process.until_it_says('active')
    assert 'allow_unsecured is set' in process.log()
    assert answer_of('/open').result.code == ResultCode.OPTIMAL
    assert process.end() == 0


def test_enforced_security_without_keys_ends_with_one_line(tmp_path):
    process = start_node(tmp_path / 'log.txt', '/enforced', environment={
        ENABLE: 'true', STRATEGY: 'Enforce', 'ROS_SECURITY_KEYSTORE': str(tmp_path / 'none')})
    assert process.wait() == 1
    assert 'grasp_quality_node: ' in process.log() and 'Traceback' not in process.log()


def test_a_middleware_without_security_ends_with_one_line(tmp_path):
    """The keys are found; a Fast DDS that has no DDS-Security or cannot read them refuses."""
    enclave = tmp_path / 'keystore' / 'enclaves'
    enclave.mkdir(parents=True)
    process = start_node(tmp_path / 'log.txt', '/keys', environment={
        ENABLE: 'true', STRATEGY: 'Enforce', 'ROS_SECURITY_KEYSTORE': str(enclave.parent)})
    assert process.wait() == 1
    assert 'grasp_quality_node: ' in process.log() and 'Traceback' not in process.log()


POLICIES = Path(get_package_share_directory('grasp_quality'), 'config', 'security')


def granted(role, kind, verb):
    """Return what a policy grants on the node, without the node's name or a last wildcard."""
    items = ElementTree.parse(POLICIES / f'{role}.policy.xml').iterfind(f'.//{kind}s[@{verb}]/*')
    names = [item.text.replace('~/', '/grasp_quality/', 1) for item in items]
    return {name.removeprefix('/grasp_quality').removesuffix('/*') for name in names
            if name.startswith('/grasp_quality/')}


def test_the_policy_of_the_node_grants_all_that_it_has_and_no_more(start):
    node = start(contact_source='pose_array', contact_names='[left]').client
    array = start(contact_source='contact_array').client

    def names(client, method):
        try:
            found = getattr(client.node, method)(
                'grasp_quality', client.target.removesuffix('/grasp_quality'))
        except NodeNameNonExistentError:  # not discovered yet
            return set()
        return {name.removeprefix(client.target).removesuffix('/left') for name, _ in found
                if name.startswith(f'{client.target}/')}

    methods = {('topic', 'publish'): 'get_publisher_names_and_types_by_node',
               ('topic', 'subscribe'): 'get_subscriber_names_and_types_by_node',
               ('service', 'reply'): 'get_service_names_and_types_by_node'}
    for (kind, verb), method in methods.items():
        wanted = granted('node', kind, verb)
        node.until(lambda: names(node, method) | names(array, method) == wanted,
                   f'{sorted(wanted)}, there are {sorted(names(node, method))}')


@pytest.mark.parametrize('role', ['sensor', 'planner', 'controller', 'operator'])
def test_every_role_is_granted_only_what_the_node_has(role):
    assert granted(role, 'topic', 'publish') <= granted('node', 'topic', 'subscribe')
    assert granted(role, 'topic', 'subscribe') <= granted('node', 'topic', 'publish')
    assert granted(role, 'service', 'request') <= granted('node', 'service', 'reply')
