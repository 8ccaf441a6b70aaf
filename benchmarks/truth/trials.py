# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""All trials, in processes of their own, and what is kept of each."""

from concurrent.futures import as_completed, ProcessPoolExecutor
from dataclasses import dataclass, field, replace
import multiprocessing
import os
import sys
from typing import Any

from benchmarks.truth.cases import random_case
from benchmarks.truth.dclaw_trials import dclaw_pull, DClawRig, directions
from benchmarks.truth.point_trials import optimised_pull, passive_pull, PassivePull
from benchmarks.truth.references import four_edged_alpha, held_interval
from benchmarks.truth.slow_pull import Pulled
from grasp_quality import ContactModel, evaluate, Grasp, TaskWrench
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
WRONG = 0.1                  # share by which the friction of the negative controls is off
NOTHING = 1e-6               # share of a load that counts as no prediction
DIRECTIONS = 32
CHUNKS = 4                   # jobs for the directions of one object


@dataclass(frozen=True)
class PointResult:
    """
    What one case has shown on the contact-point hand.

    Attributes
    ----------
    text : str
        The case.
    too_sensitive : int
        Draws before it that were given up because alpha could not be measured.
    optimised : Pulled
    passive : PassivePull or None
    wrong : tuple of float
        Ratio of the passive pull to predictions with too much friction, and with too little; nan
        for none.
    four_edges : tuple of float
        Ratio of the optimised and of the passive pull to predictions with four-edged cones.

    """

    text: str
    too_sensitive: int
    optimised: Pulled
    passive: PassivePull | None
    wrong: tuple[float, float]
    four_edges: tuple[float, float]


@dataclass
class Results:
    """Everything that was measured; D'Claw's pulls by object and contact model."""

    points: list[PointResult] = field(default_factory=list)
    dclaw: dict[str, list[Pulled]] = field(default_factory=dict)

    @property
    def passive(self) -> list[PassivePull]:
        """Return the pulls with constant normal forces."""
        return [point.passive for point in self.points if point.passive is not None]


def point_result(index: int, seed: int) -> PointResult:
    """Make all pulls of one case, and all predictions of the negative controls."""
    case = random_case(index, seed)
    optimised, passive = optimised_pull(case), passive_pull(case)
    edged = _ratio(optimised.load, four_edged_alpha(optimised.grasp, case.task))
    if passive is None:
        return PointResult(case.text, case.too_sensitive, optimised, None, (np.nan, np.nan),
                           (edged, np.nan))
    grasp, load = passive.pulled.grasp, passive.pulled.load
    if passive.at_optimum:    # then the wrong prediction, too, is an alpha
        more, less = (evaluate(_with_friction(grasp, 1.0 + sign * WRONG),
                               TaskWrench(case.task)).alpha for sign in (1.0, -1.0))
        four = four_edged_alpha(grasp, case.task)
    else:
        more, less = (held_interval(_with_friction(grasp, 1.0 + sign * WRONG), passive.normals,
                                    case.task)[1] for sign in (1.0, -1.0))
        four = held_interval(grasp, passive.normals, case.task, four_edges=True)[1]
    return PointResult(case.text, case.too_sensitive, optimised, passive,
                       (_ratio(load, more), _ratio(load, less)), (edged, _ratio(load, four)))


def _ratio(load: float, prediction: float) -> float:
    """Return load over prediction; infinite when nothing is predicted to hold."""
    return load / prediction if prediction > NOTHING * load else np.inf


def _with_friction(grasp: Grasp, factor: float) -> Grasp:
    """Return the grasp with all friction multiplied."""
    return Grasp([replace(contact, normal=None, friction=factor * contact.friction,
                          torsional_friction=factor * contact.torsional_friction)
                  for contact in grasp.contacts], grasp.bound)


def dclaw_results(name: str, model: str, ways: Array) -> list[Pulled]:
    """Pull on an object in D'Claw along unit vectors (n, 3)."""
    rig = DClawRig(name, ContactModel[model])
    return [dclaw_pull(rig, way) for way in ways]


def run(cases: int, seed: int, ways: dict[tuple[str, str], int]) -> Results:
    """
    Run everything on all cores.

    Parameters
    ----------
    cases : int
        Of the contact-point hand.
    seed : int
        Of the cases.
    ways : dict
        (object, contact model) -> number of directions.

    """
    results = Results(dclaw={f'{name}, {model}': [] for name, model in ways})
    context = multiprocessing.get_context('spawn')
    with ProcessPoolExecutor(os.cpu_count(), mp_context=context) as pool:
        jobs: dict[Any, str] = {}
        for (name, model), count in ways.items():
            for chunk in np.array_split(directions(count), min(CHUNKS, count)):
                jobs[pool.submit(dclaw_results, name, model, chunk)] = f'{name}, {model}'
        for index in range(cases):
            jobs[pool.submit(point_result, index, seed)] = ''
        for count, job in enumerate(as_completed(jobs), 1):
            if jobs[job]:
                results.dclaw[jobs[job]] += job.result()
            else:
                results.points.append(job.result())
            print(f'\r{count} of {len(jobs)} jobs done', end='', file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return results
