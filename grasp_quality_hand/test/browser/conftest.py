# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A real node, the viewer and a headless Chromium that looks at its page."""

import os
from pathlib import Path
import shutil
import sys
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / 'test' / 'node'))
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'

NAMES = (('chromium', 'chromium-browser', 'google-chrome'), ('chromedriver',))


@pytest.fixture(scope='session')
def browser_files():
    """Return the paths of Chromium and its driver; fail with the way out where there are none."""
    found = [next(filter(None, map(shutil.which, names)), None) for names in NAMES]
    if None in found:
        pytest.fail(
            'no Chromium with ChromeDriver on this machine, which the page is tested in: run '
            'scripts/browser.sh as root, or install the packages chromium and chromium-driver',
            pytrace=False)
    return found


@pytest.fixture(scope='module')  # it draws as long as it is there
def browser(browser_files, tmp_path_factory):
    """Start Chromium with software rendering."""
    from page import open_browser

    driver = open_browser(*browser_files, tmp_path_factory.mktemp('profile'), slow_screen=True)
    yield driver
    driver.quit()


@pytest.fixture(scope='module')
def ros_log_dir(tmp_path_factory):
    """Keep the log files of ROS out of the home directory."""
    os.environ['ROS_LOG_DIR'] = str(tmp_path_factory.mktemp('ros'))


@pytest.fixture(scope='module')
def stage(ros_log_dir, tmp_path_factory):
    """Start node and viewer, and a client that feeds contacts and asks what the page shows."""
    from harness import Client, start_node
    from page import start_viewer

    folder = tmp_path_factory.mktemp('stage')

    def start():
        return start_node(folder / 'node.log', '/page', max_contact_age='5.0',
                          task_wrench='[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]', map_directions='648',
                          display_time_share='0.2')

    node = start()
    viewer, address = start_viewer(folder / 'viewer.log', target_node='/page/grasp_quality',
                                   object='box:0.04,0.04,0.04')
    node.until_it_says('active')
    client = Client('/page')
    begun = SimpleNamespace(node=node, viewer=viewer, address=address, client=client, start=start)
    yield begun
    client.close()
    for process in (begun.viewer, begun.node):
        if process.popen.poll() is None:
            assert process.end() == 0, process.log()
    assert 'Traceback' not in begun.viewer.log() and 'Error' not in begun.viewer.log()
