# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Small parts of the viewer: requests that do not pile up, and objects that can be named."""

from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.viewer_controls import NewestOnly
from grasp_quality_hand.viewer_hand import known_object, object_mesh
from grasp_quality_hand.viewer_scene import map_mesh
from hypothesis import given, strategies
import numpy as np
import pytest
import trimesh


class Wire:
    """Requests that went out, and the functions that their answers go to."""

    def __init__(self):
        self.sent, self._done = [], []

    def request(self, name):
        def start(done):
            self.sent.append(name)
            self._done.append(done)
        return start

    def answer(self):
        self._done.pop(0)('answer')


@given(strategies.lists(strategies.booleans(), min_size=1, max_size=40))
def test_one_request_is_on_its_way_and_the_last_one_always_goes_out(moves):
    wire, newest, heard = Wire(), NewestOnly(), []
    for i, move in enumerate(moves):
        if move or not wire._done:
            newest.send(wire.request(i), heard.append)
            last = i
        else:
            wire.answer()
        assert len(wire._done) <= 1
    while wire._done:
        wire.answer()
    assert wire.sent[-1] == last and wire.sent == sorted(set(wire.sent))
    assert heard == ['answer'] * len(wire.sent)


def test_a_bad_answer_does_not_stop_the_next_request():
    wire, newest = Wire(), NewestOnly()

    def raise_it(answer):
        raise RuntimeError(answer)

    newest.send(wire.request('first'), raise_it)
    newest.send(wire.request('second'), str)
    with pytest.raises(RuntimeError):
        wire.answer()
    assert wire.sent == ['first', 'second']


def test_the_objects_of_the_simulated_hand_are_known():
    for name, wanted in OBJECTS.items():
        half_sizes = {'box': wanted.size, 'sphere': wanted.size * 3,
                      'cylinder': (wanted.size[0], *wanted.size)}[wanted.shape]
        mesh = object_mesh(known_object(name))
        np.testing.assert_allclose(mesh.extents / 2.0, half_sizes, rtol=1e-3)
    assert known_object('teapot') == 'none'


def test_an_object_may_be_a_mesh_file_or_nothing(tmp_path):
    path = tmp_path / 'part.stl'
    trimesh.creation.box((0.1, 0.2, 0.3)).export(path)
    np.testing.assert_allclose(object_mesh(str(path)).extents, (0.1, 0.2, 0.3), rtol=1e-6)
    assert object_mesh('') is None and object_mesh('none') is None


@pytest.mark.parametrize('text', [
    'box:1,2', 'box:1,2,-3', 'cylinder:1', 'box:a,b,c', 'sphere:0', 'sphere:', 'no_such_file.stl'])
def test_what_is_no_object_is_refused_with_the_rule(text):
    with pytest.raises(ValueError, match="object must be ''"):
        object_mesh(text)


def test_the_map_lets_light_through_and_keeps_its_colours():
    alphas = np.linspace(1.0, 2.0, 8)
    mesh = map_mesh(np.random.default_rng(0).normal(size=(8, 3)), 2, alphas)
    colours = mesh.visual.vertex_attributes['color']
    assert len(colours) == 8 and (colours[:, 3] < 255).all()
    assert mesh.visual.material.alphaMode == 'BLEND'
    assert mesh.export(file_type='glb').startswith(b'glTF')
