# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether DDS-Security was asked for and is surely in force (docs/security.md).

ROS 2 reads ROS_SECURITY_ENABLE and ROS_SECURITY_STRATEGY. With 'true' and 'Enforce' a process does
not start unless its keys are there and the middleware can use them. In every other case a node may
run without security and only a line in a log says so: keys that are not found under the default
strategy, or another spelling of 'true', which counts as 'false'.
"""

from collections.abc import Mapping

NOT_IN_FORCE = (
    'security was asked for ({asked}) and may not be in force: ROS 2 guarantees it only with '
    'ROS_SECURITY_ENABLE=true and ROS_SECURITY_STRATEGY=Enforce, and a middleware that has '
    'DDS-Security (the Fast DDS of the wheels has none). Set both, or unset them, or set the '
    'parameter allow_unsecured to run open to everyone on the network')


def unsecured_reason(environment: Mapping[str, str]) -> str:
    """
    Say why security that was asked for may not be in force; '' when all is as asked.

    Parameters
    ----------
    environment : mapping of str to str
        That of the process, such as os.environ.

    """
    enable = environment.get('ROS_SECURITY_ENABLE', '')
    strategy = environment.get('ROS_SECURITY_STRATEGY', '')
    if enable == 'false' or not (enable or strategy):
        return ''
    if (enable, strategy) == ('true', 'Enforce'):
        return ''  # or this process would not have come so far
    asked = [f'{name}={value}' for name, value in (
        ('ROS_SECURITY_ENABLE', enable), ('ROS_SECURITY_STRATEGY', strategy)) if value]
    return NOT_IN_FORCE.format(asked=', '.join(asked))
