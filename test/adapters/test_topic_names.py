# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Which contact names can name a topic: those that rclpy takes too."""

from hypothesis import given, strategies
from msg_adapters.topic_names import names_a_topic
import pytest
from rclpy.exceptions import InvalidTopicNameException
from rclpy.validate_topic_name import validate_topic_name


@pytest.mark.parametrize('name', ['a', 'Tip', 'contact_0', 'a1_b2_', 'left_finger_pad', 'a' * 64])
def test_words_can_name_a_topic(name):
    assert names_a_topic(name)
    assert validate_topic_name(name) is True


@pytest.mark.parametrize('name', [
    '', '_a', '0a', 'a__b', 'a b', 'a/b', 'a-b', 'ä', 'a\n', '~', 'a' * 65])
def test_other_names_cannot(name):
    assert not names_a_topic(name)


@given(strategies.text(alphabet='ab0_/~{}- \n', max_size=8))
def test_no_name_that_ros_refuses_is_taken(name):
    if names_a_topic(name):
        try:
            validate_topic_name(name)
        except InvalidTopicNameException as exc:
            pytest.fail(f'{name!r} was taken: {exc}')
