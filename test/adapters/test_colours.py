# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Colours tell what they stand for without hue: lightness rises along the map."""

from msg_adapters.colours import alpha_colours, usage_colours, VIRIDIS
import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def test_colours_are_numbers_that_screens_have():
    for colours in (usage_colours(np.linspace(-1.0, 2.0, 31)), alpha_colours(range(7))):
        assert colours.shape[1] == 3
        assert (colours >= 0.0).all() and (colours <= 1.0).all()


def test_alpha_is_told_by_lightness_alone():
    lightness = alpha_colours(np.linspace(0.0, 5.0, 101)) @ LUMINANCE
    assert (np.diff(lightness) > 0.0).all()


def test_the_largest_alpha_is_the_brightest_whatever_its_size():
    for scale in (1e-6, 1.0, 1e6):
        colours = alpha_colours(scale * np.array([0.0, 1.0, 2.0]))
        np.testing.assert_array_equal(colours, alpha_colours([0.0, 1.0, 2.0]))


def test_nothing_is_the_darkest_and_the_largest_alpha_the_brightest():
    np.testing.assert_array_equal(alpha_colours([0, 3]), VIRIDIS[[0, -1]])


def test_a_map_of_nothing_is_dark_and_an_empty_one_is_empty():
    np.testing.assert_array_equal(alpha_colours([0.0, 0.0]), alpha_colours([0.0, 1.0])[[0, 0]])
    assert alpha_colours([]).shape == (0, 3)


def test_usage_beyond_the_cone_is_coloured_like_slip():
    np.testing.assert_array_equal(usage_colours([1.5]), usage_colours([1.0]))
    near, far = usage_colours([0.2, 1.0])
    assert far[0] - near[0] > 0.3 and near[2] - far[2] > 0.3
