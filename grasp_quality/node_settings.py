# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Checked values of the node's parameters, and the rules that a range cannot say.

``node_parameters`` declares them, with type, unit and range; bags are replayed with the same
values and without ROS.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from grasp_quality.bounds import BOUNDS
from grasp_quality.contact import ContactModel
from grasp_quality.robust import CONFIDENCE
from grasp_quality.sample_statistics import fewest_samples
from grasp_quality.task import TaskWrench
from grasp_quality.uncertainty import Uncertainty
from msg_adapters.contacts import ContactDefaults
from msg_adapters.number_checks import checked_numbers, SMALLEST
from msg_adapters.topic_names import names_a_topic, TOPIC_RULE

SOURCES = {'pose_array': '~/contact_poses', 'contact_array': '~/contacts'}  # their topics
LEAST_AGE_S = 1e-3  # that can be a limit


@dataclass(frozen=True)
class Settings:
    """
    Checked values of all parameters; names, units and meaning are those of ``TABLE``.

    Raises
    ------
    ValueError

    """

    object_frame: str = ''
    contact_source: str = 'pose_array'
    contact_names: tuple[str, ...] = ()
    contact_fingers: tuple[str, ...] = ()
    contact_model: str = 'PCWF'
    friction_coefficient: float = 0.5
    torsional_friction_coefficient: float = 0.005
    max_normal_force: float = 10.0
    force_bound: str = 'linf'
    barrier_weight: float = 0.0
    alpha_reserve: float = 0.0
    force_rate_limit: float = 0.0
    task_wrench: tuple[float, ...] = ()
    min_contact_force: float = 0.0
    wanted_margin: float = 0.2
    margin_warning: float = -1.0
    max_contact_age: float = 0.1
    max_load_age: float = 0.0
    solver_time_limit: float = 1.0
    max_request_size: int = 4096
    map_directions: int = 2592
    marker_rate: float = 20.0
    marker_force_scale: float = 0.0
    display_time_share: float = 0.05
    quantile_samples: int = 0
    quantile_level: float = 0.05
    contact_noise: float = 0.0
    normal_noise: float = 0.0
    friction_noise: float = 0.0
    load_noise: tuple[float, ...] = ()
    autostart: bool = True
    allow_unsecured: bool = False

    def __post_init__(self) -> None:
        """Check the rules that a range cannot say."""
        _one_of('contact_source', self.contact_source, SOURCES)
        _one_of('contact_model', self.contact_model, [m.value for m in ContactModel])
        _one_of('force_bound', self.force_bound, BOUNDS)
        for name in ('max_normal_force', 'max_contact_age', 'solver_time_limit'):
            if not getattr(self, name) > 0.0:
                raise ValueError(f'{name} must be greater than 0, got {getattr(self, name)}')
        if self.max_load_age != 0.0 and not self.max_load_age >= LEAST_AGE_S:
            raise ValueError(f'max_load_age must be 0 (loads do not age) or at least '
                             f'{LEAST_AGE_S:g} s, got {self.max_load_age:g}')
        if '' in self.contact_names or len(set(self.contact_names)) != len(self.contact_names):
            raise ValueError(
                f'contact_names must be unique and not empty, got {list(self.contact_names)}')
        for name in self.contact_names:
            if not names_a_topic(name):
                raise ValueError(f'contact_names must make topics: {TOPIC_RULE}, got {name!r}')
        if self.min_contact_force > 0.0 and not self.contact_names:
            raise ValueError(
                'min_contact_force above 0 needs contact_names: they name the topics '
                '~/contact_wrenches/<name> that measured forces come on')
        if self.contact_fingers and len(self.contact_fingers) != len(self.contact_names):
            raise ValueError(
                f'contact_fingers must name one finger for each of the {len(self.contact_names)} '
                f'contact_names, got {list(self.contact_fingers)}')
        self._check_numbers()
        if self.alpha_reserve >= 1.0:
            raise ValueError(f'alpha_reserve must be less than 1, got {self.alpha_reserve}')
        if self.alpha_reserve > 0.0 and self.barrier_weight > 0.0:
            raise ValueError(
                f'barrier_weight {self.barrier_weight:g} and alpha_reserve '
                f'{self.alpha_reserve:g} are two ways to buy margin with alpha: set one to 0')
        self._check_uncertainty()

    def _check_numbers(self) -> None:
        """Hold parameters to what messages are held to."""
        for name in ('friction_coefficient', 'torsional_friction_coefficient', 'max_normal_force'):
            value = getattr(self, name)
            if value != 0.0 and value < SMALLEST:
                raise ValueError(f'{name} must be 0 or at least {SMALLEST:g}, got {value:g}')
        for name in ('task_wrench', 'load_noise'):
            checked_numbers(getattr(self, name), name)
        if self.task_wrench:
            TaskWrench(self.task_wrench)
            if max(map(abs, self.task_wrench)) < SMALLEST:
                raise ValueError(f'task_wrench must not be zero (below {SMALLEST:g})')

    def _check_uncertainty(self) -> None:
        if not 0.0 < self.quantile_level < 1.0:
            raise ValueError(
                f'quantile_level must be between 0 and 1 exclusive, got {self.quantile_level}')
        Uncertainty(self.contact_noise, self.normal_noise, self.friction_noise,
                    self.load_noise or 0.0, contacts=1)
        fewest = fewest_samples(self.quantile_level, CONFIDENCE)
        if 0 < self.quantile_samples < fewest:
            raise ValueError(
                f'quantile_samples must be 0 (off) or at least {fewest} for the quantile_level '
                f'{self.quantile_level:g}, got {self.quantile_samples}')

    @property
    def shortest_age(self) -> float:
        """Return the least of the ages at which something is stale [s]."""
        return min(self.max_contact_age, self.max_load_age or self.max_contact_age)

    @property
    def contact_defaults(self) -> ContactDefaults:
        """Return what contact messages leave open."""
        return ContactDefaults(
            ContactModel[self.contact_model], self.friction_coefficient,
            self.torsional_friction_coefficient, self.max_normal_force,
            self.contact_names, self.contact_fingers)


def _one_of(name: str, value: str, choices: Iterable[str]) -> None:
    if value not in choices:
        raise ValueError(f'{name} must be one of {list(choices)}, got {value!r}')
