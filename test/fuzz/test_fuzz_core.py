# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Any numbers at all to the core: a refusal that names them, or an answer of finite numbers."""

import warnings

from grasp_quality import (
    Contact, ContactModel, evaluate, force_closure, Grasp, GraspQualityError, JointLimits,
    minimum_forces, TaskCone, TaskPolytope, TaskWrench, wrench_map)
from hypothesis import given, settings, strategies as st
import numpy as np

settings.load_profile('the same every time')
ODD = (0.0, -0.0, 5e-324, 1e-300, 1e-160, 1e-60, 1e-50, 1e-12, 1.0, -1.0, 1e3, 1e12, 1e50, 1e51,
       1e160, 1e300, np.nan, np.inf, -np.inf)
odd = st.sampled_from(ODD) | st.floats()
usual = st.floats(-1.0, 1.0)
number = usual | usual | usual | odd
words = st.sampled_from(('', 'a', 'b', 'a\nb', '\0', '\ud800', 'x' * 300)) | st.text(max_size=4)


def vector(size):
    return st.lists(number, min_size=size, max_size=size)


@st.composite
def contacts(draw):
    return {
        'position': draw(vector(3)), 'normal': draw(vector(3)),
        'model': draw(st.sampled_from([*ContactModel, 'PCWF', None]) if draw(
            st.integers(0, 9)) == 0 else st.sampled_from(ContactModel)),
        'friction': abs(draw(number)), 'torsional_friction': abs(draw(number)),
        'max_normal_force': abs(draw(number)), 'name': draw(words), 'finger': draw(words)}


def numbers_of(answer):
    names = ('alpha', 'alpha_upper', 'alpha_lower', 'wrench', 'forces', 'cone_usage',
             'dalpha_dexternal_wrench', 'dalpha_dmax_force', 'dalpha_dfriction')
    return [np.asarray(getattr(answer, name)) for name in names]


@settings(max_examples=300)
@given(st.lists(contacts(), max_size=4), st.sampled_from(('linf', 'l1', 'l2', 'finger', 'l3')),
       vector(6), vector(6), st.sampled_from((0.0, 0.0, 0.1)) | odd)
def test_any_numbers_are_refused_or_answered_with_numbers(items, bound, wrench, load, weight):
    with warnings.catch_warnings():
        warnings.simplefilter('error', RuntimeWarning)
        try:
            grasp = Grasp([Contact(**fields) for fields in items], bound)
            answer = evaluate(grasp, TaskWrench(wrench), load, weight, time_limit_s=20.0)
        except GraspQualityError as exc:
            assert str(exc)
            return
    assert all(np.isfinite(value).all() for value in numbers_of(answer))
    assert answer.feasible or not answer.alpha
    if answer.feasible:
        assert (grasp.max_normal_forces >= answer.forces[:, 2] * (1.0 - 1e-9)).all()


@settings(max_examples=60)
@given(st.lists(contacts(), min_size=1, max_size=3), vector(6), vector(6), number, number)
def test_other_measures_are_refused_or_answered_with_numbers(items, first, second, angle, torque):
    with warnings.catch_warnings():
        warnings.simplefilter('error', RuntimeWarning)
        for ask in (
                lambda g: evaluate(g, TaskCone(first, second, [0, 0, 1, 0, 0, 0], abs(angle),
                                               surface_samples=4)).alpha_worst,
                lambda g: evaluate(g, TaskPolytope([first, second])).quality,
                lambda g: wrench_map(g, [first, second]).alpha,
                lambda g: force_closure(g).margin,
                lambda g: minimum_forces(g, first).violation,
                lambda g: evaluate(Grasp(g.contacts, 'linf', JointLimits(
                    ['j'], [torque], np.reshape([*first, *second], (1, 3, 4))[:, :len(g)])),
                    TaskWrench(second)).alpha):
            try:
                value = ask(Grasp([Contact(**fields) for fields in items]))
            except GraspQualityError as exc:
                assert str(exc)
            else:
                assert np.isfinite(value).all()
