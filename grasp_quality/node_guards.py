# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Services that rclpy brings along, made to answer whatever they are asked.

In rclpy 7.1 an impossible transition and a parameter of an unknown type raise through ``spin()``
and leave the client waiting for ever. Here they are refused with the reason, like everything else.
"""

from grasp_quality.node_log import Refusals
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically


def guard_services(node):
    """Wrap the services of a lifecycle node that change it."""
    refusals = Refusals(node.get_logger().warning)
    for service in node.services:
        if service.srv_type in REFUSALS:
            service.callback = _answering(
                service.callback, REFUSALS[service.srv_type], refusals)


def _answering(callback, refuse, refusals):
    def answer(request, response):
        try:
            return callback(request, response)
        except Exception as exc:
            refusals.tell(f'refused: {exc}')
            refuse(request, response, str(exc))
            return response
    return answer


def _refuse_transition(request, response, reason):
    response.success = False


def _refuse_parameters(request, response, reason):
    """Answer for the parameter that raised and those behind it; those before are answered."""
    missing = len(request.parameters) - len(response.results)
    response.results = [*response.results, *[
        SetParametersResult(successful=False, reason=reason)] * missing]


def _refuse_all_parameters(request, response, reason):
    response.result = SetParametersResult(successful=False, reason=reason)


REFUSALS = {
    ChangeState: _refuse_transition, SetParameters: _refuse_parameters,
    SetParametersAtomically: _refuse_all_parameters}
