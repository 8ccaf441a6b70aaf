# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured contact wrenches: the slip margin, and which contacts are loaded."""

import math

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, numbers, pose_array, SOLVER, wrench
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_msgs.msg import Header

NAMES = ('left', 'right')


@pytest.fixture(scope='module')
def client(start):
    return start(contact_names='[left, right]', max_contact_age='0.5',
                 task_wrench='[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]').client


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of the two poses and of wrenches by name."""
    poses = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    sensors = {name: client.publisher(WrenchStamped, f'contact_wrenches/{name}', BEST_EFFORT)
               for name in NAMES}

    def make(stamped=True, frames=NAMES, **measured):
        def publish():
            stamp = client.now()
            for name, frame in zip(NAMES, frames):
                if name in measured:
                    message = WrenchStamped(header=Header(frame_id=frame), wrench=measured[name])
                    if stamped:
                        message.header.stamp = stamp
                    sensors[name].publish(message)
            poses.publish(pose_array(ANTIPODAL, stamp))
        return publish
    return make


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client, NAMES)


@pytest.fixture
def only_loaded(client):
    """Count only contacts with a measured normal force of 1 N or more."""
    def threshold(value):
        answer = client.call(SetParameters, 'set_parameters', parameters=[Parameter(
            name='min_contact_force', value=ParameterValue(
                type=ParameterType.PARAMETER_DOUBLE, double_value=value))])
        assert answer.results[0].successful
    threshold(1.0)
    yield
    threshold(0.0)


def margin(value):
    return lambda quality: quality.slip_measured and quality.measured_slip_margin == pytest.approx(
        value, abs=1e-9)


def test_without_measurements_there_is_no_measured_margin(outputs, feed):
    quality = outputs.answer(feed()).quality
    assert (quality.slip_measured, quality.measured_slip_margin) == (False, 0.0)


@pytest.mark.parametrize('measured, value', [
    ({'left': wrench(fx=1.0, fz=5.0)}, 0.6),                              # 1 of 0.5 * 5
    ({'left': wrench(fz=5.0), 'right': wrench(fx=0.3, fy=0.4, fz=2.0)}, 0.5),
    ({'left': wrench(fz=5.0), 'right': wrench(fz=5.0, tx=9.0, ty=9.0, tz=9.0)}, 1.0),
    ({'left': wrench(fx=3.0, fz=5.0)}, -0.2),                             # outside the cone
    ({'left': wrench(fx=3.0, fz=-5.0)}, -1.0)])                           # far outside
def test_the_measured_margin_is_that_of_the_worst_contact(outputs, feed, measured, value):
    for stamped in (True, False):
        outputs.answer(feed(stamped, **measured), margin(value))


def test_wrenches_in_the_object_frame_are_about_its_origin(outputs, feed):
    """The left contact is at x = -1: 1 N along z there is 1 N m about y."""
    measured = {'left': wrench(fx=5.0, fz=1.0, ty=1.0)}
    outputs.answer(feed(frames=('object', 'object'), **measured), margin(0.6))


def test_measurements_grow_old(outputs, feed):
    outputs.answer(feed(left=wrench(fx=1.0, fz=5.0)), margin(0.6))
    outputs.answer(feed(), lambda quality: not quality.slip_measured)


def test_only_loaded_contacts_count(outputs, feed, only_loaded):
    """With the left contact alone, +x reaches 10 N and the right one gets a zero wrench."""
    found = outputs.answer(feed(left=wrench(fz=5.0), right=wrench(fz=0.9)), names=['left'])
    assert found.quality.alpha == pytest.approx(10.0, rel=SOLVER)
    assert not numbers(found.wrenches['right'].wrench).any()
    outputs.answer(feed(left=wrench(fz=5.0), right=wrench(fz=1.1)), names=['left', 'right'])


def test_unloaded_contacts_are_no_contacts(outputs, feed, only_loaded):
    quality = outputs.failure(ResultCode.NO_CONTACTS, feed(left=wrench(fz=0.1)))
    assert 'no contact is loaded' in quality.result.message
    assert 'min_contact_force' in quality.result.message


@pytest.mark.parametrize('frames, measured, words', [
    (('palm', 'right'), wrench(fz=5.0), "frame_id must be the contact frame 'left'"),
    (NAMES, wrench(fz=math.nan), 'contact_wrenches/left: wrench must be finite')])
def test_a_bad_measurement_is_ignored_and_reported(client, outputs, feed, frames, measured, words):
    stream = feed(frames=frames, left=measured)
    outputs.answer(stream, lambda quality: not quality.slip_measured)
    reports = client.listen(DiagnosticArray, '/diagnostics')
    client.fresh(
        reports, lambda m: any(words in v.value for v in m.status[0].values), words, stream)
