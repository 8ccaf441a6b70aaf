# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Install the package grasp_quality: core library, message adapters, node, command line."""

from glob import glob
import os

from setuptools import setup

NAME = 'grasp_quality'

setup(
    name=NAME,
    version='0.1.0',
    packages=['grasp_quality', 'grasp_quality_cli', 'msg_adapters'],
    package_data={'grasp_quality': ['py.typed'], 'msg_adapters': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (f'share/{NAME}', ['package.xml']),
        (f'share/{NAME}/config', sorted(filter(os.path.isfile, glob('config/*')))),
        (f'share/{NAME}/config/security', sorted(glob('config/security/*'))),
        (f'share/{NAME}/launch', sorted(glob('launch/*.launch.py'))),
    ],
    install_requires=['setuptools', 'numpy', 'scipy', 'numba', 'clarabel'],
    extras_require={
        'cli': ['matplotlib', 'pyarrow', 'pyyaml', 'rich', 'rosbags', 'typer'],
        'cluster': ['distributed'],
        'reference': ['cvxpy'], 'test': ['pytest', 'hypothesis', 'cvxpy']},
    zip_safe=True,
    author='The grasp_quality authors',
    maintainer='The grasp_quality authors',
    maintainer_email='grasp_quality@example.com',
    description='Task-oriented grasp quality from live contacts, with proof and contact forces.',
    license='Apache-2.0',
    entry_points={'console_scripts': [
        'grasp_quality_node = grasp_quality.node:main',
        'grasp-quality = grasp_quality_cli.main:main']},
)
