# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Install the package grasp_quality_hand: the hand's side of grasp_quality."""

from setuptools import setup

NAME = 'grasp_quality_hand'

setup(
    name=NAME,
    version='0.1.0',
    packages=[NAME],
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (f'share/{NAME}', ['package.xml']),
    ],
    install_requires=[
        'setuptools', 'numpy', 'scipy', 'mujoco-core', 'matplotlib', 'pin', 'trimesh', 'viser'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    author='The grasp_quality authors',
    maintainer='The grasp_quality authors',
    maintainer_email='grasp_quality@example.com',
    description="A simulated three-finger hand (D'Claw) and a demo for grasp_quality.",
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'bag_recorder = grasp_quality_hand.bag_recorder:main',
            'demo = grasp_quality_hand.demo:main',
            'fetch_dclaw = grasp_quality_hand.fetch_dclaw:main',
            'force_audit = grasp_quality_hand.force_audit_node:main',
            'force_to_effort = grasp_quality_hand.force_to_effort:main',
            'holding_load = grasp_quality_hand.holding_load:main',
            'simulated_hand = grasp_quality_hand.simulated_hand_node:main',
            'viewer = grasp_quality_hand.viewer:main',
        ],
    },
)
