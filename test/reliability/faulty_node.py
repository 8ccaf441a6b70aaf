# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The true node with a solver that fails on command, for the tests of injected faults.

What goes wrong stands in the file that SOLVER_FAULT names, and is read before every solve.
"""

import dataclasses
import os
from pathlib import Path
import sys
import threading
import time

from grasp_quality import clarabel_solver, kernel_solver, node
from grasp_quality.exceptions import SolverError
import numpy as np

FAULT = Path(os.environ['SOLVER_FAULT'])


def spoilt(raw, fault):
    """Return a RawAnswer that says SOLVED and is not true, or not even numbers."""
    shares, values, multipliers = raw.shares.copy(), raw.values.copy(), raw.multipliers.copy()
    if fault == 'nan':
        shares[0, 2] = np.nan
    elif fault == 'infinite':
        values[:] = np.inf
    elif fault == 'stronger':  # more alpha than the forces give
        values *= 1.001
    elif fault == 'unbalanced':
        shares[0, :2] += 1e-3
    elif fault == 'slipping':  # in balance, as the antipodal pair is, and outside the cones
        shares[:, :2] *= 1.01
        values *= 1.01
    elif fault == 'lopsided':
        shares[0] *= 0.999
    elif fault == 'unproved':  # true forces, and multipliers that prove nothing
        multipliers[:] = 0.0
    return dataclasses.replace(
        raw, shares=shares, values=values, multipliers=multipliers, status='Solved')


def faulty(run):
    """Wrap the one place where a solver is asked."""
    def answer(problem, *args, **options):
        fault, _, seconds = FAULT.read_text().partition(' ')
        if fault == 'raises':
            raise SolverError('injected: the solver failed', problem, 'injected')
        if fault == 'crashes':
            raise ZeroDivisionError('injected')
        if fault == 'slow':
            time.sleep(float(seconds))
        raw = run(problem, *args, **options)
        if fault == 'late':  # looks at its clock first, and then takes its time
            time.sleep(float(seconds))
        if fault == 'long' and threading.current_thread() is not threading.main_thread():
            print('injected: long', flush=True)  # a service's, not the live loop
            time.sleep(float(seconds))
        return raw if fault in ('none', 'slow', 'late', 'long') else spoilt(raw, fault)
    return answer


if __name__ == '__main__':
    clarabel_solver.run = faulty(clarabel_solver.run)
    kernel_solver.run = faulty(kernel_solver.run)
    sys.exit(node.main())
