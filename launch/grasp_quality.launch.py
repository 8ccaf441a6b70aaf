# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Start the node grasp_quality, which configures and activates itself (parameter autostart)."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import LifecycleNode
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Return the node with its three launch arguments."""
    default_params = PathJoinSubstitution(
        [FindPackageShare('grasp_quality'), 'config', 'grasp_quality.yaml'])
    return LaunchDescription([
        DeclareLaunchArgument(
            'params_file', default_value=default_params,
            description='YAML file with the parameters of the node'),
        DeclareLaunchArgument(
            'namespace', default_value='',
            description='Namespace of the node, for instance the name of the hand'),
        DeclareLaunchArgument(
            'log_level', default_value='info', choices=['debug', 'info', 'warn', 'error', 'fatal'],
            description='Log level of the node'),
        LifecycleNode(
            package='grasp_quality',
            executable='grasp_quality_node',
            name='grasp_quality',
            namespace=LaunchConfiguration('namespace'),
            parameters=[LaunchConfiguration('params_file')],
            arguments=['--ros-args', '--log-level', LaunchConfiguration('log_level')],
            output='screen'),
    ])
