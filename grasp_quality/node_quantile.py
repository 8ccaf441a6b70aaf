# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The quantile of alpha in the live loop: off by default, and never at the cost of the answer.

It gets half of the time that is left before the contacts are stale or the time limit is over;
what does not end in time, or fails, leaves alpha and forces as they are and says why. The seed is
always the same, so that the quantile follows the grasp and not the draws.
"""

from grasp_quality.exceptions import GraspQualityError
from grasp_quality.robust import robust_alpha

SHARE_OF_TIME = 0.5


def live_quantile(scene, task, load, settings, time_left_s):
    """
    Compute the quantile that the parameters ask for.

    Parameters
    ----------
    scene : Scene
        Contacts that alpha was computed from.
    task : TaskWrench, TaskCone or TaskPolytope
        The live task, in the object frame.
    load : (6,) array [N, N m] or None
        In the object frame.
    settings : Settings
        Samples, level and noise.
    time_left_s : float
        [s], of which it takes a share.

    Returns
    -------
    dict of GraspQuality fields, and the reason (str) when there is no quantile ('' when off)

    """
    if not settings.quantile_samples:
        return {}, ''
    try:
        answer = robust_alpha(
            scene.grasp, task, load, contact_noise=settings.contact_noise,
            normal_noise=settings.normal_noise, friction_noise=settings.friction_noise,
            load_noise=settings.load_noise or 0.0, samples=settings.quantile_samples,
            quantile=settings.quantile_level, time_limit_s=SHARE_OF_TIME * max(time_left_s, 0.0))
    except GraspQualityError as exc:
        return {}, f'alpha_quantile was not computed: {exc}'
    return {'quantile_computed': True, 'alpha_quantile': answer.quantile,
            'alpha_quantile_lower': answer.quantile_lower}, ''
