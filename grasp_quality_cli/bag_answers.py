# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples to answers: many at a time where the task is one wrench, else one after the other.

The batch is what makes a long bag quick; every answer carries the same proof either way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from grasp_quality import evaluate, friction_cone, GraspQualityError, SolverError, TaskWrench
from grasp_quality.governing import governing
from grasp_quality.many import evaluate_many, Outcome
from grasp_quality.node_scene import measured_margin, Scene
from grasp_quality.status import Status
from grasp_quality_cli.bag_inputs import Sample
from grasp_quality_cli.grasp_file import Task
from msg_adapters.result_codes import Code, error_code, status_code
import numpy as np
from numpy.typing import NDArray

NOTHING: NDArray[np.float64] = np.zeros((0, 4))
UNPROVED = 'no solver gave an answer that its proof confirms'


@dataclass
class Answered:
    """
    The answer to one sample.

    Attributes
    ----------
    sample : Sample
    code : Code
    message : str
        Why, where it is not OPTIMAL.
    alpha : float
        0 on anything but OPTIMAL.
    alpha_upper : float or None
    friction_margin : float
    measured_margin : float or None
        Least slip margin of the measured forces; None where nothing was measured.
    forces : (k, 4) array [N, N, N, N m]
        [t1, t2, n, m_n] in the contact frames; (0, 4) on anything but OPTIMAL.
    cone_usage : (k,) array

    """

    sample: Sample
    code: Code
    message: str = ''
    alpha: float = 0.0
    alpha_upper: float | None = None
    friction_margin: float = 0.0
    measured_margin: float | None = None
    forces: NDArray[np.float64] = field(default_factory=lambda: NOTHING)
    cone_usage: NDArray[np.float64] = field(default_factory=lambda: NOTHING[:, 0])


def answered(samples: Sequence[Sample], barrier_weight: float) -> list[Answered]:
    """Answer samples in their order; errors become codes, as in the node."""
    batch = [i for i, sample in enumerate(samples)
             if sample.scene is not None and isinstance(sample.task, TaskWrench)
             and sample.scene.grasp.joint_limits is None]  # the batch does not know them
    found: dict[int, Answered] = {}
    if batch:
        try:
            found = dict(zip(batch, _many([samples[i] for i in batch], barrier_weight)))
        except GraspQualityError:
            pass  # one spoils the batch: asked one by one, each gets what is its own
    return [found[i] if i in found else _one(sample, barrier_weight)
            for i, sample in enumerate(samples)]


def _many(samples: Sequence[Sample], barrier_weight: float) -> list[Answered]:
    """Answer samples with a scene and a task wrench."""
    scenes = [_question(sample)[0] for sample in samples]
    loads = [np.zeros(6) if sample.load is None else sample.load for sample in samples]
    tasks = [sample.task.wrench for sample in samples if isinstance(sample.task, TaskWrench)]
    many = evaluate_many([scene.grasp for scene in scenes], np.array(tasks), np.array(loads),
                         barrier_weight, forces=True)
    rows = []
    for i, (sample, scene) in enumerate(zip(samples, scenes)):
        outcome = Outcome(many.status[i])
        if outcome is Outcome.UNPROVED:
            rows.append(_failed(sample, SolverError(UNPROVED)))
            continue
        code, words = status_code(Status[outcome.name])
        forces = NOTHING if many.forces is None or code is not Code.OPTIMAL else (
            many.forces[i, :len(scene.grasp)])
        rows.append(_row(sample, scene, code, words, float(many.alpha[i]),
                         float(many.alpha_upper[i]), forces))
    return rows


def _one(sample: Sample, barrier_weight: float) -> Answered:
    """Answer one sample by itself."""
    if sample.error is not None:
        return _failed(sample, sample.error)
    try:
        scene, task = _question(sample)
        answer = evaluate(scene.grasp, task, sample.load, barrier_weight)
        solution, _ = governing(task, answer)
        code, words = status_code(solution.status, remark=solution.remark)
        return _row(sample, scene, code, words, solution.alpha, solution.alpha_upper,
                    solution.forces)
    except Exception as exc:  # a boundary: one bad sample never ends the reading
        return _failed(sample, exc)


def _question(sample: Sample) -> tuple[Scene, Task]:
    if sample.scene is None or sample.task is None:
        raise ValueError('a sample without an error has a scene and a task')
    return sample.scene, sample.task


def _failed(sample: Sample, error: Exception) -> Answered:
    return Answered(sample, *error_code(error))


def _row(sample: Sample, scene: Scene, code: Code, words: str, alpha: float, alpha_upper: float,
         forces: NDArray[np.float64]) -> Answered:
    optimal = code is Code.OPTIMAL
    usage = friction_cone.usage(forces, scene.grasp.scales, scene.grasp.max_normal_forces) \
        if optimal else NOTHING[:, 0]
    return Answered(
        sample, code, words, alpha if optimal else 0.0, alpha_upper if optimal else None,
        1.0 - float(usage.max()) if optimal else 0.0, measured_margin(scene), forces, usage)
