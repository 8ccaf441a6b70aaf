# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The whole way without ROS: contacts in, alpha and forces out, and what would make the grasp better.

    . ./env.sh && python3 examples/python_only.py

Two fingers pinch a 4 cm cube that weighs 2 N, with friction 0.5 and at most 10 N each.

"""

from grasp_quality import Contact, evaluate, explain, Grasp, hold_forces, TaskWrench

WEIGHT = [0.0, 0.0, -2.0, 0.0, 0.0, 0.0]  # [fx, fy, fz, tx, ty, tz], N and N m
LIFT = [0.0, 0.0, 2.0, 0.0, 0.0, 0.0]     # what the fingers shall apply: the weight, upward

grasp = Grasp([
    Contact((-0.02, 0.0, 0.0), normal=(1.0, 0.0, 0.0), friction=0.5, max_normal_force=10.0,
            name='left'),
    Contact((0.02, 0.0, 0.0), normal=(-1.0, 0.0, 0.0), friction=0.5, max_normal_force=10.0,
            name='right')])

answer = evaluate(grasp, TaskWrench(LIFT))
print(f'alpha = {answer.alpha:.4f} times the weight, limited by '
      f'{" and ".join(answer.limited_by)}')

held = hold_forces(grasp, external_wrench=WEIGHT)
if not held.feasible:
    raise SystemExit('the grasp cannot hold the weight')
for name, (_, _, normal, _), usage in zip(grasp.names, held.forces, held.cone_usage):
    print(f'{name}: press with {normal:.3f} N, {100 * usage:.0f} % of the friction cone in use')

print(explain(grasp, TaskWrench(LIFT)).text)
