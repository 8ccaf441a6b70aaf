# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What looking costs: the live loop with and without the viewer and its page, in turns.

Node, viewer, Chromium and the client that plays the hand are processes of this one machine, and
the browser draws in software. With the lowest priority it takes only what the others leave, as a
browser on another machine, or with a graphics card, would.

"""

import os
from pathlib import Path
import shutil
import signal
import sys
import tempfile
import time

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / 'test' / 'node'), str(ROOT / 'grasp_quality_hand' / 'test' / 'browser')]

from benchmarks import document  # noqa: E402
from benchmarks.node import cpu_s  # noqa: E402
from geometry_msgs.msg import PoseArray  # noqa: E402
from grasp_quality_msgs.msg import ForceMap, GraspQuality, ResultCode  # noqa: E402
from grasps import EIGHT, pose_array  # noqa: E402
from harness import BEST_EFFORT, Client, start_node  # noqa: E402
from msg_adapters.stamps import stamp_ns  # noqa: E402
import numpy as np  # noqa: E402
from page import open_browser, Page, start_viewer, until  # noqa: E402

RATE_HZ, LIVE_S, TURNS = 200.0, 8.0, 2
DIRECTIONS = 2592
WATCHERS = {  # who watches: (page in a browser, browser of lowest priority)
    'viewer': (False, False), 'viewer, page at lowest priority': (True, True),
    'viewer, page on the same cores': (True, False)}
TARGET = '/view/grasp_quality'
TASK = '[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]'


class Hand:
    """Publishes eight contacts at a steady rate, and hears what becomes of them."""

    def __init__(self, client, node):
        self._client, self._node = client, node
        self._contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
        self._heard = client.listen(GraspQuality, 'quality')
        self._message = pose_array(EIGHT)

    def play(self, seconds, during=lambda: None):
        """Return answers a second, the share of contacts answered and the node's use of a core."""
        self._heard.clear()
        sent = set()
        begin, used = time.perf_counter(), cpu_s(self._node.popen.pid)
        for i in range(int(RATE_HZ * seconds)):
            due = begin + i / RATE_HZ
            while (left := due - time.perf_counter()) > 0.0:
                self._client.spin_once(left)
            self._message.header.stamp = self._client.now()
            sent.add(stamp_ns(self._message.header.stamp))
            self._contacts.publish(self._message)
            during()
        elapsed = time.perf_counter() - begin
        used = cpu_s(self._node.popen.pid) - used
        answered = sent & {stamp_ns(m.header.stamp) for m in self._heard
                           if m.result.code == ResultCode.OPTIMAL}
        return len(answered) / elapsed, len(answered) / len(sent), used / elapsed


class Watched:
    """The viewer, and a browser on its page where there is one to be had."""

    def __init__(self, folder, page, polite=False):
        self.viewer, address = start_viewer(
            folder / 'viewer.log', target_node=TARGET, object='box:0.06,0.04,0.04')
        self.browser = self.page = None
        if page:
            self.browser = open_browser(
                shutil.which('chromium'), _driver(folder, polite), folder / 'profile')
            begin = time.perf_counter()
            self.page = Page(self.browser, address)
            until(lambda: self.page.kind() is not None, 'the page')
            self.up_s = time.perf_counter() - begin

    def close(self):
        """End browser and viewer."""
        if self.browser is not None:
            self.browser.quit()
        self.viewer.end()


def measure():
    """Measure everything; return the lines of the section."""
    if not (shutil.which('chromium') and shutil.which('chromedriver')):
        raise RuntimeError('no Chromium with ChromeDriver to show the page in: run '
                           'scripts/browser.sh as root')
    machine = document.machine()
    folder = Path(tempfile.mkdtemp())
    os.environ['ROS_LOG_DIR'] = str(folder / 'ros')
    node = start_node(folder / 'node.log', '/view', max_contact_age='1.0', task_wrench=TASK,
                      map_directions=str(DIRECTIONS))
    node.until_it_says('active')
    client = Client('/view')
    try:
        hand = Hand(client, node)
        hand.play(2.0)
        results = {name: [] for name in ('nobody watches', *WATCHERS)}
        facts = {}
        for _ in range(TURNS):
            results['nobody watches'].append(hand.play(LIVE_S))
            for name, (page, polite) in WATCHERS.items():
                results[name].append(_watched(hand, Watched(folder, page, polite), facts))
        facts['maps'] = _maps(client, hand)
        facts['stale'] = _stale(hand, folder, node)
    finally:
        client.close()
        if node.popen.poll() is None:
            node.end()
    return section(results, facts, machine)


def _watched(hand, watched, facts):
    """Play to somebody who watches; note how long the page took and how often it changes."""
    try:
        hand.play(3.0)
        first, begin = watched.page and watched.page.updates(), time.perf_counter()
        result = hand.play(LIVE_S)
        if watched.page is not None:
            updates = (watched.page.updates() - first) / (time.perf_counter() - begin)
            facts.setdefault('up', []).append(watched.up_s)
            facts.setdefault('updates', []).append(updates)
        return result
    finally:
        watched.close()


def _driver(folder, polite):
    """Return the driver, which Chromium inherits its priority from."""
    driver = shutil.which('chromedriver')
    if polite:
        script = folder / 'chromedriver'
        script.write_text(f'#!/bin/sh\nexec nice -n 19 {driver} "$@"\n')
        script.chmod(0o755)
        return str(script)
    return driver


def _maps(client, hand):
    """Return the seconds between two maps that somebody hears."""
    heard = client.listen(ForceMap, 'force_map')
    arrivals = []

    def look():
        while heard:
            if len(heard.pop(0).alphas) == DIRECTIONS:
                arrivals.append(time.perf_counter())

    hand.play(12.0, look)
    return float(np.median(np.diff(arrivals))) if len(arrivals) > 1 else float('nan')


def _stale(hand, folder, node):
    """Return the seconds from the node's death to the word stale on the page."""
    watched = Watched(folder, True)
    try:
        hand.play(2.0)
        node.popen.send_signal(signal.SIGKILL)
        begin = time.perf_counter()
        node.wait()
        until(lambda: watched.page.kind() == 'stale', 'the word stale')
        return time.perf_counter() - begin
    finally:
        watched.close()


def section(results, facts, machine):
    """Write the section as Markdown."""
    medians = {name: np.median(np.array(values), axis=0) for name, values in results.items()}
    alone = medians['nobody watches'][0]
    rows = [(name, f'{rate:.1f}', f'{100 * share:.1f} %', f'{100 * (1 - rate / alone):.1f} %',
             f'{core:.2f}') for name, (rate, share, core) in medians.items()]
    return '\n'.join([
        '## Looking at it', '',
        f'{len(EIGHT)} contacts at {RATE_HZ:.0f} Hz, map of {DIRECTIONS:,} directions, turns of '
        f'{LIVE_S:.0f} s; Chromium draws in software on the same cores; {machine}', '',
        document.table(['who watches', 'answers a second', 'contacts answered', 'fall of the rate',
                        'core used by the node'], rows), '',
        f'The page is up {max(facts["up"]):.1f} s after it is asked for (slowest), shows '
        f'{min(facts["updates"]):.1f} to {max(facts["updates"]):.1f} updates a second, and says '
        f'stale {facts["stale"]:.2f} s after the node is killed; a new map comes every '
        f'{facts["maps"]:.2f} s.'])
