# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Every error of the library can be caught as one, and input errors as ValueError too."""

from grasp_quality import exceptions
import pytest


@pytest.mark.parametrize('name, habit', [
    ('InvalidContactError', ValueError), ('InvalidGraspError', ValueError),
    ('InvalidTaskError', ValueError), ('SolverError', RuntimeError),
    ('SolverTimeoutError', RuntimeError)])
def test_base_classes(name, habit):
    error = getattr(exceptions, name)
    assert issubclass(error, exceptions.GraspQualityError) and issubclass(error, habit)


def test_solver_error_carries_problem_and_status():
    error = exceptions.SolverError('message', problem='problem', status='Stalled')
    assert (str(error), error.problem, error.status) == ('message', 'problem', 'Stalled')
    assert issubclass(exceptions.SolverTimeoutError, exceptions.SolverError)
