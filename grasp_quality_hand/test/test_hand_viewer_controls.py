# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The page's controls, moved through the websocket that any page in a browser can open.

What the server would ask the node for is collected instead of sent.
"""

import asyncio
import time

from geometry_msgs.msg import Vector3, Wrench
from grasp_quality_hand.viewer_controls import Controls
from grasp_quality_msgs.msg import GraspQuality
from msg_adapters.wrenches import to_wrench, wrench_array
import msgspec
import pytest
import viser
import websockets
import zstandard

LOAD = (0.5, 0.0, -2.0, 0.0, 0.01, 0.0)
OTHER_LOAD = (0.0, 0.0, -3.0, 0.0, 0.0, 0.0)
UP = Wrench(force=Vector3(z=1.0))
CAMERA = {'type': 'ViewerCameraMessage', 'wxyz': [1.0, 0.0, 0.0, 0.0],
          'position': [0.1, 0.1, 0.1], 'fov': 1.0, 'near': 0.01, 'far': 100.0,
          'look_at': [0.0, 0.0, 0.0], 'up_direction': [0.0, 0.0, 1.0], 'image_height': 100,
          'image_width': 100}
LABELS = {'azimuth [deg]', 'friction [-]', 'load [N]'}
ENOUGH_S = 1.0  # for what was sent to be acted upon


class Asked:
    """Keeps what the controls ask for, and answers nothing wrong with it."""

    def __init__(self):
        self.loads, self.numbers = [], []

    def call(self, kind, name, request, done):
        self.loads.append(tuple(wrench_array(request.external_wrench, 'load')))
        done(None)

    def set_number(self, target, name, value, done):
        self.numbers.append(value)
        done('')


class Page:
    """A server of its own with the controls, and the moves of a foreign page."""

    def __init__(self, enabled):
        self.server = viser.ViserServer(host='127.0.0.1', port=0, verbose=False)
        self.asked = Asked()
        self.controls = Controls(self.server, self.asked, '/grasp_quality', enabled)

    def evaluated(self, load, task=UP):
        """Let the page hear an evaluation."""
        self.controls.follow(GraspQuality(
            task_wrench=task, external_wrench=to_wrench(load)), 0.5)

    def move(self, **moves):
        """Move controls, by the first word of their labels, as a page of elsewhere."""
        asyncio.run(self._move(moves))

    async def _move(self, moves):
        async with websockets.connect(
                f'ws://127.0.0.1:{self.server.get_port()}', origin='http://elsewhere.example',
                subprotocols=[f'viser-v{viser.__version__}'], max_size=None) as socket:
            ids = {}
            end = time.monotonic() + 20.0
            while not set(ids) >= LABELS:
                assert time.monotonic() < end, f'only {sorted(ids)} came'
                ids.update(labelled(unpacked(await asyncio.wait_for(socket.recv(), 20.0))))
            await socket.send(msgspec.msgpack.encode(CAMERA))
            await asyncio.sleep(0.3)
            for word, value in moves.items():
                label, = (label for label in ids if label.startswith(word))
                await socket.send(msgspec.msgpack.encode({
                    'type': 'GuiUpdateMessage', 'uuid': ids[label], 'updates': {'value': value}}))
                await asyncio.sleep(0.1)
            await asyncio.sleep(ENOUGH_S)


def unpacked(data):
    """Return the messages of viser in one of the websocket."""
    size, packed = (int.from_bytes(data[i:i + 8], 'little') for i in (0, 8))
    return msgspec.msgpack.decode(zstandard.ZstdDecompressor().decompress(
        data[16:16 + packed], max_output_size=size))['messages']


def labelled(messages):
    """Return the identifiers of controls by label."""
    return {m['props']['label']: m['uuid'] for m in messages
            if isinstance(m.get('props'), dict) and m['props'].get('label') and 'uuid' in m}


@pytest.fixture
def page(request):
    """Return a page, enabled or not."""
    made = Page(request.param)
    yield made
    made.server.stop()


@pytest.mark.parametrize('page', [False], indirect=True)
def test_controls_that_are_not_enabled_send_nothing_whoever_moves_them(page):
    page.evaluated(LOAD)
    page.move(azimuth=90.0, friction=2.0, load=[9.0, 0.0, 0.0])
    assert page.asked.loads == [] and page.asked.numbers == []


@pytest.mark.parametrize('page', [True], indirect=True)
def test_a_moved_slider_keeps_the_load_that_the_node_has(page):
    page.evaluated(LOAD)
    page.move(azimuth=90.0)
    page.evaluated(OTHER_LOAD)  # by a controller, long after the first touch
    page.move(azimuth=45.0, friction=1.5)
    assert page.asked.loads == [LOAD, OTHER_LOAD] and page.asked.numbers == [1.5]


@pytest.mark.parametrize('page', [True], indirect=True)
def test_a_load_that_is_set_here_goes_out_with_the_torque_there_is(page):
    page.evaluated(LOAD)
    page.move(load=[1.0, 0.0, 0.0], azimuth=90.0)  # before the node is heard to have it
    assert page.asked.loads == 2 * [(1.0, 0.0, 0.0, *LOAD[3:])]


@pytest.mark.parametrize('page', [True], indirect=True)
def test_no_task_takes_away_a_load_that_is_not_known(page):
    page.move(azimuth=90.0)
    page.evaluated(LOAD)
    page.evaluated((0.0,) * 6, Wrench())  # a failure that evaluated nothing
    page.move(azimuth=45.0)
    assert page.asked.loads == []
    page.move(load=[0.0, 0.0, -1.0])
    assert page.asked.loads == [(0.0, 0.0, -1.0, 0.0, 0.0, 0.0)]
