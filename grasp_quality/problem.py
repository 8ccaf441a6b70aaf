# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Build: a grasp and a task as one conic program in standard form.

    maximise c . u   subject to   E u = e,   u in K

u holds, for every contact, its force as shares [t1/mu, t2/mu, n, m_n/gamma] / f_max in a standard
second-order cone (or a half line when it is frictionless), the slacks of the force bound and of
the joints' limits, and the task. The task is a virtual contact (the paper, section IV): its
columns stand with a minus sign beside the grasp matrix. The first six equations are the
equilibrium G x + F_ext = alpha F, about the contacts' centre, in shares of lever arm and largest
cap; then comes the bound, and last the joints' limits |T x + tau_g| <= tau_max, two each.

Which variable stands where depends on the contact models and the bound only, so ``layout`` caches
it; building is then one gather of numbers. Nothing here knows of a solver.
"""

from dataclasses import dataclass, field
from functools import cached_property

from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import Array, frozen
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.layout import Cones, Layout, layout_of
from grasp_quality.task import TaskCone, TaskWrench
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike

NO_WRENCH = as_wrench(np.zeros(6))
NO_WRENCHES = frozen(np.zeros((0, 6)))


@dataclass(frozen=True, eq=False)
class VirtualContact:
    """
    A task, or another unknown of the program, as columns beside the grasp matrix.

    Parameters
    ----------
    columns : (6, t) array
        Scaled wrench of each variable, as it stands in equilibrium: G x + F_ext = columns v.
    is_cone : bool
        True: v lies in a second-order cone, first component the axis; False: v >= 0.
    objective : (t,) array
        Worth of each variable, to be maximised.
    unit : float
        Physical size of v = 1 (so alpha = unit v for a task wrench).
    role : str
        'task'; 'pressing': v is also a normal force common to all contacts, as a share of their
        caps; 'widening': v takes no part in equilibrium and is what the bound allows.
    wrenches : (t, 6) array [N, N m], optional
        Task wrench that one physical unit of each variable applies, about the origin.

    """

    columns: Array
    is_cone: bool
    objective: Array
    unit: float = 1.0
    role: str = 'task'
    wrenches: Array = field(default_factory=lambda: NO_WRENCHES)


@dataclass(frozen=True, eq=False)
class ConicProblem:
    """
    One conic program with the scaling that made it; see the module's text for the form.

    Parameters
    ----------
    grasp : Grasp
    virtual : VirtualContact
    external_wrench : (6,) array [N, N m]
    layout : Layout
        Which variable and equation stands where.

    """

    grasp: Grasp
    virtual: VirtualContact
    external_wrench: Array
    layout: Layout

    @cached_property
    def scaled_external_wrench(self) -> Array:
        """External wrench (6,) in the scaled units of the equilibrium."""
        if not self.external_wrench.any():
            return NO_WRENCH
        return self.grasp.scaled_wrench(self.external_wrench)

    @cached_property
    def equation_values(self) -> Array:
        """E's stored entries, row by row, as the layout orders them."""
        columns = np.concatenate(
            [-self.grasp.scaled_matrix.reshape(6, -1), self.virtual.columns], axis=1)
        return np.concatenate([columns[:, self.layout.source].ravel(),
                               self.layout.bound_entries, *self._joint_entries()])

    def _joint_entries(self) -> list[Array]:
        joints = self.grasp.joint_rows
        if joints is None:
            return []
        line = np.column_stack([joints.A, np.ones(len(joints.b)), joints.pressing + joints.b,
                                2.0 * joints.b])  # (j, 4 k + 3)
        return [line[:, source].ravel() for source in self.layout.joint_sources]

    @cached_property
    def E(self) -> Array:
        """Left side of the equations (rows, variables), dense, to look at and to test with."""
        E = np.zeros(self.layout.shape)
        for row in range(E.shape[0]):
            span = slice(*self.layout.row_starts[row:row + 2])
            E[row, self.layout.row_columns[span]] = self.equation_values[span]
        return E

    @cached_property
    def e(self) -> Array:
        """Right side of the equations (rows,)."""
        joints = self.grasp.joint_rows
        limits = [] if joints is None else [joints.b - joints.g, 2.0 * joints.b]
        return np.concatenate([self.scaled_external_wrench, self.layout.bound_right, *limits])

    @cached_property
    def c(self) -> Array:
        """Objective (variables,)."""
        objective = np.zeros(self.layout.shape[1])
        objective[self.layout.virtual] = self.virtual.objective
        return objective

    @property
    def cones(self) -> Cones:
        """K as (kind, dimension) in the order of u; kind is 'nonnegative' or 'second_order'."""
        return self.layout.cones

    @property
    def reach(self) -> float:
        """Largest scaled force that the caps alone would allow; alpha's natural size, a0."""
        return self.grasp.cap_total


def build_problem(grasp: Grasp, task: TaskWrench | TaskCone,
                  external_wrench: ArrayLike | None = None) -> ConicProblem:
    """
    State a task wrench or a task cone as a conic program.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    task : TaskWrench or TaskCone
        About the object frame's origin [N, N m].
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object besides the fingers, about the object frame's origin.

    Returns
    -------
    ConicProblem

    Raises
    ------
    InvalidGraspError, InvalidTaskError

    """
    require_grasp(grasp)
    if isinstance(task, TaskWrench):
        wrenches = task.wrench[None]
    elif isinstance(task, TaskCone):
        spread = np.tan(task.half_angle)
        wrenches = np.stack([task.axis, spread * task.lateral_x, spread * task.lateral_y])
    else:
        raise InvalidTaskError(
            f'build_problem takes a TaskWrench or a TaskCone, got {type(task).__name__}: evaluate '
            'a polytope or an ellipsoid with evaluate()')
    columns = grasp.scaled_wrench(wrenches).T  # (6, t)
    size = float(np.sqrt(columns[:, 0] @ columns[:, 0]))
    objective = np.zeros(len(wrenches))
    objective[0] = 1.0
    virtual = VirtualContact(
        columns / size, len(wrenches) > 1, objective, unit=1.0 / size, wrenches=wrenches)
    return assemble(grasp, virtual, external_wrench)


def assemble(grasp: Grasp, virtual: VirtualContact,
             external_wrench: ArrayLike | None = None) -> ConicProblem:
    """Put a grasp and a virtual contact together; ``build_problem`` is the way for tasks."""
    if external_wrench is None:
        load = NO_WRENCH
    else:
        load = as_wrench(external_wrench, 'external_wrench')
    active = grasp.scales > 0.0
    layout = layout_of(
        active.tobytes(), grasp.groups, grasp.bound == 'l2',
        virtual.columns.shape[1], virtual.is_cone, virtual.role,
        0 if grasp.joint_limits is None else len(grasp.joint_limits))
    return ConicProblem(grasp, virtual, load, layout)
