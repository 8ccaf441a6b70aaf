#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# Branch coverage of the tests, with that of the processes they start (.coveragerc): of the core
# alone and of all. Arguments go to pytest.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
export GRASP_QUALITY_ROOT=$PWD COVERAGE_RCFILE=$PWD/.coveragerc
core_least=95 all_least=85
nodes='grasp_quality/node*.py,grasp_quality/lifecycle_node.py'

rm -rf build/coverage
mkdir -p build/coverage
code=0
PYTEST='coverage run -m pytest' scripts/test.sh "$@" || code=1
# compiled functions once more as plain Python, which takes far longer: of the ball its quicker tests
ball=test/core/test_ball.py
PYTHONPATH=test:$PYTHONPATH coverage run -m pytest -p uncompiled \
    test/core/test_{judge,batch,many,scaled}.py \
    $ball::test_{antipodal_soft_fingers,a_flat_wrench_space_holds_no_ball} \
    $ball::test_{an_ellipsoid_of_one_axis_is_two_task_wrenches,out_of_time_is_an_honest_interval} ||
    code=1
coverage combine --quiet || exit 1
printf '\nall: core, adapters, nodes, command line, hand\n'
coverage report --fail-under="$all_least" || code=1
printf '\ncore: grasp_quality/ without its nodes\n'
coverage report --include='grasp_quality/*' --omit="$nodes" --fail-under="$core_least" || code=1
exit "$code"
