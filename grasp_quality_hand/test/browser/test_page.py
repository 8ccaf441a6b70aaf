# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The page in a real browser: what it shows is what the node says, or that nothing is known."""

import signal
import threading

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import CIRCLE, pose_array, wrench
from harness import BEST_EFFORT
import numpy as np
from page import LEFT, Page, RIGHT, until
import pytest

RADIUS = 0.03  # of the grasp [m]
PUSHES = 30    # of a slider, one degree each; every one is an answer and a picture


@pytest.fixture(scope='module')
def hand(stage):
    """Publish the contacts at 50 Hz from a thread, as a hand does whatever the page does."""
    publisher = stage.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    done = threading.Event()

    def publish():
        while not done.wait(0.02):
            message = pose_array(CIRCLE, stage.client.now())
            for pose in message.poses:
                pose.position.x *= RADIUS
                pose.position.y *= RADIUS
            publisher.publish(message)

    thread = threading.Thread(target=publish)
    thread.start()
    yield
    done.set()
    thread.join()


@pytest.fixture(scope='module')
def page(browser, stage, hand):
    shown = Page(browser, stage.address)
    until(lambda: shown.kind() == 'answer', 'an answer on the page')
    return shown


def ask(stage, direction):
    """Return alpha of a force, by the service."""
    answer = stage.client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench',
                               task_wrench=wrench(*map(float, direction)))
    assert answer.result.code == ResultCode.OPTIMAL
    return answer.alpha


def test_the_page_says_what_the_node_says(page, stage):
    alpha = ask(stage, (0.0, 0.0, 1.0))
    until(lambda: page.alpha() == pytest.approx(alpha, abs=2e-3), f'alpha {alpha}')
    assert 'OPTIMAL' in page.text('gq-status')
    for i in range(3):
        assert f'contact_{i}' in page.text('gq-table')
    assert 'mm/N' in page.text('gq-legend')


def test_the_scene_is_not_blank(page):
    """Cones, forces and map are many colours on a white ground."""
    def coloured():
        pixels = page.canvas()
        if pixels is None:
            return False
        vivid = np.ptp(pixels, axis=2) > 40
        shades = np.unique(pixels[vivid] // 16, axis=0)
        return vivid.mean() > 0.002 and len(shades) > 30
    until(coloured, 'a scene with colours')


def force(elevation, azimuth):
    """Return the unit force in a direction [degrees]."""
    e, a = np.radians([elevation, azimuth])
    return np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)


def test_moving_the_slider_changes_alpha_as_the_service_says(page, stage):
    before = page.alpha()
    page.push('elevation', LEFT, PUSHES)  # from +z down
    wanted = ask(stage, force(90 - PUSHES, 0))
    assert abs(wanted - before) > 1.0
    until(lambda: page.alpha() == pytest.approx(wanted, abs=2e-3), f'alpha {wanted}')
    until(lambda: 'task set' in page.text('gq-reply'), 'the reply')
    page.push('azimuth', RIGHT, PUSHES)
    before, wanted = wanted, ask(stage, force(90 - PUSHES, PUSHES))
    assert abs(wanted - before) > 0.01
    until(lambda: page.alpha() == pytest.approx(wanted, abs=2e-3), f'alpha {wanted}')


def test_the_friction_slider_sets_the_friction_of_the_node(page, stage):
    page.push('friction', RIGHT, 10)
    until(lambda: 'friction set' in page.text('gq-reply'), 'the reply')
    wanted = ask(stage, force(90 - PUSHES, PUSHES))
    until(lambda: page.alpha() == pytest.approx(wanted, abs=2e-3), f'alpha {wanted}')


def test_a_dead_node_is_called_stale_and_a_new_one_is_found(page, stage):
    stage.node.popen.send_signal(signal.SIGKILL)
    stage.node.wait()
    until(lambda: page.kind() == 'stale', 'the word stale')
    assert 'STALE' in page.text('gq-status') and page.alpha() is None
    assert 'no contacts' in page.text('gq-table')
    stage.node = stage.start()
    stage.node.until_it_says('active')
    until(lambda: page.kind() == 'answer', 'an answer of the new node')


def test_a_page_that_is_looked_at_again_finds_a_new_viewer(page, stage, tmp_path):
    """
    The new one asks another node, by which its page is told from what the old one left there.

    A page that is looked at all the while tries once a second, which Chromium holds against it
    (docs/viewing.md), so that the time that a viewer takes to start would decide.
    """
    from page import start_viewer
    page.look_away()
    assert stage.viewer.end() == 0, stage.viewer.log()
    port = stage.address.rpartition(':')[2]
    stage.viewer, address = start_viewer(
        tmp_path / 'viewer.log', target_node='/page/another', port=port)
    assert address == stage.address and '/page/another' not in page.text('gq-status')
    page.look_back()
    until(lambda: '/page/another' in page.text('gq-status'), 'the page of the new viewer')
    assert page.kind() == 'stale' and page.alpha() is None
